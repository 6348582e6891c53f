// Numbers out of text.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <system_error>

namespace hurcules {

// a number and nothing else; none: it is no such number
template <class Number>
[[nodiscard]] std::optional<Number> number_of(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

}  // namespace hurcules

// Numbers out of text, and text of numbers.
#pragma once

#include <array>
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

// the shortest text that reads as this number: 0.3, 1e-09, inf
[[nodiscard]] inline std::string number_text(double value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? std::string(text.data(), end) : "a number";
}

// with so many digits, in any locale: 0.333, 1e-09, inf
[[nodiscard]] inline std::string number_text(double value, int digits) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value,
                                          std::chars_format::general, digits);
  return error == std::errc() ? std::string(text.data(), end) : "a number";
}

}  // namespace hurcules

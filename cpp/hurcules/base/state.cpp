#include "hurcules/base/state.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

// stands for NaN, so that snapshots can be compared, stored and sent as plain numbers
constexpr double kNotANumber = std::numeric_limits<double>::lowest();

}  // namespace

void StateWriter::put(double value) {
  out_.push_back(std::isnan(value) ? kNotANumber : value);
}

void StateWriter::put(const ConstVectorRef& values) {
  for (Index i = 0; i < values.size(); ++i) put(values[i]);
}

void StateWriter::put_bits(unsigned long long word) {
  put(static_cast<double>(word >> 32));
  put(static_cast<double>(word & 0xffffffffULL));
}

std::uint64_t hash_of(std::string_view bytes, std::uint64_t so_far) {
  for (const char byte : bytes)
    so_far = (so_far ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return so_far;
}

double hash_of_names(std::initializer_list<const std::vector<std::string>*> lists,
                     std::uint64_t so_far) {
  for (const auto* list : lists) {
    for (const std::string& name : *list) so_far = hash_of(";", hash_of(name, so_far));
  }
  return static_cast<double>(so_far >> 11);
}

double StateReader::get_any() {
  require(next_ < in_.size(), "the snapshot ends early: it belongs to another model or mission");
  const double value = in_[next_++];
  return value == kNotANumber ? std::numeric_limits<double>::quiet_NaN() : value;
}

double StateReader::get() {
  const double value = get_any();
  require(any_ || !std::isnan(value), "a snapshot has NaN where a number is wanted");
  return value;
}

Index StateReader::get_count(Index most) {
  const double value = get();
  if (value < 0.0 || value > static_cast<double>(most) || value != std::floor(value)) {
    throw Error("a snapshot has " + std::to_string(value) + " where a whole number up to " +
                std::to_string(most) + " is wanted");
  }
  return static_cast<Index>(value);
}

void StateReader::get(VectorRef values) {
  for (Index i = 0; i < values.size(); ++i) values[i] = get();
}

unsigned long long StateReader::get_bits() {
  constexpr Index kHalf = 0xffffffff;
  const auto high = static_cast<unsigned long long>(get_count(kHalf));
  return (high << 32) | static_cast<unsigned long long>(get_count(kHalf));
}

}  // namespace hurcules

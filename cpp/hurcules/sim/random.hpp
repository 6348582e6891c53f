// Random numbers of our own: the same bits on every machine and library.
#pragma once

#include <array>
#include <cstdint>

namespace hurcules {

// xoshiro256**, seeded by splitmix64 (Blackman and Vigna, public domain)
class Random {
 public:
  explicit Random(std::uint64_t seed = 0);
  std::uint64_t next();
  // uniform in [-1, 1)
  double symmetric();

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace hurcules

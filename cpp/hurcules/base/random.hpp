// Random numbers of our own: the same bits on every machine and library.
#pragma once

#include <array>
#include <cstdint>

#include "hurcules/base/state.hpp"

namespace hurcules {

// xoshiro256**, seeded by splitmix64 (Blackman and Vigna, public domain)
class Random {
 public:
  explicit Random(std::uint64_t seed = 0);
  std::uint64_t next();
  // uniform in [-1, 1)
  double symmetric();
  // close to a standard normal: twelve uniform numbers summed, none beyond 6, no libm in it
  double normal();
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace hurcules

#include "hurcules/base/random.hpp"

#include <bit>

namespace hurcules {

namespace {

std::uint64_t splitmix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed) : state_() {
  for (std::uint64_t& word : state_) word = splitmix(seed);
}

std::uint64_t Random::next() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t t = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::symmetric() {
  // 53 bits make a double in [0, 1)
  return static_cast<double>(next() >> 11) * 0x1.0p-52 - 1.0;
}

double Random::normal() {
  // twelve numbers of 16 bits out of three words: mean 12 * 32767.5, variance 65536^2 - 1
  std::int64_t sum = 0;
  for (int word = 0; word < 3; ++word) {
    for (std::uint64_t bits = next(), part = 0; part < 4; ++part, bits >>= 16) {
      sum += static_cast<std::int64_t>(bits & 0xffff);
    }
  }
  return static_cast<double>(sum - 393210) / 65536.0;
}

void Random::save(StateWriter& writer) const {
  for (const std::uint64_t word : state_) writer.put_bits(word);
}

void Random::restore(StateReader& reader) {
  for (std::uint64_t& word : state_) word = reader.get_bits();
}

}  // namespace hurcules

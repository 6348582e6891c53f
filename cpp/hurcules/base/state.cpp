#include "hurcules/base/state.hpp"

#include "hurcules/base/error.hpp"

namespace hurcules {

void StateWriter::put(const ConstVectorRef& values) {
  for (Index i = 0; i < values.size(); ++i) put(values[i]);
}

void StateWriter::put_bits(unsigned long long word) {
  put(static_cast<double>(word >> 32));
  put(static_cast<double>(word & 0xffffffffULL));
}

double StateReader::get() {
  require(next_ < in_.size(), "the snapshot ends early: it belongs to another model or mission");
  return in_[next_++];
}

void StateReader::get(VectorRef values) {
  for (Index i = 0; i < values.size(); ++i) values[i] = get();
}

unsigned long long StateReader::get_bits() {
  const auto high = static_cast<unsigned long long>(get());
  return (high << 32) | static_cast<unsigned long long>(get());
}

}  // namespace hurcules

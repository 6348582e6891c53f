// The kernels for any processor: vectors of two doubles.
#define HURCULES_KERNEL_WIDTH 2
#include "hurcules/solver/kernels/impl.hpp"

namespace hurcules::kernels {
const Table* baseline() {
  return &kTable;
}
}  // namespace hurcules::kernels

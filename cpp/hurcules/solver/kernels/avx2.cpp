// The kernels for processors with AVX2 and FMA: vectors of four doubles. The build sets the
// instruction set for this file alone, so it includes nothing that others share.
#if defined(__AVX2__) && defined(__FMA__)
#define HURCULES_KERNEL_WIDTH 4
#include "hurcules/solver/kernels/impl.hpp"

namespace hurcules::kernels {
const Table* avx2() {
  return &kTable;
}
}  // namespace hurcules::kernels
#else
namespace hurcules::kernels {
struct Table;
const Table* avx2() {
  return nullptr;
}
}  // namespace hurcules::kernels
#endif

// The kernels for any processor: vectors of two doubles.
#define HURCULES_KERNEL_WIDTH 2
namespace hurcules::kernels {
namespace {
constexpr int kWidth = HURCULES_KERNEL_WIDTH;
constexpr const char* kName = "baseline";
}  // namespace
}  // namespace hurcules::kernels
#include "hurcules/solver/kernels_impl.hpp"

namespace hurcules::kernels {
const Table* baseline() {
  return &kTable;
}
}  // namespace hurcules::kernels

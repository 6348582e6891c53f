#include "hurcules/solver/triangularize.hpp"

#include <cmath>

namespace hurcules {

void triangularize(Matrix& block, Index rows, Index columns) {
  for (Index j = 0; j < columns; ++j) {
    double norm2 = 0.0;
    for (Index i = j; i < rows; ++i) norm2 += block(i, j) * block(i, j);
    const double alpha = block(j, j) > 0.0 ? -std::sqrt(norm2) : std::sqrt(norm2);
    const double pivot = block(j, j) - alpha;
    if (pivot == 0.0) continue;
    // v = (pivot, block(j+1.., j)),  H = I - v v' / (-alpha pivot)
    for (Index c = j + 1; c <= columns; ++c) {
      double sum = pivot * block(j, c);
      for (Index i = j + 1; i < rows; ++i) sum += block(i, j) * block(i, c);
      const double scale = sum / (-alpha * pivot);
      block(j, c) -= scale * pivot;
      for (Index i = j + 1; i < rows; ++i) block(i, c) -= scale * block(i, j);
    }
    block(j, j) = alpha;
  }
}

}  // namespace hurcules

#include "hurcules/solver/kernels/triangularize.hpp"

#include <cmath>

#include "hurcules/solver/kernels/kernels.hpp"

namespace hurcules {

namespace {

// of so few columns the vectors of a kernel would be mostly padding
constexpr Index kFewColumns = 3;

// entry by entry
template <class Scalar, class At>
void triangularize_entries(At block, Index rows, Index columns) {
  for (Index j = 0; j < columns; ++j) {
    Scalar norm2 = 0.0;
    for (Index i = j; i < rows; ++i) norm2 += block(i, j) * block(i, j);
    const Scalar alpha = block(j, j) > Scalar(0.0) ? -std::sqrt(norm2) : std::sqrt(norm2);
    const Scalar pivot = block(j, j) - alpha;
    if (pivot == Scalar(0.0)) continue;
    // v = (pivot, block(j+1.., j)),  H = I - v v' / (-alpha pivot)
    for (Index c = j + 1; c <= columns; ++c) {
      Scalar sum = pivot * block(j, c);
      for (Index i = j + 1; i < rows; ++i) sum += block(i, j) * block(i, c);
      const Scalar scale = sum / (-alpha * pivot);
      block(j, c) -= scale * pivot;
      for (Index i = j + 1; i < rows; ++i) block(i, c) -= scale * block(i, j);
    }
    block(j, j) = alpha;
  }
}

}  // namespace

template <class Block>
void triangularize(Block& block, Index rows, Index columns) {
  using Scalar = typename Block::Scalar;
  triangularize_entries<Scalar>([&](Index i, Index j) -> Scalar& { return block(i, j); }, rows,
                                columns);
}

template void triangularize(Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>&, Index,
                            Index);

void triangularize(PaddedRows& block, Index rows, Index columns, double* work) {
  const Index stride = block.stride();
  if (columns <= kFewColumns) {
    return triangularize_entries<double>(
        [first = block.row(0), stride](Index i, Index j) -> double& {
          return first[i * stride + j];
        },
        rows, columns);
  }
  double *sum = work, *v = work + stride;
  for (Index j = 0; j < columns; ++j) {
    double norm2 = 0.0;
    const double* entry = block.row(j) + j;
    for (Index i = 0; i < rows - j; ++i, entry += stride) {
      v[i] = *entry;
      norm2 += v[i] * v[i];
    }
    const double alpha = v[0] > 0.0 ? -std::sqrt(norm2) : std::sqrt(norm2);
    v[0] -= alpha;
    if (v[0] == 0.0) continue;
    // from a column on where a vector begins
    const Index first = j / 4 * 4;
    kernels::chosen->reflect(block.row(j) + first, rows - j, padded(columns + 1) - first, stride, v,
                             1.0 / (-alpha * v[0]), sum);
    block.row(j)[j] = alpha;
  }
}

void solve_triangular(const PaddedRows& block, Index columns, double* y) {
  for (Index j = columns - 1; j >= 0; --j) {
    const double* row = block.row(j);
    double sum = row[columns];
    for (Index l = j + 1; l < columns; ++l) sum -= row[l] * y[l];
    y[j] = sum / row[j];
  }
}

}  // namespace hurcules

#include "hurcules/solver/chain.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

void Chain::reserve(Index unknowns, Index rows, Index levels) {
  factor_.reserve(rows, unknowns);
  transposed_.reserve(padded(unknowns), unknowns);
  transposed_.shape(unknowns);
  for (PaddedVector* v : {&part_, &rest_}) v->reserve(padded(unknowns) + 4);
  rank_.reserve(levels + 1);
}

void Chain::build(const RowTable& rows) {
  complete_ = false;
  factor_.start(rows.dense(), rows.unknowns());
  std::copy_n(rows.dense_row(0), rows.dense() * rows.stride(), factor_.row(0));
  rank_.assign(1, 0);
  for (int k = 0; k < rows.levels(); ++k) {
    factor_.run(rows.equalities(k), rows.equalities(k + 1), rows.dense_norms2(), tolerance::kRank);
    factor_.clear_unknown(rows.equalities(k), rows.equalities(k + 1));
    rank_.push_back(factor_.rank());
  }
}

void Chain::complete(const RowTable& rows) {
  if (complete_) return;
  complete_ = true;
  const kernels::Table& kernel = *kernels::chosen;
  const Index n = unknowns(), first = factor_.rank();
  if (first < n) find_rest();

  while (factor_.rank() < n) {
    const Index b = std::max_element(rest_.data(), rest_.data() + n) - rest_.data();
    double* q = factor_.row(rows.dense());  // a free row behind all others
    std::fill_n(q, stride(), 0.0);
    q[b] = 1.0;
    const double left = factor_.project(q, part_.data(), 1.0);
    const double scale = 1.0 / std::sqrt(left);
    double* direction = factor_.push_direction();
    for (Index j = 0; j < stride(); ++j) direction[j] = scale * q[j];
    for (Index j = 0; j < n; ++j) rest_[j] -= direction[j] * direction[j];
  }
  for (int d = rows.equalities(); first < n && d < rows.dense(); ++d) {
    kernel.dots(direction(first), n - first, stride(), factor_.rest(d),
                factor_.coordinates(d) + first);
  }
  if (rows.bounds_blocks() > 0) {
    kernel.transpose(direction(0), padded(n), stride(), transposed_.row(0));
  }
}

// what each unit vector still has outside the span, squared
void Chain::find_rest() {
  const Index n = unknowns();
  for (Index b = 0; b < n; ++b) rest_[b] = 1.0;
  for (Index j = 0; j < factor_.rank(); ++j) {
    for (Index b = 0; b < n; ++b) rest_[b] -= direction(j)[b] * direction(j)[b];
  }
}

void Chain::remove_first(Index r, double* y) {
  const kernels::Table& kernel = *kernels::chosen;
  kernel.dots(direction(0), r, stride(), y, part_.data());
  for (Index j = 0; j < r; ++j) part_[j] = -part_[j];
  kernel.axpys(direction(0), r, stride(), part_.data(), y);
}

}  // namespace hurcules

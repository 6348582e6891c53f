#include "hurcules/solver/problem/nullspace_basis.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

// a unit vector that keeps this part outside the span needs no second cleaning (squared)
constexpr double kWhole = 0.05;

}  // namespace

void NullspaceBasis::reserve(Index unknowns, Index rows, Index levels) {
  factor_.reserve(rows, unknowns);
  transposed_.reserve(padded(unknowns), unknowns);
  transposed_.shape(unknowns);
  for (PaddedVector* v : {&part_, &rest_, &coordinates_}) v->reserve(padded(unknowns) + 4);
  rank_.reserve(levels + 1);
}

void NullspaceBasis::build(const RowTable& rows) {
  basis_.start_whole();
  factor_.start(rows.dense(), rows.unknowns());
  std::copy_n(rows.dense_row(0), rows.dense() * rows.stride(), factor_.row(0));
  directions_ = factor_.direction(0);
  x_stride_ = rows.stride();
  build_levels(rows, 0);
}

void NullspaceBasis::build_levels(const RowTable& rows, int first) {
  complete_ = false;
  rank_.assign(first + 1, 0);
  for (int k = first; k < rows.levels(); ++k) {
    factor_.run(rows.equalities(k), rows.equalities(k + 1), rows.dense_norms2(), tolerance::kRank);
    factor_.clear_unknown(rows.equalities(k), rows.equalities(k + 1));
    rank_.push_back(factor_.rank());
  }
}

void NullspaceBasis::complete(const RowTable& rows) {
  if (complete_) return;
  complete_ = true;
  const kernels::Table& kernel = *kernels::chosen;
  const Index n = unknowns(), first = factor_.rank();
  if (first < n) find_rest();

  while (factor_.rank() < n) add_direction(rows);
  if (!basis_.whole()) find_images(first);
  for (int d = rows.equalities(); first < n && d < rows.dense(); ++d) {
    kernel.dots(factor_.direction(first), n - first, stride(), factor_.rest(d),
                factor_.coordinates(d) + first);
  }
  if (rows.bounds_blocks() > 0) {
    kernel.transpose(direction(0), padded(n), x_stride_, transposed_.row(0));
  }
}

// what each unit vector still has outside the span, squared
void NullspaceBasis::find_rest() {
  std::fill_n(rest_.data(), stride(), 1.0);
  kernels::chosen->take_squares(factor_.direction(0), factor_.rank(), stride(), rest_.data());
}

// that of the unit vector which has most left outside the span
void NullspaceBasis::add_direction(const RowTable& rows) {
  const kernels::Table& kernel = *kernels::chosen;
  const Index rank = factor_.rank();
  const Index b = std::max_element(rest_.data(), rest_.data() + unknowns()) - rest_.data();
  double* q = factor_.row(rows.dense());  // a free row behind all others
  std::fill_n(q, stride(), 0.0);
  q[b] = 1.0;
  // its parts are numbers of the directions
  for (Index j = 0; j < rank; ++j) part_[j] = -factor_.direction(j)[b];
  kernel.axpys(factor_.direction(0), rank, stride(), part_.data(), q);
  double left = kernel.dot(stride(), q, q);
  if (left < kWhole) left = factor_.project(q, part_.data(), left);
  double* direction = factor_.push_direction();
  kernel.scale(stride(), 1.0 / std::sqrt(left), q, direction);
  kernel.take_squares(direction, 1, stride(), rest_.data());
}

void NullspaceBasis::remove_first(Index r, double* y) {
  const kernels::Table& kernel = *kernels::chosen;
  kernel.dots(direction(0), r, x_stride_, y, part_.data());
  for (Index j = 0; j < r; ++j) part_[j] = -part_[j];
  if (!basis_.whole()) {
    basis_.coordinates(y, step_.data());
    std::fill_n(y, x_stride_, 0.0);
    basis_.add_step(step_.data(), y);
  }
  kernel.axpys(direction(0), r, x_stride_, part_.data(), y);
}

double NullspaceBasis::free_part(Index r, const double* y, double* work) {
  const kernels::Table& kernel = *kernels::chosen;
  // all directions are known: the free ones tell it at once
  if (factor_.rank() == unknowns()) {
    return std::sqrt(kernel.norm2_along(direction(r), unknowns() - r, x_stride_, y));
  }
  std::copy_n(y, x_stride_, work);
  remove_first(r, work);
  return std::sqrt(kernel.dot(x_stride_, work, work));
}

void NullspaceBasis::reserve_basis(Index unknowns, Index levels) {
  basis_.reserve(unknowns, levels);
  images_.reserve(unknowns, unknowns);
  step_.reserve(padded(unknowns) + 4);
}

void NullspaceBasis::build_behind(const RowTable& rows, int level) {
  factor_.start(rows.dense(), basis_.size());
  for (Index d = 0; d < rows.equalities(level + 1); ++d) {
    std::fill_n(factor_.row(d), factor_.stride(), 0.0);
  }
  for (int d = rows.equalities(level + 1); d < rows.dense(); ++d) {
    basis_.coordinates(rows.dense_row(d), factor_.row(d));
  }
  x_stride_ = rows.stride();
  images_.shape(rows.unknowns());
  directions_ = images_.row(0);
  build_levels(rows, level + 1);
  find_images(0);
}

void NullspaceBasis::find_images(Index from) {
  for (Index j = from; j < factor_.rank(); ++j) {
    std::fill_n(images_.row(j), x_stride_, 0.0);
    basis_.add_step(factor_.direction(j), images_.row(j));
  }
}

void NullspaceBasis::add_free_part(Index r, const double* step, double* y) const {
  const kernels::Table& kernel = *kernels::chosen;
  const double* whole = step;
  if (!basis_.whole()) {
    basis_.step_of(step, step_.data());
    whole = step_.data();
  }
  const Index count = unknowns() - r;
  kernel.dots(factor_.direction(r), count, stride(), whole, coordinates_.data());
  kernel.axpys(direction(r), count, x_stride_, coordinates_.data(), y);
}

}  // namespace hurcules

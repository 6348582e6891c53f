#include "hurcules/solver/problem/weighted_nullspace_basis.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels/kernels.hpp"

namespace hurcules {

void WeightedNullspaceBasis::reserve(Index unknowns, Index levels) {
  for (PaddedRows* r : {&columns_, &in_before_, &kept_}) r->reserve(unknowns, unknowns);
  for (PaddedVector* v : {&weight_, &part_}) v->reserve(padded(unknowns) + 4);
  handed_.reserve(levels);
}

void WeightedNullspaceBasis::start_whole() {
  before_ = nullptr;
  kept_count_ = 0;
  handed_.clear();
}

void WeightedNullspaceBasis::start(const WeightedNullspaceBasis& before, Index before_unknowns,
                                   Index unknowns, int level) {
  before_ = &before;
  size_ = 0;
  for (PaddedRows* r : {&columns_, &kept_}) r->shape(unknowns);
  in_before_.shape(before_unknowns);
  kept_count_ = before.kept_count_;
  if (kept_count_ > 0) std::copy_n(before.kept_.row(0), kept_count_ * kept_.stride(), kept_.row(0));
  handed_.assign(before.handed_.begin(), before.handed_.end());
  handed_.resize(level, 0);
  handed_.push_back(1);
}

void WeightedNullspaceBasis::add(const double* direction, double weight) {
  std::copy_n(direction, in_before_.stride(), in_before_.row(size_));
  double* column = columns_.row(size_);
  if (before_->whole()) {
    for (Index j = 0; j < columns_.stride(); ++j) column[j] = weight * direction[j];
  } else {
    std::fill_n(column, columns_.stride(), 0.0);
    before_->add_step(direction, column);
    for (Index j = 0; j < columns_.stride(); ++j) column[j] *= weight;
  }
  weight_[size_++] = weight;
}

void WeightedNullspaceBasis::keep(const double* c) {
  const double scale = 1.0 / std::sqrt(kernels::chosen->dot(kept_.stride(), c, c));
  double* kept = kept_.row(kept_count_++);
  for (Index j = 0; j < kept_.stride(); ++j) kept[j] = scale * c[j];
}

double WeightedNullspaceBasis::moved(const double* dx) const {
  if (whole() || kept_count_ == 0) return 0.0;
  kernels::chosen->dots(kept_.row(0), kept_count_, kept_.stride(), dx, part_.data());
  double worst = 0.0;
  for (Index i = 0; i < kept_count_; ++i) worst = std::max(worst, std::abs(part_[i]));
  return worst;
}

void WeightedNullspaceBasis::coordinates(const double* v, double* out) const {
  kernels::chosen->dots(columns_.row(0), size_, columns_.stride(), v, out);
  std::fill(out + size_, out + padded(size_), 0.0);
}

void WeightedNullspaceBasis::add_step(const double* t, double* x) const {
  kernels::chosen->axpys(columns_.row(0), size_, columns_.stride(), t, x);
}

void WeightedNullspaceBasis::step_of(const double* dx, double* t) const {
  const double* before = dx;
  if (!before_->whole()) {
    before_->step_of(dx, part_.data());
    before = part_.data();
  }
  kernels::chosen->dots(in_before_.row(0), size_, in_before_.stride(), before, t);
  for (Index i = 0; i < size_; ++i) t[i] /= weight_[i];
  std::fill(t + size_, t + padded(size_), 0.0);
}

}  // namespace hurcules

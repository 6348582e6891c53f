#include "hurcules/solver/extended_precision/extended_precision_basis.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

using Long = long double;

// enough, also for what is left of a nearly dependent row
constexpr int kCleanings = 3;
// a cleaning that left more than this part was the last that is needed: its rounding is twice that
// of the row at most (Daniel, Gragg, Kaufman, Stewart 1976)
constexpr Long kClean = 0.5;

Long norm(Index size, const Long* v) {
  Long sum = 0.0L;
  for (Index c = 0; c < size; ++c) sum += v[c] * v[c];
  return std::sqrt(sum);
}

}  // namespace

void ExtendedPrecisionBasis::reserve(Index columns, Index rows) {
  const std::size_t directions = static_cast<std::size_t>(std::min(columns, rows));
  const std::size_t width = static_cast<std::size_t>(columns);
  directions_.resize(std::max(directions_.size(), directions * width));
  parts_.resize(std::max(parts_.size(), directions * width));
  rest_.resize(std::max(rest_.size(), width));
  mark_.resize(std::max(mark_.size(), directions));
  for (PaddedRows* r : {&high_, &low_}) r->reserve(std::min(columns, rows), columns);
  for (PaddedVector* v : {&rest_high_, &rest_low_, &part_high_, &part_low_}) {
    v->reserve(padded(columns) + 4);
  }
}

void ExtendedPrecisionBasis::start(Index columns) {
  columns_ = columns;
  size_ = 0;
  for (PaddedRows* r : {&high_, &low_}) r->shape(columns);
  weakest_ = 1.0L;
}

Long ExtendedPrecisionBasis::dot(Index j, const Long* v) const {
  const Long* b = direction(j);
  Long sum = 0.0L;
  for (Index c = 0; c < columns_; ++c) sum += b[c] * v[c];
  return sum;
}

void ExtendedPrecisionBasis::split(Index size, const Long* v, Long scale, kernels::Split out) {
  for (Index c = 0; c < size; ++c) {
    const Long x = scale * v[c];
    out.high[c] = kernels::on_grid(static_cast<double>(x));
    out.low[c] = static_cast<double>(x - out.high[c]);
  }
  for (Index c = size; c < padded(size); ++c) out.high[c] = out.low[c] = 0.0;
}

Long ExtendedPrecisionBasis::remove(const Long* row, Long* rest, Long* parts) const {
  std::copy_n(row, columns_, rest);
  std::fill_n(parts, size_, 0.0L);
  Long left = norm(columns_, row);
  const kernels::Split v = {rest_high_.data(), rest_low_.data()};
  const kernels::Split part = {part_high_.data(), part_low_.data()};
  for (int pass = 0; pass < kCleanings && size_ > 0; ++pass) {
    int exponent = 0;
    (void)std::frexp(left, &exponent);
    const Long size = std::ldexp(1.0L, exponent);  // a power of two above
    split(columns_, rest, 1.0L / size, v);
    for (double* p : {part.high, part.low}) std::fill_n(p, padded(size_), 0.0);
    kernels::chosen->project_split(high_.row(0), low_.row(0), size_, high_.stride(), v, part);
    for (Index c = 0; c < columns_; ++c) rest[c] = size * (Long(v.high[c]) + v.low[c]);
    for (Index j = 0; j < size_; ++j) parts[j] += size * (Long(part.high[j]) + part.low[j]);
    const Long before = left;
    left = norm(columns_, rest);
    if (left > kClean * before) break;
  }
  return left;
}

bool ExtendedPrecisionBasis::add(const Long* row, Index mark, Long least) {
  if (size_ == columns_ || size_ == static_cast<Index>(mark_.size())) return false;
  Long* parts = &parts_[size_ * columns_];
  const Long left = remove(row, rest_.data(), parts);
  if (!(left > least)) return false;
  Long* b = &directions_[size_ * columns_];
  for (Index c = 0; c < columns_; ++c) b[c] = rest_[c] / left;
  split(columns_, b, 1.0L, {high_.row(size_), low_.row(size_)});
  parts[size_] = left;
  mark_[size_] = mark;
  weakest_ = std::min(weakest_, left);
  ++size_;
  return true;
}

void ExtendedPrecisionBasis::solve(Index end, Long* b) const {
  for (Index i = 0; i < end; ++i) {
    const Long* l = &parts_[i * columns_];
    for (Index j = 0; j < i; ++j) b[i] -= l[j] * b[j];
    b[i] /= l[i];
  }
}

void ExtendedPrecisionBasis::solve_transposed(Index end, Long* b) const {
  for (Index i = end - 1; i >= 0; --i) {
    const Long* l = &parts_[i * columns_];
    b[i] /= l[i];
    for (Index j = 0; j < i; ++j) b[j] -= l[j] * b[i];
  }
}

}  // namespace hurcules

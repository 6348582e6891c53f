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

// takes the parts along four directions, b and the three after it, out of v: sums that do not wait
// for each other, and one store for four
void take_out(Index size, const Long* b, Long* v, Long* parts) {
  const Long *b1 = b + size, *b2 = b1 + size, *b3 = b2 + size;
  Long p0 = 0.0L, p1 = 0.0L, p2 = 0.0L, p3 = 0.0L;
  for (Index c = 0; c < size; ++c) {
    const Long x = v[c];
    p0 += b[c] * x;
    p1 += b1[c] * x;
    p2 += b2[c] * x;
    p3 += b3[c] * x;
  }
  for (Index c = 0; c < size; ++c) v[c] -= (p0 * b[c] + p1 * b1[c]) + (p2 * b2[c] + p3 * b3[c]);
  parts[0] += p0;
  parts[1] += p1;
  parts[2] += p2;
  parts[3] += p3;
}

}  // namespace

void ExtendedPrecisionBasis::reserve(Index columns, Index rows) {
  const std::size_t directions = static_cast<std::size_t>(std::min(columns, rows));
  const std::size_t width = static_cast<std::size_t>(columns);
  directions_.resize(std::max(directions_.size(), directions * width));
  parts_.resize(std::max(parts_.size(), directions * width));
  rest_.resize(std::max(rest_.size(), width));
  mark_.resize(std::max(mark_.size(), directions));
}

void ExtendedPrecisionBasis::start(Index columns) {
  columns_ = columns;
  size_ = 0;
  weakest_ = 1.0L;
}

Long ExtendedPrecisionBasis::dot(Index j, const Long* v) const {
  const Long* b = direction(j);
  Long sum = 0.0L;
  for (Index c = 0; c < columns_; ++c) sum += b[c] * v[c];
  return sum;
}

Long ExtendedPrecisionBasis::remove(const Long* row, Long* rest, Long* parts) const {
  std::copy_n(row, columns_, rest);
  std::fill_n(parts, size_, 0.0L);
  Long left = norm(columns_, row);
  for (int pass = 0; pass < kCleanings && size_ > 0; ++pass) {
    Index j = 0;
    for (; j + 4 <= size_; j += 4) take_out(columns_, direction(j), rest, parts + j);
    for (; j < size_; ++j) {
      const Long part = dot(j, rest);
      const Long* b = direction(j);
      for (Index c = 0; c < columns_; ++c) rest[c] -= part * b[c];
      parts[j] += part;
    }
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

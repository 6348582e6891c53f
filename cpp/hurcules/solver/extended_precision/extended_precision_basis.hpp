// Orthonormal directions of rows one after the other, in long double, each cleaned until it stays
// orthogonal: row = sum_j l_j b_j. The cleaning splits every number into two doubles, which the
// kernels take several at a time (kernels.hpp).
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"
#include "hurcules/solver/kernels/kernels.hpp"
#include "hurcules/solver/kernels/padded.hpp"

namespace hurcules {

class ExtendedPrecisionBasis {
 public:
  using Long = long double;
  void reserve(Index columns, Index rows);
  void start(Index columns);
  // Adds a row, `mark` says which; false, and nothing is changed, when no more than `least` of it
  // is outside the directions so far.
  bool add(const Long* row, Index mark, Long least);
  // what is left of a row outside all directions, in `rest`, and its parts along them
  Long remove(const Long* row, Long* rest, Long* parts) const;
  // L m = b and L' m = b over directions [0, end), in place
  void solve(Index end, Long* b) const;
  void solve_transposed(Index end, Long* b) const;

  [[nodiscard]] Index size() const { return size_; }
  [[nodiscard]] Index mark(Index j) const { return mark_[j]; }
  [[nodiscard]] const Long* direction(Index j) const { return &directions_[j * columns_]; }
  [[nodiscard]] Long dot(Index j, const Long* v) const;
  // the smallest part by which a row stood out
  [[nodiscard]] Long weakest() const { return weakest_; }

 private:
  // numbers times `scale` into two doubles
  static void split(Index size, const Long* v, Long scale, kernels::Split out);

  Index columns_ = 0, size_ = 0;
  Long weakest_ = 1.0L;
  std::vector<Long> directions_, parts_, rest_;
  std::vector<Index> mark_;
  PaddedRows high_, low_;  // of directions_
  mutable PaddedVector rest_high_, rest_low_, part_high_, part_low_;
};

}  // namespace hurcules

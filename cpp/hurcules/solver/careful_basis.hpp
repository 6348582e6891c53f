// Orthonormal directions of rows one after the other, in long double or Wide, each cleaned until it
// stays orthogonal: row = sum_j l_j b_j.
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

template <class Scalar>
class CarefulBasis {
 public:
  void reserve(Index columns, Index rows);
  void start(Index columns);
  // Adds a row, `mark` says which; false, and nothing is changed, when no more than `least` of it
  // is outside the directions so far.
  bool add(const Scalar* row, Index mark, Scalar least);
  // what is left of a row outside all directions, in `rest`, and its parts along them
  Scalar remove(const Scalar* row, Scalar* rest, Scalar* parts) const;
  // L m = b and L' m = b over directions [0, end), in place
  void solve(Index end, Scalar* b) const;
  void solve_transposed(Index end, Scalar* b) const;

  [[nodiscard]] Index size() const { return size_; }
  [[nodiscard]] Index mark(Index j) const { return mark_[j]; }
  [[nodiscard]] const Scalar* direction(Index j) const { return &directions_[j * columns_]; }
  [[nodiscard]] Scalar dot(Index j, const Scalar* v) const;
  // the smallest part by which a row stood out
  [[nodiscard]] Scalar weakest() const { return weakest_; }

 private:
  Index columns_ = 0, size_ = 0;
  Scalar weakest_ = 1.0L;
  std::vector<Scalar> directions_, parts_, rest_;
  std::vector<Index> mark_;
};

}  // namespace hurcules

// What is left to the levels behind a smooth transition (nullspace_bases.hpp): x = x_above + B t'.
//
// The columns of B (n, f) are directions of the levels before, each times its weight: 1 for a
// direction that nobody took, 0 < w < 1 for one that a level gave back in part. What the levels
// before keep entirely is no column; B' c = 0 for each such combination c of their rows.
#pragma once

#include <vector>

#include "hurcules/solver/kernels/padded.hpp"

namespace hurcules {

class WeightedNullspaceBasis {
 public:
  // memory for n unknowns and this number of levels; only where the transition is smooth
  void reserve(Index unknowns, Index levels);
  // B = I: nothing was handed over
  void start_whole();
  // no columns yet, behind `level`, whose basis had the basis `before` of t'_before, (f_before)
  void start(const WeightedNullspaceBasis& before, Index before_unknowns, Index unknowns,
             int level);
  // one more column: a direction of t'_before, unit and padded, times its weight
  void add(const double* direction, double weight);
  // x may not move along c, (n) padded
  void keep(const double* c);

  [[nodiscard]] bool whole() const { return before_ == nullptr; }
  [[nodiscard]] Index size() const { return size_; }  // f
  // the level gave directions back, so its rows may move
  [[nodiscard]] bool handed_over(int level) const { return !whole() && handed_[level] != 0; }
  // by how much dx (n) moves what the levels before keep entirely
  [[nodiscard]] double moved(const double* dx) const;

  // B' v, padded
  void coordinates(const double* v, double* out) const;
  // x += B t
  void add_step(const double* t, double* x) const;
  // the t of a step dx = B t
  void step_of(const double* dx, double* t) const;

 private:
  const WeightedNullspaceBasis* before_ = nullptr;
  PaddedRows columns_;         // (f, n), of B
  PaddedRows in_before_;       // (f, f_before), unit
  PaddedRows kept_;            // (., n), unit
  PaddedVector weight_;        // (f)
  mutable PaddedVector part_;  // (n)
  std::vector<char> handed_;   // by level
  Index size_ = 0, kept_count_ = 0;
};

}  // namespace hurcules

// One orthonormal basis for all levels: the directions of the equality rows, in their order, then
// the rest.
//
// Only equality rows take directions away from lower levels, so the basis does not depend on any
// working set and is computed once a solve: row i = sum_j L(i, j) q_j. The first rank_before(k)
// directions belong to the levels above k.  [T 2.2.15-23]
//
// Where a level gave weak directions back, the levels behind it have a basis of their own
// (nullspace_bases.hpp): q_j and L are then those of t', x = x_above + B t', rows a B, and
// rank_before(k) counts from there on.
#pragma once

#include <vector>

#include "hurcules/solver/kernels/orthogonal_factor.hpp"
#include "hurcules/solver/problem/row_table.hpp"
#include "hurcules/solver/problem/weighted_nullspace_basis.hpp"

namespace hurcules {

class NullspaceBasis {
 public:
  void reserve(Index unknowns, Index rows, Index levels);
  // directions and coordinates of all equality rows
  void build(const RowTable& rows);
  // the same for the levels behind `level`, with the columns that `basis` was given
  void build_behind(const RowTable& rows, int level);
  [[nodiscard]] WeightedNullspaceBasis& weighted_basis() { return basis_; }
  [[nodiscard]] const WeightedNullspaceBasis& weighted_basis() const { return basis_; }
  void reserve_basis(Index unknowns, Index levels);
  // the remaining directions, and the coordinates of all inequality rows
  void complete(const RowTable& rows);

  [[nodiscard]] Index unknowns() const { return factor_.columns(); }  // of t'
  [[nodiscard]] Index stride() const { return factor_.stride(); }
  [[nodiscard]] Index x_stride() const { return x_stride_; }
  [[nodiscard]] Index rank_before(int level) const { return rank_[level]; }
  // q_j as a step of x, padded: B q_j
  [[nodiscard]] const double* direction(Index j) const { return directions_ + j * x_stride_; }
  // q_j, padded to stride()
  [[nodiscard]] const double* unit_direction(Index j) const { return factor_.direction(j); }
  // L(i, .) of a row of the table; of an inequality row only once complete
  [[nodiscard]] const double* coordinates(const Row& row) const {
    return row.dense < 0 ? transposed_.row(row.row) : factor_.coordinates(row.dense);
  }
  [[nodiscard]] const double* equality_coordinates(Index dense) const {
    return factor_.coordinates(dense);
  }
  // dense row that gave direction j
  [[nodiscard]] Index pivot(Index j) const { return factor_.pivot(j); }
  // Takes the parts along the first r directions out of y (padded). Behind a smooth transition y, a
  // force on x, becomes the step of x that it makes in the other directions: B (B'y less those
  // parts).
  void remove_first(Index r, double* y);
  // |y less its parts along the first r directions| of a basis that is whole
  double free_part(Index r, const double* y, double* work);
  // y += the part of a step of x in the directions from r on; the basis is complete
  void add_free_part(Index r, const double* step, double* y) const;
  // the level of an equality row gave directions back to this basis
  [[nodiscard]] bool handed_over(const RowTable& rows, int dense) const {
    return basis_.handed_over(rows[rows.row_of_dense(dense)].level);
  }

 private:
  void build_levels(const RowTable& rows, int first);
  void find_rest();
  void add_direction(const RowTable& rows);
  void find_images(Index from);

  OrthogonalFactor factor_;
  PaddedRows transposed_;  // (n, n): row b has coordinate b of every direction
  PaddedVector part_, rest_;
  std::vector<Index> rank_;
  const double* directions_ = nullptr;  // of the factor, or images_
  Index x_stride_ = 0;
  WeightedNullspaceBasis basis_;
  PaddedRows images_;                        // (f, n): B q_j
  mutable PaddedVector step_, coordinates_;  // (n)
  bool complete_ = false;
};

}  // namespace hurcules

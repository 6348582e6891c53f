// One orthonormal basis for all levels: the directions of the equality rows, in their order, then
// the rest.
//
// Only equality rows take directions away from lower levels, so the basis does not depend on any
// working set and is computed once a solve: row i = sum_j L(i, j) q_j. The first rank_before(k)
// directions belong to the levels above k.  [T 2.2.15-23]
#pragma once

#include <vector>

#include "hurcules/solver/orthogonal_factor.hpp"
#include "hurcules/solver/row_table.hpp"

namespace hurcules {

class Chain {
 public:
  void reserve(Index unknowns, Index rows, Index levels);
  // directions and coordinates of all equality rows
  void build(const RowTable& rows);
  // the remaining directions, and the coordinates of all inequality rows
  void complete(const RowTable& rows);

  [[nodiscard]] Index unknowns() const { return factor_.columns(); }
  [[nodiscard]] Index stride() const { return factor_.stride(); }
  [[nodiscard]] Index rank_before(int level) const { return rank_[level]; }
  // q_j, padded
  [[nodiscard]] const double* direction(Index j) const { return factor_.direction(j); }
  // L(i, .) of a row of the table; of an inequality row only once complete
  [[nodiscard]] const double* coordinates(const Row& row) const {
    return row.dense < 0 ? transposed_.row(row.row) : factor_.coordinates(row.dense);
  }
  [[nodiscard]] const double* equality_coordinates(Index dense) const {
    return factor_.coordinates(dense);
  }
  // dense row that gave direction j
  [[nodiscard]] Index pivot(Index j) const { return factor_.pivot(j); }
  // takes the parts along the first r directions out of y (padded)
  void remove_first(Index r, double* y);

 private:
  void find_rest();

  OrthogonalFactor factor_;
  PaddedRows transposed_;  // (n, n): row b has coordinate b of every direction
  PaddedVector part_, rest_;
  std::vector<Index> rank_;
  bool complete_ = false;
};

}  // namespace hurcules

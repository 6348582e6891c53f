// The orthogonal chain: one basis of R^n that serves every level.
//
// The equality rows of all levels, in order, are made orthonormal (Gram-Schmidt with
// reorthogonalisation): rank(k) directions q_0 .. span the equality rows of levels 0..k, and the
// directions after them are the Z_k that level k leaves to the levels below [T 2.2.15, 3.3.34]. It
// depends on no working set.
#pragma once

#include <vector>

#include "hurcules/solver/row_table.hpp"

namespace hurcules {

class Chain {
 public:
  void reserve(Index unknowns, Index rows, Index levels);
  // directions and ranks out of the equality rows
  void build(const RowTable& rows);
  // fills the basis up to n directions and gives every inequality row its coordinates, once a solve
  void complete(const RowTable& rows);

  [[nodiscard]] Index unknowns() const { return Q_.cols(); }
  // number of directions that levels 0 .. k-1 have taken
  [[nodiscard]] Index rank_before(int k) const { return rank_[k]; }
  [[nodiscard]] const double* direction(Index j) const { return Q_.row(j).data(); }
  // coordinates of row i: a_i = sum_j coordinates(i)[j] q_j
  [[nodiscard]] const double* coordinates(int i) const { return L_.row(i).data(); }
  // the equality row that gave direction j
  [[nodiscard]] int pivot_row(Index j) const { return pivot_row_[j]; }
  // removes from y its part along the first r directions
  void remove_first(Index r, Vector& y) const;

 private:
  // v_ minus its parts along the directions so far; the parts go to l
  void orthogonalize(double* l);
  void read_row(const RowTable& rows, int i);

  Matrix Q_;                    // (n, n), directions as rows
  Matrix L_;                    // (rows, n), coordinates
  Vector v_, rest_;             // (n)
  std::vector<Index> rank_;     // (levels + 1)
  std::vector<int> pivot_row_;  // (n)
  Index count_ = 0;
  bool complete_ = false;
};

}  // namespace hurcules

// The bases of all levels: one for all of them, and, where the transition is smooth, one more
// behind each level that gives weak directions back.
//
// By the strict rule a direction that a level's equality rows see is lost to the levels below
// however weak its singular value sigma is, and is theirs again at sigma = 0: a jump. Smooth, the
// levels below work in x = x_above + B D t with
//     D = I - sum (1 - w_i) v_i v_i'  over the level's own directions v_i,
//     w^2 = h p^2 / ((1 - h) + h p^2),  h = (1 - (sigma_i / rho)^2)^2 below sigma_i = rho, else 0,
// (solver.md §6): w is 0 where sigma_i >= rho, bit for bit the strict rule, and
// goes to 1 as sigma_i goes to 0. sigma_i and rho are those of the level, in its own units. p is
// the smallest rho / |a| of the levels below: one of them answers with w^2 / (w^2 + p^2) of its
// residual, so by this p none takes more than about the part h.
//
// The price, the leak: row r of the level moves by u_i(r) sigma_i w_i t'_i, and a level below with
// unit rows steps by |t'| <= |residual| / (2 rho) where no limit pushes, so it moves the level by
// at most max(sigma w) |residual| / (2 rho).
//
// A level with rho = 0 never gives back. A level below with rho = 0 (or less than 1e-4 |a|) would
// take a direction whole however small w is: with p = 0 the rule above it stays strict.
#pragma once

#include <vector>

#include "hurcules/solver/problem/level_svd.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"

namespace hurcules {

class NullspaceBases {
 public:
  void reserve(Index unknowns, Index rows, Index levels, bool smooth);
  // the basis of all levels
  void start(const RowTable& rows, HierarchyView hierarchy);
  // level k is solved: gives its weak directions to a new basis for the levels behind it
  void close(const RowTable& rows, LevelSvd& svd, int k);

  // the first level behind one that gave directions back; -1: none did
  [[nodiscard]] int handed_to() const;
  [[nodiscard]] NullspaceBasis& of(int level) { return nullspaces_[segment_[level]]; }
  [[nodiscard]] const NullspaceBasis& of(int level) const { return nullspaces_[segment_[level]]; }

 private:
  // smallest rho / |a| below each level
  void find_receivers(const RowTable& rows, HierarchyView hierarchy);
  void fill_basis(const RowTable& rows, const LevelSvd& svd, int k);

  bool smooth_ = false;
  std::vector<NullspaceBasis> nullspaces_;
  std::vector<int> segment_;  // by level
  int used_ = 1;
  std::vector<double> rho_, receiver_;  // by level
  PaddedVector work_;
};

// w of a singular value that is the part `ratio` of the level's rho
[[nodiscard]] double transition_weight(double ratio, double receiver);

}  // namespace hurcules

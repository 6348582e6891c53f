// The hierarchical matrix decomposition of the rows that a working set holds [T 3.3.81].
//
//     J_k Z_{k-1} = U_k S_k Y~_k',   Y_k = Z_{k-1} Y~_k,   Z_k = Z_{k-1} Z~_k      [T 3.3.30-34]
// S_k (rank, rank) is diagonal: singular values, or upper triangular: complete orthogonal
// decomposition [T 3.5.123-124]. Y_1, Y_2, ..., Z_p are the rows of one orthogonal matrix, the
// basis.
#pragma once

#include <span>
#include <vector>

#include "hurcules/solver/problem/row_table.hpp"
#include "hurcules/solver/thesis/level_factor.hpp"

namespace hurcules {

// A row of a working set, as  sign a x = target: at its upper side with sign 1, at its lower side
// with sign -1, so that the multiplier of an inequality row wants to be >= 0 [T 3.4.104-105].
struct HeldLimit {
  int row = 0;  // in the table
  double sign = 1.0;
  double target = 0.0;  // sign * limit
};

class HierarchicalDecomposition {
 public:
  explicit HierarchicalDecomposition(FactorKind kind) : kind_(kind) {}
  // rows[k] is the most rows that level k may hold; nothing below allocates
  void reserve(Index unknowns, std::span<const Index> rows);
  void start();  // no level: Z_0 = I
  void add_level(const RowTable& table, std::span<const HeldLimit> held);

  [[nodiscard]] Index free() const { return unknowns_ - used_; }
  [[nodiscard]] const LevelFactor& level(Index k) const { return levels_[k]; }
  // Y_k are the rows first(k) .. first(k) + rank - 1 of the basis, Z_p the last free() of it
  [[nodiscard]] Index first(Index k) const { return levels_[k].first; }
  [[nodiscard]] const double* direction(Index j) const { return basis_.row(j).data(); }  // (n)
  // x += Y_k (S'S + rho^2 I)^+ S' U' residual  [T 3.3.37-38], [T 3.5.125-126]
  // residual (rows) becomes its unreachable part V V' residual
  void step(Index k, double rho, VectorRef residual, Vector& x);
  // mu (rows) = -U S'^-1 Y_k' gradient  [T 3.4.115]
  void multipliers(Index k, const Vector& gradient, VectorRef mu);
  // y += scale Y_k Y_k' x
  void add_projection(Index k, double scale, const Vector& x, Vector& y) const;

 private:
  struct Level : LevelFactor {
    Index first = 0;
  };

  void extend_basis(Level& level);

  FactorKind kind_;
  Index unknowns_ = 0, used_ = 0;
  std::size_t size_ = 0;
  std::vector<Level> levels_;
  Matrix basis_;  // (n, n)
  Matrix B_;      // (rows, n): rows of a level in the coordinates of Z_{k-1}
  FactorRoom room_;
  Matrix normal_;  // (n, n), for the damped inverse
  Vector s_, w_;   // (n)
};

}  // namespace hurcules

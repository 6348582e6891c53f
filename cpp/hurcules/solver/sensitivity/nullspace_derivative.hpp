// What the levels above leave to a level, as a square matrix, and how it moves with their rows.
//
//     B_0 = I,   B_{k+1} = B_k Psi_k,   Psi_k = psi(M'M),   M = A B_k,   A the equality rows of k
// psi(sigma^2) is the weight w of nullspace_bases.hpp; by the strict rule it is 1 at sigma = 0,
// else 0. A level answers for B D, D any rotation, as for B: so this B is as good as the columns of
// the solve (weighted_nullspace_basis.hpp), and unlike them it is differentiable where singular
// values meet. With M = U diag(sigma) V',
//     dPsi = V (D o (V'(M'dM + dM'M) V) + diag(dpsi)) V',
//     D_ij = (psi_i - psi_j) / (sigma_i^2 - sigma_j^2)
// and dpsi what rho and the receivers change. The adapted regularisation of the level [T §4.3.3]
// moves with its smallest singular value, d sigma = u'dM v.
#pragma once

#include <vector>

#include "hurcules/solver/sensitivity/solved_hierarchy.hpp"

namespace hurcules {

// p of the levels below a level: the least rho / |a|, and whose
struct Receiver {
  double p = 0.0;
  int level = -1;  // -1: p does not move
  int row = 0;     // of the table
};
[[nodiscard]] std::vector<Receiver> receivers(const SolvedHierarchy& solved);

// changes of what decides the directions behind a level, or a gradient in them
struct DirectionsChange {
  Matrix A;          // (m, n) of its equality rows
  Matrix B;          // (n, n) of what it was left
  double rho = 0.0;  // of the level, as it was asked for
  double receiver = 0.0;
};

class NullspaceDerivative {
 public:
  // of level k; `basis` (n, n) and `free`, the rank of it, are left to it
  NullspaceDerivative(const SolvedHierarchy& solved, int k, double receiver, Matrix basis,
                      Index free);

  [[nodiscard]] const Matrix& basis() const { return B_; }
  // B_{k+1}, and its rank
  [[nodiscard]] Matrix behind() const { return B_ * psi_matrix(); }
  [[nodiscard]] Index free_behind() const;
  // of the equality rows in what is left, as many as there can be, largest first
  [[nodiscard]] Vector singular_values() const { return sigma_.head(count_); }
  [[nodiscard]] Index rank() const { return rank_; }
  [[nodiscard]] Vector handed_over() const { return psi_.head(count_); }  // psi of each
  [[nodiscard]] const std::vector<int>& rows() const { return rows_; }    // of the table, (m)

  // d B_{k+1}, (n, n)
  [[nodiscard]] Matrix behind_change(const DirectionsChange& change) const;
  // d of the regularisation that the level was solved with
  [[nodiscard]] double rho_change(const DirectionsChange& change) const;
  // both transposed, added to `gradient`
  void add_gradient(const Matrix& behind_bar, double rho_bar, DirectionsChange& gradient) const;

 private:
  void decompose(const SolvedHierarchy& solved);
  void weigh();
  void find_rho_rates(const SolvedHierarchy& solved, int k);
  [[nodiscard]] double part(Index i) const;  // u_i: 1 - (sigma_i / rho)^2, not below 0
  [[nodiscard]] double difference(Index i, Index j) const;
  [[nodiscard]] Matrix psi_matrix() const { return V_ * psi_.asDiagonal() * V_.transpose(); }
  [[nodiscard]] Matrix image_change(const DirectionsChange& change) const;

  double rho_, receiver_;  // as asked for
  bool smooth_;
  Matrix B_, A_;                         // (n, n), (m, n)
  std::vector<int> rows_;                // (m)
  Eigen::MatrixXd MV_, V_;               // (m, n) columns sigma_i u_i; (n, n)
  Vector sigma_, psi_;                   // (n)
  Vector psi_by_rho_, psi_by_receiver_;  // (n)
  Matrix differences_;                   // (n, n), D
  Index free_, count_ = 0, rank_ = 0;
  double rho_by_rho_ = 1.0, rho_by_sigma_ = 0.0;
  Matrix sigma_by_M_;  // (m, n), u v' of the smallest singular value
};

// of every final level
[[nodiscard]] std::vector<NullspaceDerivative> nullspace_derivatives(const SolvedHierarchy& solved);

}  // namespace hurcules

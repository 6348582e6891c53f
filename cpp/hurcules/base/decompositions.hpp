// Eigen's decompositions of dynamic matrices, compiled once: each takes the compiler seconds.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "hurcules/base/types.hpp"

namespace hurcules {

// A = U diag(sigma) V', sigma falls
struct Svd {
  Eigen::MatrixXd U, V;
  Vector sigma;
};
// `vectors`: Eigen's ComputeThinU, ComputeFullV ..., without one U and V stay empty
[[nodiscard]] Svd svd(const Eigen::MatrixXd& A, unsigned vectors = 0);

// the shortest x of the least |A x - b|, by a complete orthogonal decomposition
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
// by pivoted QR; columns below `threshold` of the longest are none
[[nodiscard]] Index rank(const Matrix& A, double threshold);
// of a square, regular matrix
[[nodiscard]] Matrix inverse(const Matrix& A);

// A = Q R by reflections
class QrFactor {
 public:
  explicit QrFactor(const Eigen::MatrixXd& A) : qr_(A) {}
  // least squares of A x = b
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  // X = Q X
  void apply_q(Eigen::MatrixXd& X) const;
  void apply_q(Eigen::VectorXd& x) const;
  // R above the diagonal
  [[nodiscard]] const Eigen::MatrixXd& packed() const { return qr_.matrixQR(); }

 private:
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
};

// of a symmetric matrix; allocates when its size changes
class LdltFactor {
 public:
  void compute(const Matrix& A);
  void solve_in_place(Matrix& X) const;
  void solve_in_place(Vector& x) const;

 private:
  Eigen::LDLT<Matrix> ldlt_;
};

}  // namespace hurcules

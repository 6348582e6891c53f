#include "hurcules/base/decompositions.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace hurcules {

Svd svd(const Eigen::MatrixXd& A, unsigned vectors) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> found(A, vectors);
  Svd result;
  if (found.computeU()) result.U = found.matrixU();
  if (found.computeV()) result.V = found.matrixV();
  result.sigma = found.singularValues();
  return result;
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

Index rank(const Matrix& A, double threshold) {
  Eigen::ColPivHouseholderQR<Matrix> qr(A);
  qr.setThreshold(threshold);
  return qr.rank();
}

Matrix inverse(const Matrix& A) {
  return A.inverse();
}

Eigen::VectorXd QrFactor::solve(const Eigen::VectorXd& b) const {
  return qr_.solve(b);
}

void QrFactor::apply_q(Eigen::MatrixXd& X) const {
  X.applyOnTheLeft(qr_.householderQ());
}

void QrFactor::apply_q(Eigen::VectorXd& x) const {
  x.applyOnTheLeft(qr_.householderQ());
}

void LdltFactor::compute(const Matrix& A) {
  ldlt_.compute(A);
}

void LdltFactor::solve_in_place(Matrix& X) const {
  ldlt_.solveInPlace(X);
}

void LdltFactor::solve_in_place(Vector& x) const {
  ldlt_.solveInPlace(x);
}

}  // namespace hurcules

#include "hurcules/solver/sensitivity/row_space.hpp"


#include "hurcules/solver/kernels/dense_decompositions.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

bool RowSpace::add(const Vector& row) {
  Vector parts = Q_.transpose() * row;
  Vector rest = row - Q_ * parts;
  // twice is enough: the second pass takes the rounding of the first
  const Vector again = Q_.transpose() * rest;
  rest -= Q_ * again;
  parts += again;
  const double length = rest.norm();
  if (length <= tolerance::kRank * row.norm()) return false;
  const Index r = size();
  Q_.conservativeResize(Eigen::NoChange, r + 1);
  Q_.col(r) = rest / length;
  L_.conservativeResize(r + 1, r + 1);
  L_.row(r).head(r) = parts.transpose();
  L_.col(r).setZero();
  L_(r, r) = length;
  return true;
}

Vector RowSpace::free_part(const Vector& v) const {
  Vector rest = v - Q_ * (Q_.transpose() * v);
  return rest - Q_ * (Q_.transpose() * rest);
}

Eigen::MatrixXd RowSpace::free_basis() const {
  const Index n = Q_.rows();
  if (size() == 0) return Eigen::MatrixXd::Identity(n, n);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(Q_);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(n, n).rightCols(n - size());
  basis.applyOnTheLeft(qr.householderQ());
  return basis;
}

Vector RowSpace::solve(const Vector& h) const {
  return Q_ * L_.triangularView<Eigen::Lower>().solve(h);
}

Vector RowSpace::solve_transposed(const Vector& v) const {
  return L_.transpose().triangularView<Eigen::Upper>().solve(Q_.transpose() * v);
}

}  // namespace hurcules

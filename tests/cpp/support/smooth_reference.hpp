// Smooth rank transition by dense algebra, from its definition alone (nullspace_bases.hpp): x =
// x_above + B t', after each level B := B V diag(w) with V the right singular vectors of its
// equality rows. Shares no factor, threshold or formula of the solver's code.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "hurcules/solver/hierarchy.hpp"

namespace hurcules_test {

class SmoothReference {
 public:
  // p: rho / |a| of the levels that receive
  SmoothReference(hurcules::Index unknowns, double p)
      : p_(p), B_(Eigen::MatrixXd::Identity(unknowns, unknowns)) {}

  // what the levels so far leave, (n, f)
  [[nodiscard]] const Eigen::MatrixXd& basis() const { return B_; }

  // the step of a level without limits
  [[nodiscard]] hurcules::Vector step(const hurcules::Level& level,
                                      const hurcules::Vector& x_above) const {
    const Eigen::MatrixXd M = level.A * B_;
    Eigen::MatrixXd normal = M.transpose() * M;
    normal.diagonal().array() += level.rho * level.rho;
    return B_ * normal.llt().solve(M.transpose() * (level.lower - level.A * x_above));
  }

  // the smallest singular value of a level in what is left to it
  [[nodiscard]] double smallest(const hurcules::Level& level) const {
    return Eigen::JacobiSVD<Eigen::MatrixXd>(level.A * B_).singularValues().minCoeff();
  }

  // the rows of `level`, all equalities, are through
  void close(const hurcules::Level& level) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(level.A * B_, Eigen::ComputeFullV);
    Eigen::MatrixXd next(B_.rows(), B_.cols());
    hurcules::Index kept = 0;
    for (hurcules::Index i = 0; i < B_.cols(); ++i) {
      const bool seen = i < svd.singularValues().size();
      const double w = seen ? weight(svd.singularValues()[i], level.rho) : 1.0;
      if (w > 0.0) next.col(kept++) = w * (B_ * svd.matrixV().col(i));
    }
    B_ = next.leftCols(kept);
  }

  [[nodiscard]] double weight(double sigma, double rho) const {
    if (sigma >= rho) return 0.0;
    const double h = std::pow(1.0 - std::pow(sigma / rho, 2), 2);
    return std::sqrt(h * p_ * p_ / ((1.0 - h) + h * p_ * p_));
  }
  // the largest sigma w there is
  [[nodiscard]] double most_leak(double rho) const {
    double most = 0.0;
    for (int i = 0; i <= 10000; ++i)
      most = std::max(most, i * 1e-4 * rho * weight(i * 1e-4 * rho, rho));
    return most;
  }

 private:
  double p_;
  Eigen::MatrixXd B_;
};

}  // namespace hurcules_test

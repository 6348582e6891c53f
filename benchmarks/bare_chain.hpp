// The bare chain: Householder QR of the rows of all levels, stacked, with Q formed. Every way of
// solving a hierarchy has to build such a basis, so it is the yardstick of the solver's time.
#pragma once

#include <Eigen/QR>

#include "hurcules/solver/hierarchy.hpp"

namespace hurcules_benchmark {

class BareChain {
 public:
  // takes the rows of all levels but simple bounds, transposed; not part of what is timed
  void read(const hurcules::Hierarchy& levels, hurcules::Index unknowns) {
    stacked_.resize(unknowns, 0);
    for (const hurcules::Level& level : levels) {
      if (level.bounds) continue;
      stacked_.conservativeResize(unknowns, stacked_.cols() + level.rows());
      stacked_.rightCols(level.rows()) = level.A.transpose();
    }
  }
  void compute() {
    qr_.compute(stacked_);
    Q_ = qr_.householderQ() * Eigen::MatrixXd::Identity(stacked_.rows(), stacked_.rows());
  }

 private:
  Eigen::MatrixXd stacked_, Q_;
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
};

}  // namespace hurcules_benchmark

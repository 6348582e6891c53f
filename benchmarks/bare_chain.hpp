// What a solve is measured against: the basis that every way of solving a hierarchy has to build.
#pragma once

#include <Eigen/QR>
#include <vector>

#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules_benchmark {

// Householder QR of the rows of all levels, stacked, with Q formed: the usual library code.
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

// The floor: the solver's own chain of the equality rows and nothing else, basis and coordinates.
class Floor {
 public:
  // not part of what is timed
  void read(const hurcules::Hierarchy& levels, hurcules::Index unknowns) {
    std::vector<hurcules::LevelView> views;
    hurcules::Index rows = 0;
    for (const hurcules::Level& level : levels) {
      views.push_back(hurcules::view(level));
      rows += level.rows();
    }
    const auto count = static_cast<hurcules::Index>(levels.size());
    rows_.reserve(unknowns, rows, count);
    chain_.reserve(unknowns, rows, count);
    (void)rows_.read(views);
  }
  void compute() {
    chain_.build(rows_);
    chain_.complete(rows_);
  }

 private:
  hurcules::RowTable rows_;
  hurcules::NullspaceBasis chain_;
};

}  // namespace hurcules_benchmark

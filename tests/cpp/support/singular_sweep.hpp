// Hierarchies with one row that comes to depend on others as s goes to 0: rows of its own level
// (kinematic singularity) or of the level above (algorithmic). n = 19, levels of 3, 3, 3, 3, 3, 2,
// 2 unit equality rows, rho 0.1, with or without a box on top: docs/solver.md §6.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/draw.hpp"

namespace hurcules_test {

class SingularSweep {
 public:
  static constexpr Index kUnknowns = 19;
  static constexpr double kRho = 0.1, kBox = 1.0;

  SingularSweep(bool algorithmic, bool boxed, unsigned seed, double rho = kRho)
      : algorithmic_(algorithmic), boxed_(boxed), seed_(seed) {
    Draw draw(seed);
    if (boxed) levels_.push_back(box(kUnknowns, kBox));
    for (const Index m : {3, 3, 3, 3, 3, 2, 2}) {
      levels_.push_back(equality(draw.unit_rows(m, kUnknowns), draw.vector(m), rho));
    }
    const Level& source = levels_[singular() - (algorithmic ? 1 : 0)];
    const Index rows = algorithmic ? 3 : 2;
    inside_ = (draw.vector(rows).transpose() * source.A.topRows(rows)).transpose().normalized();
    outside_ = draw.vector(kUnknowns);
    outside_ = (outside_ - inside_ * inside_.dot(outside_)).normalized();
  }

  // the singular row is of length 1, and s is what stands out of the span, about
  [[nodiscard]] Hierarchy at(double s) const {
    Hierarchy levels = levels_;
    levels[singular()].A.row(2) = (std::sqrt(1.0 - s * s) * inside_ + s * outside_).transpose();
    return levels;
  }
  // the same with another regularisation of all levels but the box
  [[nodiscard]] SingularSweep with_rho(double rho) const {
    return SingularSweep(algorithmic_, boxed_, seed_, rho);
  }
  // the level that loses a direction at s = 0
  [[nodiscard]] std::size_t singular() const { return boxed_ ? 2 : 1; }
  [[nodiscard]] bool boxed() const { return boxed_; }
  [[nodiscard]] std::string name() const {
    return std::string(algorithmic_ ? "algorithmic" : "kinematic") + (boxed_ ? ", box" : "") +
           ", seed " + std::to_string(seed_);
  }

 private:
  bool algorithmic_, boxed_;
  unsigned seed_;
  Hierarchy levels_;
  Vector inside_, outside_;
};

// check(sweep) on all four kinds
template <typename Check>
void each_sweep(unsigned seeds, Check&& check) {
  for (const bool algorithmic : {false, true}) {
    for (const bool boxed : {false, true}) {
      for (unsigned seed = 0; seed < seeds; ++seed) {
        const SingularSweep sweep(algorithmic, boxed, seed);
        SCOPED_TRACE(sweep.name());
        check(sweep);
      }
    }
  }
}

}  // namespace hurcules_test

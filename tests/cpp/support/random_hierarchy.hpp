// Seeded random hierarchies for the C++ tests; the bulk against the oracle is
// tests/python/test_solver_oracle.py.
#pragma once

#include <random>

#include "hurcules/solver/hierarchy.hpp"

namespace hurcules_test {

class RandomHierarchy {
 public:
  explicit RandomHierarchy(unsigned seed) : generator_(seed) {}

  hurcules::Matrix matrix(hurcules::Index rows, hurcules::Index columns) {
    return hurcules::Matrix::NullaryExpr(rows, columns, [this] { return normal_(generator_); });
  }
  hurcules::Vector vector(hurcules::Index size) {
    return hurcules::Vector::NullaryExpr(size, [this] { return normal_(generator_); });
  }
  hurcules::Level equality(hurcules::Index rows, hurcules::Index unknowns, double rho) {
    const hurcules::Vector target = 2.0 * vector(rows);
    return {.A = matrix(rows, unknowns), .lower = target, .upper = target, .rho = rho};
  }
  hurcules::Level interval(hurcules::Index rows, hurcules::Index unknowns, double rho) {
    const hurcules::Vector lower = vector(rows);
    return {.A = matrix(rows, unknowns),
            .lower = lower,
            .upper = lower + vector(rows).cwiseAbs(),
            .rho = rho};
  }
  // the robot's shape: a box that binds, then levels that want more than it allows
  hurcules::Hierarchy conflicting(hurcules::Index unknowns, double rho) {
    const hurcules::Vector ones = hurcules::Vector::Ones(unknowns);
    hurcules::Hierarchy levels = {hurcules::make_bounds(-0.5 * ones, 0.5 * ones)};
    for (hurcules::Index rows : {3, 3, 3, 2, 2}) {
      levels.push_back(equality(rows, unknowns, rho));
      levels.push_back(interval(2, unknowns, rho));
    }
    return levels;
  }

 private:
  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace hurcules_test

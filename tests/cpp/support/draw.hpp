// Seeded draws for the generators of hierarchies: integers, choices, rows of norm 1.
#pragma once

#include <initializer_list>
#include <limits>
#include <random>

#include "hurcules/solver/hierarchy.hpp"

namespace hurcules_test {

using hurcules::Hierarchy;
using hurcules::Index;
using hurcules::Level;
using hurcules::Matrix;
using hurcules::Vector;

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

class Draw {
 public:
  explicit Draw(unsigned long long seed) : generator_(seed) {}

  double normal() { return normal_(generator_); }
  double uniform(double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(generator_);
  }
  // 10^uniform
  double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  // low .. high, both included
  Index integer(Index low, Index high) {
    return low + static_cast<Index>(generator_() % static_cast<unsigned long long>(high - low + 1));
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double choose(std::initializer_list<double> values) {
    return values.begin()[integer(0, static_cast<Index>(values.size()) - 1)];
  }

  Vector vector(Index size) {
    return Vector::NullaryExpr(size, [this] { return normal(); });
  }
  Vector uniform_vector(Index size, double low, double high) {
    return Vector::NullaryExpr(size, [&] { return uniform(low, high); });
  }
  // rows of norm 1 in random directions, (m, n)
  Matrix unit_rows(Index m, Index n) {
    Matrix A = Matrix::NullaryExpr(m, n, [this] { return normal(); });
    A.rowwise().normalize();
    return A;
  }
  // small whole numbers: ties and exact dependence, (m, n)
  Matrix whole(Index m, Index n, Index most) {
    return Matrix::NullaryExpr(m, n, [&] { return static_cast<double>(integer(-most, most)); });
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

inline Level equality(Matrix A, Vector target, double rho) {
  return {.A = std::move(A), .lower = target, .upper = target, .rho = rho};
}

inline Level interval(Matrix A, Vector lower, Vector upper, double rho) {
  return {.A = std::move(A), .lower = std::move(lower), .upper = std::move(upper), .rho = rho};
}

inline Level box(Index unknowns, double width) {
  const Vector ones = Vector::Ones(unknowns);
  return hurcules::make_bounds(-width * ones, width * ones);
}

// one more row in a level that stores its rows
inline void append_row(Level& level, const Matrix& a, double lower, double upper) {
  const Index m = level.rows();
  level.A.conservativeResize(m + 1, a.cols());
  level.A.row(m) = a.row(0);
  for (Vector* side : {&level.lower, &level.upper}) side->conservativeResize(m + 1);
  level.lower[m] = lower;
  level.upper[m] = upper;
}

}  // namespace hurcules_test

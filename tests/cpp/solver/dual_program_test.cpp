// Strategy: the optimality conditions of thousands of seeded programs, half of them with whole
// numbers and limits through one vertex (ties, dependent rows); always feasible at the origin.
#include "hurcules/solver/thesis/dual_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hurcules {
namespace {

QuadraticProgram program(unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const Index size = 2 + seed % 8, rows = 2 + seed % 13;
  const bool degenerate = seed % 2 == 0;
  const auto number = [&] { return normal(generator); };
  const auto whole = [&] { return degenerate ? std::round(number()) : number(); };
  const Matrix root = Matrix::NullaryExpr(size, size, number);
  QuadraticProgram p;
  p.H = root.transpose() * root + 0.1 * Matrix::Identity(size, size);
  p.g = 3.0 * Vector::NullaryExpr(size, number);
  p.C = Matrix::NullaryExpr(rows, size, whole);
  p.d = Vector::NullaryExpr(rows, [&] { return degenerate ? 0.0 : -std::abs(number()); });
  p.tolerance = Vector::Constant(rows, 1e-12);
  return p;
}

// worst of stationarity, feasibility, sign and complementarity
double residual(const QuadraticProgram& p, const QuadraticAnswer& answer) {
  const Vector gap = p.C * answer.y - p.d;
  const double stationary =
      (p.H * answer.y - p.g - p.C.transpose() * answer.multipliers).lpNorm<Eigen::Infinity>();
  return std::max({stationary, -gap.minCoeff(), -answer.multipliers.minCoeff(),
                   gap.cwiseProduct(answer.multipliers).lpNorm<Eigen::Infinity>()});
}

TEST(DualProgram, EndsAtTheMinimiser) {
  for (unsigned seed = 0; seed < 5000; ++seed) {
    const QuadraticProgram p = program(seed);
    const QuadraticAnswer answer = minimize(p, 1000);
    ASSERT_TRUE(answer.optimal) << "seed " << seed;
    ASSERT_LT(residual(p, answer), 1e-8) << "seed " << seed;
  }
}

TEST(DualProgram, TheLimitOfChangesIsKeptAndSaid) {
  int stopped = 0;
  for (unsigned seed = 1; seed < 200; seed += 2) {
    const QuadraticAnswer answer = minimize(program(seed), 1);
    EXPECT_LE(answer.changes, 2);
    EXPECT_TRUE(answer.y.allFinite());
    stopped += !answer.optimal;
  }
  EXPECT_GT(stopped, 50);
}

TEST(DualProgram, AnIndefiniteMatrixIsNoOptimum) {
  QuadraticProgram p = program(1);
  p.H.setIdentity();
  p.H(0, 0) = -1.0;
  const QuadraticAnswer answer = minimize(p, 100);
  EXPECT_FALSE(answer.optimal);
  EXPECT_EQ(answer.y, Vector::Zero(p.g.size()));
}

}  // namespace
}  // namespace hurcules

// Strategy: the optimality conditions of thousands of seeded problems, half of them with whole
// numbers and limits through one vertex (ties, zero steps, dependent rows). Not tested here: where
// the problems come from (chain, levels).
#include "hurcules/solver/least_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hurcules {
namespace {

struct Problem {
  LeastDistance distance;
  Index rows, size;
};

void fill(Problem& problem, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  problem.size = 2 + seed % 8;
  problem.rows = 2 + seed % 13;
  const bool degenerate = seed % 2 == 0;
  LeastDistance& distance = problem.distance;
  distance.reserve(problem.rows, problem.size);
  distance.start(problem.rows, problem.size);
  distance.z.setZero();
  for (Index j = 0; j < problem.size; ++j) distance.target[j] = 3.0 * normal(generator);
  for (Index i = 0; i < problem.rows; ++i) {
    for (Index j = 0; j < problem.size; ++j) {
      distance.row(i)[j] = degenerate ? std::round(normal(generator)) : normal(generator);
    }
    distance.lower[i] = degenerate ? (i % 2 ? -1.0 : 0.0) : -std::abs(normal(generator));
    distance.upper[i] = degenerate ? (i % 2 ? 0.0 : 1.0) : std::abs(normal(generator));
    distance.tolerance[i] = 1e-11;
  }
}

// worst of stationarity, feasibility and sign
double residual(const Problem& problem) {
  const LeastDistance& distance = problem.distance;
  Vector gradient = distance.z.head(problem.size) - distance.target.head(problem.size);
  double worst = 0.0;
  for (const ActiveSlot& a : distance.active()) {
    gradient += a.multiplier * static_cast<double>(a.side) *
                Eigen::Map<const Vector>(distance.row(a.candidate), problem.size);
    worst = std::max(worst, -a.multiplier);
  }
  for (Index i = 0; i < problem.rows; ++i) {
    const double value = distance.value(i);
    worst = std::max({worst, value - distance.upper[i], distance.lower[i] - value});
  }
  return std::max(worst, gradient.norm());
}

TEST(LeastDistance, PrimalEndsAtTheMinimiser) {
  for (unsigned seed = 0; seed < 5000; ++seed) {
    Problem problem;
    fill(problem, seed);
    int changes = 0;
    ASSERT_TRUE(problem.distance.solve_primal(changes, 1000)) << "seed " << seed;
    ASSERT_LT(residual(problem), 1e-9) << "seed " << seed;
  }
}

TEST(LeastDistance, DualEndsAtTheMinimiserFromAnyWorkingSet) {
  for (unsigned seed = 0; seed < 5000; ++seed) {
    Problem problem;
    fill(problem, seed);
    for (int c = 0; c < problem.rows; c += 2)
      problem.distance.add(c, c % 4 ? Side::Lower : Side::Upper);
    int changes = 0;
    bool raised = false;
    ASSERT_TRUE(problem.distance.solve_dual(changes, 1000, raised)) << "seed " << seed;
    ASSERT_LT(residual(problem), 1e-9) << "seed " << seed;
  }
}

TEST(LeastDistance, RefusesADependentRowAndKeepsTheSet) {
  LeastDistance distance;
  distance.reserve(3, 2);
  distance.start(3, 2);
  const double rows[3][2] = {{1, 0}, {2, 0}, {0, 1}};
  for (int i = 0; i < 3; ++i) std::copy(rows[i], rows[i] + 2, distance.row(i));
  EXPECT_TRUE(distance.add(0, Side::Upper));
  EXPECT_FALSE(distance.add(1, Side::Upper));
  EXPECT_TRUE(distance.add(2, Side::Lower));
  EXPECT_EQ(distance.active().size(), 2u);
  EXPECT_TRUE(distance.full());
}

TEST(LeastDistance, AFreePointIsItsTarget) {
  Problem problem;
  fill(problem, 1);
  problem.distance.lower.setConstant(-1e9);
  problem.distance.upper.setConstant(1e9);
  int changes = 0;
  ASSERT_TRUE(problem.distance.solve_primal(changes, 10));
  EXPECT_EQ(changes, 0);
  EXPECT_EQ(problem.distance.z.head(problem.size), problem.distance.target.head(problem.size));
}

}  // namespace
}  // namespace hurcules

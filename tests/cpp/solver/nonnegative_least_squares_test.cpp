// Strategy: balances that a hand can compute; the optimality conditions on seeded cones, thin ones
// among them (what is left pulls at no direction, and is at right angles to those that push). Not
// tested here: what the directions mean.
#include "hurcules/solver/optimality/nonnegative_least_squares.hpp"

#include <gtest/gtest.h>

#include "support/draw.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;
using Long = long double;

NonnegativeLeastSquares balance(const Matrix& directions, const Vector& b) {
  NonnegativeLeastSquares balance;
  balance.reserve(directions.cols(), directions.rows());
  balance.start(directions.cols());
  for (Index i = 0; i < directions.rows(); ++i) {
    std::copy_n(directions.row(i).data(), directions.cols(), balance.place());
    balance.add();
  }
  const std::vector<Long> wanted(b.begin(), b.end());
  balance.solve(wanted.data());
  return balance;
}

TEST(NonnegativeLeastSquares, ADirectionPushesOrItDoesNothing) {
  const Matrix forward{{1.0, 0.0}};
  const NonnegativeLeastSquares against = balance(forward, Vector{{-2.0, 0.0}});
  EXPECT_EQ(against.weight(0), 2.0L);
  EXPECT_EQ(against.left(), 0.0L);
  const NonnegativeLeastSquares along = balance(forward, Vector{{2.0, 0.0}});
  EXPECT_EQ(along.weight(0), 0.0L);
  EXPECT_EQ(along.left(), 2.0L);
}

TEST(NonnegativeLeastSquares, NothingToBalanceWithIsWhatIsLeft) {
  EXPECT_EQ(balance(Matrix(0, 2), Vector{{3.0, 4.0}}).left(), 5.0L);
}

TEST(NonnegativeLeastSquares, ADirectionThatCameFirstLeavesAgain) {
  // the first pulls most, the other two do it without it
  const double c = std::sqrt(0.5);
  const Matrix directions{{1.0, 0.0, 0.0}, {c, c, 0.0}, {c, -c, 0.0}};
  const NonnegativeLeastSquares found = balance(directions, Vector{{-1.0, -1.0, 0.5}});
  EXPECT_NEAR(static_cast<double>(found.left()), 0.5, 1e-15);
  EXPECT_NEAR(static_cast<double>(found.weight(1)), std::sqrt(2.0), 1e-15);
  EXPECT_EQ(found.weight(2), 0.0L);
}

// 4 to 12 directions of length one in 5 unknowns, some of them nearly alike or opposite
Matrix cone(Draw& draw) {
  Matrix directions = draw.unit_rows(draw.integer(4, 12), 5);
  const double angle = draw.power(-9.0, 0.0);
  for (Index i = 2; i < directions.rows(); i += 3) {
    const double side = draw.chance(0.3) ? -1.0 : 1.0;
    directions.row(i) = side * directions.row(i - 1) + angle * draw.unit_rows(1, 5);
    directions.row(i).normalize();
  }
  return directions;
}

TEST(NonnegativeLeastSquares, WhatIsLeftPullsAtNoDirection) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    Draw draw(seed);
    const Matrix directions = cone(draw);
    const NonnegativeLeastSquares found = balance(directions, draw.vector(5));
    Long forces = 1.0L;
    for (Index i = 0; i < directions.rows(); ++i) forces += found.weight(i);
    for (Index i = 0; i < directions.rows(); ++i) {
      Long pull = 0.0L;
      for (Index j = 0; j < 5; ++j) pull -= directions(i, j) * found.rest()[j];
      EXPECT_GE(found.weight(i), 0.0L) << "seed " << seed;
      EXPECT_LE(pull, 1e-16L * forces) << "seed " << seed;
      if (found.weight(i) > 0.0L) {
        EXPECT_GE(pull, -1e-16L * forces) << "seed " << seed;
      }
    }
  }
}

TEST(NonnegativeLeastSquares, AForceInsideTheConeIsBalanced) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    Draw draw(seed);
    const Matrix directions = cone(draw);
    const Vector weights = draw.uniform_vector(directions.rows(), 0.0, 1.0);
    const Vector b = -directions.transpose() * weights;
    const NonnegativeLeastSquares found = balance(directions, b);
    Long forces = b.lpNorm<1>();
    for (Index i = 0; i < directions.rows(); ++i) forces += found.weight(i);
    // what is left, r, has r'r <= sum weights_i pull_i, and a pull of 1e-18 of the forces is
    // rounding
    EXPECT_LE(found.left() * found.left(), weights.sum() * 1e-18L * forces) << "seed " << seed;
  }
}

}  // namespace
}  // namespace hurcules

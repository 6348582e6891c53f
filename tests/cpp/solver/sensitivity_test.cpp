// Strategy: derivatives that a hand can compute, then on seeded random hierarchies the adjoint
// identity <x_bar, forward(d)> = <transposed(x_bar), d> and central finite differences; the copy
// outlives its arrays. All classes of difficulty against finite differences are in Python
// (test_sensitivity.py).
#include "hurcules/solver/sensitivity/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "hurcules/solver/solver.hpp"
#include "support/expect.hpp"
#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using hurcules_test::contains;
using hurcules_test::error_text;
using hurcules_test::near;
using hurcules_test::RandomHierarchy;

// the inner product of two sets of numbers, and the sum of the sizes of its terms
struct Inner {
  double value = 0.0, size = 0.0;

  void add(const Matrix& a, const Matrix& b) {
    if (a.size() == 0 || b.size() == 0) return;
    value += a.cwiseProduct(b).sum();
    size += a.cwiseProduct(b).cwiseAbs().sum();
  }
};

Inner inner(const std::vector<LevelChange>& a, const std::vector<LevelChange>& b) {
  Inner sum;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum.add(a[k].lower, b[k].lower);
    sum.add(a[k].upper, b[k].upper);
    sum.add(a[k].A, b[k].A);
    sum.add(Matrix{{a[k].rho}}, Matrix{{b[k].rho}});
  }
  return sum;
}

LevelChange change(Matrix A, Vector lower, Vector upper) {
  return {.A = std::move(A), .lower = std::move(lower), .upper = std::move(upper)};
}

// a change of every number that keeps equalities equalities
std::vector<LevelChange> random_changes(const Hierarchy& levels, RandomHierarchy& random) {
  std::vector<LevelChange> changes;
  for (const Level& level : levels) {
    LevelChange change{.A = random.matrix(level.A.rows(), level.A.cols()),
                       .lower = random.vector(level.rows()),
                       .upper = random.vector(level.rows()),
                       .rho = level.rho > 0.0 ? 0.3 : 0.0};
    for (Index i = 0; i < level.rows(); ++i) {
      if (level.lower[i] == level.upper[i]) change.upper[i] = change.lower[i];
    }
    changes.push_back(std::move(change));
  }
  return changes;
}

Hierarchy moved(Hierarchy levels, const std::vector<LevelChange>& changes, double by) {
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (!levels[k].bounds) levels[k].A += by * changes[k].A;
    levels[k].lower += by * changes[k].lower;
    levels[k].upper += by * changes[k].upper;
    levels[k].rho += by * changes[k].rho;
  }
  return levels;
}

bool same_set(const std::vector<ActiveRow>& a, const std::vector<ActiveRow>& b) {
  const auto key = [](const ActiveRow& r) {
    return std::array{r.level, r.row, static_cast<int>(r.side), r.held_by};
  };
  const auto in = [&](const ActiveRow& row, const std::vector<ActiveRow>& set) {
    return std::any_of(set.begin(), set.end(),
                       [&](const ActiveRow& other) { return key(other) == key(row); });
  };
  return a.size() == b.size() &&
         std::all_of(a.begin(), a.end(), [&](const ActiveRow& row) { return in(row, b); });
}

// limits that bind, levels that conflict with them, freedom left at the end
Hierarchy crowded(RandomHierarchy& random, double rho) {
  const Vector ones = Vector::Ones(19);
  return {make_bounds(-ones, ones),    random.equality(3, 19, rho), random.interval(4, 19, rho),
          random.equality(3, 19, rho), random.interval(3, 19, rho), random.equality(3, 19, rho)};
}

// central difference of x along the change, nothing when the working set is another on a side
std::optional<Vector> difference(const Hierarchy& levels, const std::vector<LevelChange>& changes,
                                 double by) {
  Solver solver(levels[0].rows());
  const std::vector<ActiveRow> set = solver.solve(levels).working_set;
  Vector x[2];
  for (int side : {0, 1}) {
    solver.reset();
    const Hierarchy there = moved(levels, changes, side == 0 ? -by : by);
    const Solution& solution = solver.solve(there);
    if (!same_set(solution.working_set, set)) return std::nullopt;
    x[side] = solution.x;
  }
  return (x[1] - x[0]) / (2.0 * by);
}

TEST(Sensitivity, OfOneRegularisedRowIsItsFilter) {
  // x = sigma b / (sigma^2 + rho^2): dx/db = sigma / d, dx/dsigma = b (rho^2 - sigma^2) / d^2,
  // dx/drho = -2 rho sigma b / d^2
  const double sigma = 0.7, b = 1.3, rho = 0.4, d = sigma * sigma + rho * rho;
  Solver solver(1);
  const Hierarchy levels = {
      {.A = Matrix{{sigma}}, .lower = Vector{{b}}, .upper = Vector{{b}}, .rho = rho}};
  static_cast<void>(solver.solve(levels));
  const auto gradient = solver.sensitivity().transposed(Vector{{1.0}});
  EXPECT_NEAR(gradient[0].lower[0] + gradient[0].upper[0], sigma / d, 1e-14);
  EXPECT_NEAR(gradient[0].A(0, 0), b * (rho * rho - sigma * sigma) / (d * d), 1e-14);
  EXPECT_NEAR(gradient[0].rho, -2.0 * rho * sigma * b / (d * d), 1e-14);
}

TEST(Sensitivity, ALimitThatHoldsMovesXAndTheTargetDoesNot) {
  Solver solver(1);
  const Hierarchy levels = {
      make_bounds(Vector{{-1.0}}, Vector{{1.0}}),
      {.A = Matrix{{1.0}}, .lower = Vector{{5.0}}, .upper = Vector{{5.0}}, .rho = 0.1}};
  static_cast<void>(solver.solve(levels));
  const auto gradient = solver.sensitivity().transposed(Vector{{1.0}});
  EXPECT_EQ(gradient[0].lower[0], 0.0);
  EXPECT_NEAR(gradient[0].upper[0], 1.0, 1e-15);
  EXPECT_NEAR(gradient[1].lower[0], 0.0, 1e-15);
  EXPECT_NEAR(gradient[1].A(0, 0), 0.0, 1e-15);
}

TEST(Sensitivity, OfTheSmallestStepIsThatOfThePseudoInverse) {
  // rho = 0, a x = b in the plane: x = a b / |a|^2, and the second entry is held at 0.4 by its
  // limit: x = ((b - 0.4 a_1) / a_0, 0.4)
  Solver solver(2);
  const Hierarchy levels = {
      make_bounds(Vector{{-9.0, -9.0}}, Vector{{9.0, 0.4}}),
      {.A = Matrix{{2.0, 1.0}}, .lower = Vector{{3.0}}, .upper = Vector{{3.0}}}};
  EXPECT_TRUE(near(solver.solve(levels).x, Vector{{1.3, 0.4}}, 1e-12));
  const Sensitivity sensitivity = solver.sensitivity();
  const LevelChange limit = change({}, {}, Vector{{0.0, 1.0}});
  EXPECT_TRUE(near(sensitivity.forward({limit}), Vector{{-0.5, 1.0}}, 1e-12));
  const LevelChange target = change({}, Vector{{1.0}}, Vector{{1.0}});
  EXPECT_TRUE(near(sensitivity.forward({{}, target}), Vector{{0.5, 0.0}}, 1e-12));
  const LevelChange row = change(Matrix{{1.0, 0.0}}, {}, {});  // -(b - 0.4) / a_0^2
  EXPECT_TRUE(near(sensitivity.forward({{}, row}), Vector{{-0.65, 0.0}}, 1e-12));
}

TEST(Sensitivity, ForwardAndTransposedAreAdjoint) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    for (double rho : {0.0, 1e-3, 0.1}) {
      RandomHierarchy random(seed);
      const Hierarchy levels = random.conflicting(19, rho);
      Solver solver(19);
      static_cast<void>(solver.solve(levels));
      const Sensitivity sensitivity = solver.sensitivity();
      const auto changes = random_changes(levels, random);
      const Vector x_bar = random.vector(19);
      const double forward = x_bar.dot(sensitivity.forward(changes));
      const Inner transposed = inner(sensitivity.transposed(x_bar), changes);
      EXPECT_NEAR(forward, transposed.value, 1e-12 * std::max(1.0, transposed.size))
          << "seed " << seed << " rho " << rho;
    }
  }
}

TEST(Sensitivity, AgreesWithFiniteDifferences) {
  int compared = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    for (double rho : {0.0, 0.03, 0.1, 1.0}) {
      RandomHierarchy random(seed);
      const Hierarchy levels = crowded(random, rho);
      const auto changes = random_changes(levels, random);
      const auto wanted = difference(levels, changes, 1e-6);
      if (!wanted) continue;
      Solver solver(19);
      static_cast<void>(solver.solve(levels));
      const Vector dx = solver.sensitivity().forward(changes);
      EXPECT_LT((dx - *wanted).norm(), 2e-6 * std::max(1.0, dx.norm()))
          << "seed " << seed << " rho " << rho;
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(Sensitivity, OutlivesTheArraysAndTheSolver) {
  std::optional<Sensitivity> sensitivity;
  Vector before;
  RandomHierarchy random(3);
  const Vector x_bar = random.vector(9);
  {
    Hierarchy levels = random.conflicting(9, 0.1);
    Solver solver(9);
    static_cast<void>(solver.solve(levels));
    sensitivity = solver.sensitivity();
    before = sensitivity->transposed(x_bar)[1].lower;
    for (Level& level : levels) level.A.setConstant(7.0);
    static_cast<void>(solver.solve(levels));
  }
  EXPECT_EQ(sensitivity->transposed(x_bar)[1].lower, before);
}

TEST(Sensitivity, WantsASolvedHierarchyAndChangesOfItsShape) {
  RandomHierarchy random(1);
  const Hierarchy levels = random.conflicting(19, 0.1);
  Solver limited(19, {.max_changes = 1});
  static_cast<void>(limited.solve(levels));
  EXPECT_TRUE(contains(error_text([&] { static_cast<void>(limited.sensitivity()); }),
                       "ended with iteration limit"));
  EXPECT_TRUE(contains(error_text([] { static_cast<void>(Sensitivity(nullptr)); }),
                       "only the method 'lexicographic'"));
  Solver solver(19);
  static_cast<void>(solver.solve(levels));
  const Sensitivity sensitivity = solver.sensitivity();
  const auto forward = [&](const LevelChange& wrong) {
    return error_text([&] { static_cast<void>(sensitivity.forward({wrong, wrong})); });
  };
  EXPECT_TRUE(contains(forward(change({}, Vector{{1.0}}, {})), "change of level 0"));
  EXPECT_TRUE(contains(forward(change(Matrix::Zero(19, 19), {}, {})), "simple bounds"));
  EXPECT_TRUE(contains(
      error_text([&] { static_cast<void>(sensitivity.transposed(Vector{{1.0}})); }), "length 19"));
}

}  // namespace
}  // namespace hurcules

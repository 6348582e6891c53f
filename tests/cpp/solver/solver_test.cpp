// Strategy: answers that a hand can compute, then properties of the definition (solver.md §1) on
// seeded random hierarchies: priority, warm equals cold, proof, end, no allocation, same bits. The
// independent oracle is in Python.
#include "hurcules/solver/solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/no_allocation.hpp"
#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using hurcules_test::RandomHierarchy;

Level rows(Matrix A, Vector lower, Vector upper, double rho = 0.0) {
  return {.A = std::move(A), .lower = std::move(lower), .upper = std::move(upper), .rho = rho};
}

Level equal(Matrix A, Vector target, double rho = 0.0) {
  return rows(std::move(A), target, target, rho);
}

Vector vector(std::initializer_list<double> values) {
  Vector v(values.size());
  std::copy(values.begin(), values.end(), v.data());
  return v;
}

TEST(Solver, RowWeightsAreRespected) {
  // least squares of 2x = 4 and x = 8: x = (2*4 + 8) / 5 = 3.2
  Solver solver(1);
  const Solution& solution = solver.solve({equal(Matrix{{2.0}, {1.0}}, vector({4.0, 8.0}))});
  EXPECT_NEAR(solution.x[0], 3.2, 1e-14);
  EXPECT_EQ(solution.status, SolverStatus::Solved);
}

TEST(Solver, RegularisationFiltersBySingularValue) {
  // one row of length sigma: x = sigma / (sigma^2 + rho^2)  [T 3.3.38-39]
  for (double sigma : {1.0, 0.1, 1e-3, 1e-9}) {
    Solver solver(1);
    const double x = solver.solve({equal(Matrix{{sigma}}, vector({1.0}), 0.1)}).x[0];
    EXPECT_NEAR(x, sigma / (sigma * sigma + 0.01), 1e-13) << sigma;
  }
}

TEST(Solver, ReleasesALimitThatIsNotNeeded) {
  // R20: q1 <= 0, then q1 + q2 = -1 with rho 0.1: both move, x = -1 / (2 + rho^2) each
  Solver solver(2);
  const double inf = std::numeric_limits<double>::infinity();
  const Solution& solution = solver.solve({make_bounds(vector({-inf, -inf}), vector({0.0, inf})),
                                           equal(Matrix{{1.0, 1.0}}, vector({-1.0}), 0.1)});
  EXPECT_NEAR(solution.x[0], -1.0 / 2.01, 1e-14);  // -0.4975
  EXPECT_NEAR(solution.x[1], -1.0 / 2.01, 1e-14);
  EXPECT_TRUE(solution.working_set.empty());
}

TEST(Solver, LimitsAreExactNotOnePercentShort) {
  // solver.md §8: a regularised limit would stop at 0.990
  Solver solver(1);
  const Solution& solution = solver.solve(
      {make_bounds(vector({-1.0}), vector({1.0})), equal(Matrix{{1.0}}, vector({5.0}), 0.1)});
  EXPECT_DOUBLE_EQ(solution.x[0], 1.0);
  ASSERT_EQ(solution.working_set.size(), 1u);
  EXPECT_EQ(solution.working_set[0].held_by, 1);
  EXPECT_EQ(solution.working_set[0].side, Side::Upper);
}

TEST(Solver, AnInfeasibleLevelIsOnlyAViolation) {
  Solver solver(1);
  const Solution& solution =
      solver.solve({rows(Matrix{{1.0}, {1.0}}, vector({1.0, -3.0}), vector({2.0, -2.0})),
                    equal(Matrix{{1.0}}, vector({9.0}))});
  EXPECT_EQ(solution.status, SolverStatus::Solved);
  EXPECT_NEAR(solution.x[0], -0.5, 1e-9);  // halfway between 1 and -2
  EXPECT_NEAR(solution.violations[0][0], -1.5, 1e-9);
  EXPECT_NEAR(solution.violations[0][1], 1.5, 1e-9);
}

TEST(Solver, AnImprovementByALowerLevelIsKept) {
  // level 0 (regularised) stops short of 1; level 1 pushes the same way and may bring it there,
  // never past worse
  Solver solver(1);
  const double inf = std::numeric_limits<double>::infinity();
  const Solution& solution = solver.solve({rows(Matrix{{1.0}}, vector({1.0}), vector({inf}), 0.5),
                                           equal(Matrix{{1.0}}, vector({3.0}))});
  EXPECT_NEAR(solution.x[0], 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(solution.violations[0][0], 0.0);
}

TEST(Solver, LowerLevelsNeverHarmHigherOnes) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    Hierarchy levels = RandomHierarchy(seed).conflicting(12, seed % 3 ? 0.1 : 0.0);
    Solver all(12), some(12);
    const Solution whole = all.solve(levels);
    levels.resize(4);
    const Solution part = some.solve(levels);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      for (Index i = 0; i < levels[k].rows(); ++i) {
        const bool equality = levels[k].lower[i] == levels[k].upper[i];
        const double now = std::abs(whole.violations[k][i]),
                     before = std::abs(part.violations[k][i]);
        EXPECT_LE(now, before + 1e-9) << "seed " << seed << " level " << k << " row " << i;
        if (equality) {
          EXPECT_NEAR(now, before, 1e-9) << "seed " << seed << " level " << k;
        }
      }
    }
  }
}

TEST(Solver, EveryAnswerProvesItself) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Solver solver(12);
    const Solution& solution =
        solver.solve(RandomHierarchy(seed).conflicting(12, seed % 2 ? 0.1 : 0.0));
    EXPECT_EQ(solution.status, SolverStatus::Solved) << "seed " << seed;
    EXPECT_EQ(solution.final_levels, 11);
    EXPECT_LT(solution.optimality, 1e-9) << "seed " << seed;
  }
}

TEST(Solver, TheProofNoticesAWrongAnswer) {
  // ended after one change, the level in hand is feasible but not optimal, and the residual says so
  const Hierarchy levels = RandomHierarchy(5).conflicting(12, 0.1);
  Solver solver(12, {.max_changes = 1});
  const Solution& solution = solver.solve(levels);
  EXPECT_EQ(solution.status, SolverStatus::IterationLimit);
  EXPECT_LT(solution.final_levels, 11);
  EXPECT_GT(solution.optimality, 1e-3);
}

TEST(Solver, AnInterruptedSolveKeepsTheLevelsAbove) {
  const Hierarchy levels = RandomHierarchy(5).conflicting(12, 0.1);
  for (int limit = 1; limit < 40; ++limit) {
    Solver solver(12, {.max_changes = limit});
    const Solution& solution = solver.solve(levels);
    EXPECT_LE(solution.violations[0].lpNorm<Eigen::Infinity>(), 1e-12) << "limit " << limit;
    EXPECT_TRUE(solution.x.allFinite());
  }
}

// In a crowded corner of the box more limits meet than there are directions. Each level stands on
// others of them: were their rounding of x not one and the same, it would grow from level to level.
TEST(Solver, ManyLevelsInACornerTakeOneFactorizationALevel) {
  const Index n = 57;
  const Vector ones = Vector::Ones(n);
  for (const double rho : {0.1, 0.0}) {
    for (unsigned seed = 0; seed < 3; ++seed) {
      RandomHierarchy random(seed);
      Hierarchy levels = {make_bounds(-ones, ones)};
      for (Index k = 0; k < n / 3; ++k) {
        levels.push_back(random.equality(3, n, rho));
        levels.back().A.rowwise().normalize();
      }
      Solver solver(n);
      const Solution cold = solver.solve(levels);
      EXPECT_EQ(to_string(cold.status), "solved");
      EXPECT_LE(cold.violations[0].lpNorm<Eigen::Infinity>(), 5e-13) << "seed " << seed;
      // without regularisation a level is sought and then settled
      const int levels_count = static_cast<int>(levels.size());
      EXPECT_LE(cold.factorizations, rho > 0.0 ? levels_count : 2 * levels_count);
      const Solution& warm = solver.solve(levels);
      EXPECT_EQ(warm.factorizations, levels_count) << "seed " << seed << ", rho " << rho;
      EXPECT_EQ(warm.changes, 0) << "seed " << seed << ", rho " << rho;
    }
  }
}

TEST(Solver, WarmAndUnchangedTakesOneFactorizationALevel) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Hierarchy levels = RandomHierarchy(seed).conflicting(12, 0.1);
    Solver solver(12);
    const Vector cold = solver.solve(levels).x;
    // at a vertex of many limits (seed 33: 16 of them) rounding decides which of them are held:
    // a set found limit by limit may differ from one factored at once, which then stays
    (void)solver.solve(levels);
    const Solution& warm = solver.solve(levels);
    EXPECT_EQ(warm.factorizations, 11) << "seed " << seed;
    EXPECT_EQ(warm.changes, 0) << "seed " << seed;
    EXPECT_LT((warm.x - cold).lpNorm<Eigen::Infinity>(), 1e-9);
  }
}

TEST(Solver, WarmEqualsColdWhereTargetsMove) {
  RandomHierarchy random(11);
  Hierarchy levels = random.conflicting(12, 0.1);
  Solver warm(12);
  for (int tick = 0; tick < 300; ++tick) {
    for (Level& level : levels) {
      const Vector shift = 0.05 * random.vector(level.rows());
      level.lower += shift;
      level.upper = (level.upper + shift).cwiseMax(level.lower);
    }
    Solver cold(12);
    EXPECT_LT((warm.solve(levels).x - cold.solve(levels).x).lpNorm<Eigen::Infinity>(), 1e-8);
  }
}

TEST(Solver, AChangedPatternStartsCold) {
  Solver solver(12);
  (void)solver.solve(RandomHierarchy(1).conflicting(12, 0.1));
  Hierarchy other = RandomHierarchy(2).conflicting(12, 0.1);
  std::swap(other[1], other[2]);  // rows that were equalities are intervals now
  Solver fresh(12);
  EXPECT_EQ(solver.solve(other).x, fresh.solve(other).x);
}

TEST(Solver, TheSolutionOfASolverThatNobodyKeepsIsNoReferenceIntoIt) {
  Solver kept(1);
  const Hierarchy levels{equal(Matrix::Ones(1, 1), vector({0.5}))};
  static_assert(std::is_same_v<decltype(Solver(1).solve(levels)), Solution>);
  static_assert(std::is_same_v<decltype(kept.solve(levels)), const Solution&>);
  EXPECT_EQ(Solver(1).solve(levels).x, kept.solve(levels).x);
}

TEST(Solver, SameInputSameBits) {
  const Hierarchy levels = RandomHierarchy(3).conflicting(12, 0.1);
  Solver a(12), b(12);
  EXPECT_EQ(a.solve(levels).x, b.solve(levels).x);
  EXPECT_EQ(a.solve(levels).x, b.solve(levels).x);
}

TEST(Solver, AllocatesNothingOnceSized) {
  for (double rho : {0.1, 0.0}) {
    RandomHierarchy random(6);
    Hierarchy levels = random.conflicting(12, rho);
    Solver solver(12);
    solver.reserve(levels);
    for (int tick = 0; tick < 20; ++tick) {
      levels[1].lower.array() += 0.05;
      levels[1].upper.array() += 0.05;
      const hurcules_test::NoAllocation none;
      (void)solver.solve(levels);
      EXPECT_EQ(none.count(), 0u);
    }
  }
}

// a hierarchy in which some rows have lost their limits, and the same without these rows
struct Unlimited {
  explicit Unlimited(unsigned seed) : without(RandomHierarchy(seed).conflicting(12, 0.1)) {
    with = without;
    for (std::size_t k = 2; k < with.size(); k += 2) {
      const Index gone = (seed + k / 2) % 3;  // none, where there are two rows
      if (gone > 1) continue;
      with[k].lower[gone] = -kInfinity;
      with[k].upper[gone] = kInfinity;
      const Index stays = 1 - gone;
      without[k] = rows(without[k].A.row(stays), without[k].lower.segment(stays, 1),
                        without[k].upper.segment(stays, 1), 0.1);
      places.emplace_back(k, gone);
    }
  }
  Hierarchy without, with;
  std::vector<std::pair<std::size_t, Index>> places;
};

TEST(Solver, ARowWithoutLimitsIsNotThere) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Unlimited problem(seed);
    Solver solver(12), other(12);
    const Solution& solution = solver.solve(problem.with);
    EXPECT_EQ(solution.status, SolverStatus::Solved) << "seed " << seed;
    EXPECT_EQ(solution.x, other.solve(problem.without).x) << "seed " << seed;
    const std::vector<std::vector<Vector>> multipliers = solver.multipliers();
    for (const auto& [k, row] : problem.places) {
      EXPECT_EQ(solution.violations[k][row], 0.0);
      for (const ActiveRow& active : solution.working_set)
        EXPECT_FALSE(active.level == static_cast<int>(k) && active.row == row) << "seed " << seed;
      for (std::size_t by = k; by < multipliers.size(); ++by) {
        ASSERT_EQ(multipliers[by][k].size(), 2);
        EXPECT_EQ(multipliers[by][k][row], 0.0);
      }
    }
  }
}

TEST(Solver, LimitsThatComeAndGoLeaveTheStartWarm) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    Hierarchy levels = RandomHierarchy(seed).conflicting(12, 0.1);
    Solver solver(12);
    (void)solver.solve(levels);
    const Vector x = solver.solve(levels).x;
    ASSERT_EQ(solver.solution().status, SolverStatus::Solved) << "seed " << seed;
    const std::vector<ActiveRow> held = solver.solution().working_set;
    const Hierarchy limited = levels;
    Index dropped = 0;
    for (std::size_t k = 2; k < levels.size(); k += 2) {
      for (Index row = 0; row < 2; ++row) {
        const bool stays = std::any_of(held.begin(), held.end(), [&](const ActiveRow& active) {
          return active.level == static_cast<int>(k) && active.row == row;
        });
        if (stays || std::abs(solver.solution().violations[k][row]) > 0.0) continue;
        levels[k].lower[row] = -kInfinity;
        levels[k].upper[row] = kInfinity;
        ++dropped;
      }
    }
    EXPECT_LE((solver.solve(levels).x - x).lpNorm<Eigen::Infinity>(), 1e-12) << "seed " << seed;
    EXPECT_EQ(solver.solution().changes, 0) << "seed " << seed << ", dropped " << dropped;
    EXPECT_LE((solver.solve(limited).x - x).lpNorm<Eigen::Infinity>(), 1e-12) << "seed " << seed;
    EXPECT_EQ(solver.solution().changes, 0) << "seed " << seed << ", dropped " << dropped;
  }
}

TEST(Solver, LimitsThatComeAndGoAllocateNothing) {
  const Unlimited problem(1);
  const Hierarchy limited = RandomHierarchy(1).conflicting(12, 0.1);
  Solver solver(12);
  solver.reserve(limited);
  for (int tick = 0; tick < 10; ++tick) {
    const hurcules_test::NoAllocation none;
    (void)solver.solve(tick % 2 ? limited : problem.with);
    EXPECT_EQ(none.count(), 0u);
  }
}

TEST(Solver, BadNumbersInARowWithoutLimitsAreRefused) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e101}) {
    Unlimited problem(1);
    const auto [k, row] = problem.places.front();
    problem.with[k].A(row, 3) = bad;
    Solver solver(12);
    EXPECT_EQ(solver.solve(problem.with).status, SolverStatus::InvalidInput) << bad;
  }
}

TEST(Solver, BadNumbersAreAStatusNotAnException) {
  Hierarchy levels = RandomHierarchy(1).conflicting(12, 0.1);
  Solver solver(12);
  levels[2].lower[0] = std::nan("");
  EXPECT_EQ(solver.solve(levels).status, SolverStatus::InvalidInput);
  EXPECT_EQ(solver.solution().x, Vector::Zero(12));
  levels = RandomHierarchy(1).conflicting(12, 0.1);
  levels[1].A(0, 0) = std::nan("");
  EXPECT_EQ(solver.solve(levels).status, SolverStatus::InvalidInput);
  levels = RandomHierarchy(1).conflicting(12, 0.1);
  levels[2].lower[0] = levels[2].upper[0] + 1.0;
  EXPECT_EQ(solver.solve(levels).status, SolverStatus::InvalidInput);
}

// more levels than before, and their first numbers are none: nothing of before may be asked for
TEST(Solver, BadNumbersInANewPatternLeaveNothingBehind) {
  Solver solver(12);
  Hierarchy few = RandomHierarchy(1).conflicting(12, 0.1);
  few.resize(1);
  Hierarchy many = RandomHierarchy(2).conflicting(12, 0.1);
  for (Level& level : many) level.rho = 0.0;
  ASSERT_GT(many.size(), few.size());
  Solver fresh(12);
  (void)fresh.solve(many);
  (void)solver.solve(many);
  EXPECT_EQ(solver.solve(few).status, SolverStatus::Solved);
  Hierarchy bad = many;
  bad.back().A(0, 0) = std::nan("");
  EXPECT_EQ(solver.solve(bad).status, SolverStatus::InvalidInput);
  EXPECT_EQ(solver.solve(many).status, SolverStatus::Solved);
  EXPECT_EQ(solver.solution().x, fresh.solution().x);
  EXPECT_EQ(solver.solution().changes, fresh.solution().changes);  // cold
}

TEST(Solver, HugeNumbersEndWithAFiniteAnswer) {
  Solver solver(2);
  const Solution& solution = solver.solve({equal(Matrix{{1e300, 1e300}}, vector({1e19}), 0.1),
                                           equal(Matrix{{1e-300, 1.0}}, vector({1e19}), 0.1)});
  EXPECT_TRUE(solution.x.allFinite());
}

TEST(Solver, EmptyProblemsStayAtZero) {
  Solver solver(3);
  EXPECT_EQ(solver.solve({}).x, Vector::Zero(3));
  const Solution& solution =
      solver.solve({equal(Matrix(0, 3), Vector(0)), equal(Matrix::Zero(2, 3), Vector::Ones(2))});
  EXPECT_EQ(solution.x, Vector::Zero(3));
  EXPECT_EQ(solution.violations[1], -Vector::Ones(2));
  EXPECT_EQ(solution.factorizations, 1);
}

TEST(Solver, MultipliersBalanceEachLevel) {
  // rho^2 (x_k - x_{k-1}) + sum over levels j <= k of A_j' mu_kj = 0 for the whole gradient
  // [T 3.4.100-116]
  const Hierarchy levels = {equal(Matrix{{1.0, 0.0, 0.0}}, vector({1.0}), 0.1),
                            equal(Matrix{{1.0, 1.0, 0.0}}, vector({3.0}), 0.1)};
  Solver solver(3), first(3);
  const Vector x = solver.solve(levels).x;
  const Vector x_above = first.solve({levels[0]}).x;
  const auto mu = solver.multipliers();
  const Vector gradient = 0.01 * (x - x_above) + levels[0].A.transpose() * mu[1][0] +
                          levels[1].A.transpose() * mu[1][1];
  EXPECT_LT(gradient.norm(), 1e-14);
  EXPECT_NE(mu[1][0][0], 0.0);
}

}  // namespace
}  // namespace hurcules

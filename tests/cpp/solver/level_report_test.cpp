// Strategy: one regularised row and two rows that conflict, which a hand can compute; reports end
// where the solve ended. Closed forms of the thesis on random levels, and limits that hold, are in
// Python (test_level_report.py).
#include "hurcules/solver/sensitivity/level_report.hpp"

#include <gtest/gtest.h>

#include "hurcules/solver/solver.hpp"
#include "support/expect.hpp"
#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using hurcules_test::near;

TEST(LevelReport, OfOneRowIsTheRegularisationError) {
  // u = -T y, T = rho^2 / (sigma^2 + rho^2)  [T 3.3.80]
  Solver solver(2);
  const Hierarchy levels = {
      {.A = Matrix{{3.0, 4.0}}, .lower = Vector{{2.0}}, .upper = Vector{{2.0}}, .rho = 0.5}};
  static_cast<void>(solver.solve(levels));
  const LevelReport report = solver.reports().at(0);
  EXPECT_EQ(report.rank, 1);
  EXPECT_TRUE(near(report.singular_values, Vector{{5.0}}, 1e-15));
  EXPECT_TRUE(near(report.regularized, Vector{{-2.0 * 0.25 / 25.25}}, 1e-15));
  EXPECT_TRUE(near(report.infeasible, Vector{{0.0}}, 1e-15));
}

TEST(LevelReport, OfRowsThatConflictIsInfeasible) {
  // x = 1 and x = 3 without regularisation: x = 2, each misses by 1
  Solver solver(1);
  const Vector target{{1.0, 3.0}};
  const Hierarchy levels = {{.A = Matrix{{1.0}, {1.0}}, .lower = target, .upper = target}};
  static_cast<void>(solver.solve(levels));
  const LevelReport report = solver.reports().at(0);
  EXPECT_EQ(report.rank, 1);
  EXPECT_TRUE(near(report.infeasible, Vector{{1.0, -1.0}}, 1e-15));
  EXPECT_TRUE(near(report.regularized, Vector{{0.0, 0.0}}, 0.0));
}

TEST(LevelReport, CoversTheLevelsThatAreFinal) {
  hurcules_test::RandomHierarchy random(1);
  const Hierarchy levels = random.conflicting(19, 0.1);
  Solver solver(19, {.max_changes = 1});
  const Solution& solution = solver.solve(levels);
  ASSERT_LT(solution.final_levels, static_cast<int>(levels.size()));
  EXPECT_EQ(static_cast<int>(solver.reports().size()), solution.final_levels);
}

}  // namespace
}  // namespace hurcules

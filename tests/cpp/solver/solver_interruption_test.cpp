// Strategy: every class of hierarchies, stopped after 1 .. 20 working-set changes. What is returned
// must be the best so far: the levels said to be final are those of the whole solve, no row of
// theirs is broken, and the level in hand is not worse than before it began.
#include <gtest/gtest.h>

#include "hurcules/solver/solver.hpp"
#include "support/answers_by_level.hpp"
#include "support/each_problem.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

class SolverInterruption : public EachClass {};

double value_of(const Level& level, Index i, const Vector& x) {
  return level.bounds ? x[i] : level.A.row(i).dot(x);
}

// 1/2 |violation|^2 + 1/2 rho^2 |x - x_above|^2
double objective(const Level& level, const Vector& x, const Vector& x_above) {
  double sum = level.rho * level.rho * (x - x_above).squaredNorm();
  for (Index i = 0; i < level.rows(); ++i) {
    const double value = value_of(level, i, x);
    sum += std::pow(value - std::clamp(value, level.lower[i], level.upper[i]), 2);
  }
  return 0.5 * sum;
}

// no row of the levels before `count` is worse at x than at x_above, to `allowed` |a| max(1, |x|)
void expect_unbroken(const Hierarchy& levels, int count, const Vector& x, const Vector& x_above,
                     double allowed) {
  const double scale =
      std::max({1.0, x.lpNorm<Eigen::Infinity>(), x_above.lpNorm<Eigen::Infinity>()});
  for (int k = 0; k < count; ++k) {
    for (Index i = 0; i < levels[k].rows(); ++i) {
      const double size = scale * (levels[k].bounds ? 1.0 : levels[k].A.row(i).norm());
      const double before = value_of(levels[k], i, x_above), now = value_of(levels[k], i, x);
      const bool equality = levels[k].lower[i] == levels[k].upper[i];
      const double upper = equality ? before : std::max(levels[k].upper[i], before);
      const double lower = equality ? before : std::min(levels[k].lower[i], before);
      EXPECT_LE(now, upper + allowed * size)
          << "level " << k << ", row " << i << ", over by " << (now - upper) / size;
      EXPECT_GE(now, lower - allowed * size)
          << "level " << k << ", row " << i << ", under by " << (lower - now) / size;
    }
  }
}

TEST_P(SolverInterruption, AnInterruptedSolveReturnsTheBestPointSoFar) {
  each_problem(20, {0.1, 1e-3, 0.0}, [this](const Hierarchy& levels, Draw&) {
    const Index n = unknowns_of(levels);
    const std::vector<Vector> x = answers_by_level(levels, n);
    Solver whole(n);
    const int changes = whole.solve(levels).changes;
    for (int limit = 1; limit <= 20; ++limit) {
      SCOPED_TRACE("max_changes " + std::to_string(limit));
      Solver solver(n, {.max_changes = limit});
      const Solution& solution = solver.solve(levels);
      const int final_levels = solution.final_levels;
      ASSERT_TRUE(solution.x.allFinite());
      EXPECT_EQ(to_string(solution.status),
                final_levels == static_cast<int>(levels.size()) ? "solved" : "iteration limit");
      EXPECT_TRUE(changes <= limit || solution.status == SolverStatus::IterationLimit);
      EXPECT_LE(solution.changes, limit);
      if (solution.status != SolverStatus::IterationLimit) continue;
      const Vector above = final_levels ? x[final_levels - 1] : Vector::Zero(n);
      // a row that stands out by less than the rank tolerance of 1e-10 is not held (solver.md §1)
      const double allowed = is({"near_singular"}) ? 2e-10
                             : is({"thin_cones"})  ? kThinRounding
                                                   : 1e-12;
      expect_unbroken(levels, final_levels, solution.x, above, allowed);
      const double before = objective(levels[final_levels], above, above);
      EXPECT_LE(objective(levels[final_levels], solution.x, above),
                before * (1 + std::max(1e-9, allowed)) + 1e-15);
    }
  });
}

HURCULES_FOR_EACH_CLASS(SolverInterruption);

}  // namespace
}  // namespace hurcules

// Strategy: limits are dropped where no velocity within the bounds reaches them, nowhere else, and the
// answer of the solver stays; random rows and bounds. The rates of the rows are tested through the
// controllers (velocity_controller_test.cpp, arrival_test.cpp).
#include "hurcules/control/limit_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hurcules/solver/solver.hpp"
#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using hurcules_test::RandomHierarchy;

constexpr Index kUnknowns = 6;

// bounds that need not hold zero, rows with wide and narrow intervals
struct Problem {
  explicit Problem(unsigned seed) : random(seed) {
    const Vector middle = 0.5 * random.vector(kUnknowns);
    const Vector half = random.vector(kUnknowns).cwiseAbs();
    bounds = make_bounds(middle - half, middle + half);
    limits.A = random.matrix(12, kUnknowns);
    const Vector place = limits.A * middle;
    limits.lower = place - 4.0 * random.vector(12).cwiseAbs();
    limits.upper = place + 4.0 * random.vector(12).cwiseAbs();
    limits.rho = 1e-4;
  }
  // the least and the most that row i reaches within the bounds
  [[nodiscard]] double least(Index i) const {
    return limits.A.row(i).cwiseMax(0.0).dot(bounds.lower) +
           limits.A.row(i).cwiseMin(0.0).dot(bounds.upper);
  }
  [[nodiscard]] double most(Index i) const {
    return limits.A.row(i).cwiseMax(0.0).dot(bounds.upper) +
           limits.A.row(i).cwiseMin(0.0).dot(bounds.lower);
  }
  [[nodiscard]] Level dropped() const {
    Reachable reachable(kUnknowns);
    reachable.set(bounds);
    Level level = limits;
    reachable.drop_others(level);
    return level;
  }
  RandomHierarchy random;
  Level bounds, limits;
};

bool is_limited(const Level& level, Index row) {
  return std::isfinite(level.lower[row]) || std::isfinite(level.upper[row]);
}

TEST(Reachable, DropsLimitsThatNothingReachesAndNoOthers) {
  int gone = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Problem problem(seed);
    const Level level = problem.dropped();
    for (Index i = 0; i < level.rows(); ++i) {
      const double room = std::min(problem.least(i) - problem.limits.lower[i],
                                   problem.limits.upper[i] - problem.most(i));
      if (std::abs(room) < 1e-4) continue;  // the margin for rounding
      EXPECT_EQ(is_limited(level, i), room < 0.0) << "seed " << seed << " row " << i;
      gone += room > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(gone, 200);
  EXPECT_LT(gone, 2200);
}

TEST(Reachable, TheAnswerStays) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Problem problem(seed);
    const Level wanted = problem.random.equality(3, kUnknowns, 0.1);
    Solver all(kUnknowns), some(kUnknowns);
    const Vector x = all.solve({problem.bounds, problem.limits, wanted}).x;
    const Vector y = some.solve({problem.bounds, problem.dropped(), wanted}).x;
    EXPECT_LE((x - y).lpNorm<Eigen::Infinity>(), 1e-12) << "seed " << seed;
  }
}

TEST(Reachable, KeepsEqualitiesAndWhatIsNoNumber) {
  const double inf = std::numeric_limits<double>::infinity(), none = std::nan("");
  Level bounds = make_bounds(Vector::Constant(2, -1.0), Vector::Constant(2, 1.0));
  const auto stays = [&](double a, double lower, double upper) {
    Reachable reachable(2);
    reachable.set(bounds);
    Level level{.A = Matrix{{a, 1.0}},
                .lower = Vector::Constant(1, lower),
                .upper = Vector::Constant(1, upper)};
    reachable.drop_others(level);
    return !std::isinf(level.lower[0]) || !std::isinf(level.upper[0]);
  };
  EXPECT_FALSE(stays(1.0, -3.0, 3.0));
  EXPECT_TRUE(stays(1.0, 5.0, 5.0));
  EXPECT_TRUE(stays(none, -3.0, 3.0));
  EXPECT_TRUE(stays(1.0, none, 3.0));
  EXPECT_TRUE(stays(1.0, -3.0, none));
  bounds.upper[0] = inf;
  EXPECT_TRUE(stays(1.0, -3.0, 3.0));
  bounds.lower[0] = none;
  EXPECT_TRUE(stays(1.0, -3.0, 3.0));
}

}  // namespace
}  // namespace hurcules

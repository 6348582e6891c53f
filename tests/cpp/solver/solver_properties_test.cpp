// Strategy: properties of the definition on every class of hierarchies: strict priority, row order,
// scale, copies of rows, same bits, reset, wild numbers. Classes that are sensitive by construction
// (a row 1e-12 from dependent, a wedge of 1e-8 that turns the last digit of a row into 1e-8 of x)
// are compared in their violations, or left out where even those may move.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "hurcules/base/error.hpp"
#include "hurcules/solver/solver.hpp"
#include "support/answers_by_level.hpp"
#include "support/each_problem.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

constexpr double kSame = 1e-9;   // a violation, relative to |a| max(1, |x|): solver.md §1
constexpr double kSameX = 1e-7;  // x where it is insensitive, relative to max(1, |x|)

class SolverProperties : public EachClass {
 protected:
  // x is unique but moves by more than kSameX when rounding does
  [[nodiscard]] bool sensitive() const {
    return is({"near_singular", "thin_cones", "scales", "facing_limits"});
  }
  void expect_same_answer(const Hierarchy& levels, const Vector& x, const Vector& other) const {
    const double size = std::max(1.0, x.lpNorm<Eigen::Infinity>());
    if (!sensitive()) {
      EXPECT_LE((x - other).lpNorm<Eigen::Infinity>(), kSameX * size);
    }
    for (const Level& level : levels) {
      for (Index i = 0; i < level.rows(); ++i) {
        const double norm = level.bounds ? 1.0 : level.A.row(i).norm();
        // a cone as thin as 1e-8 rad makes more of rounding than that
        const double same = is({"thin_cones"}) ? kThinRounding : 1e-8;
        EXPECT_NEAR(violation(level, i, x), violation(level, i, other), same * norm * size);
      }
    }
  }
  static double violation(const Level& level, Index i, const Vector& x) {
    const double value = level.bounds ? x[i] : level.A.row(i).dot(x);
    return value - std::clamp(value, level.lower[i], level.upper[i]);
  }
};

Vector solve(const Hierarchy& levels) {
  Solver solver(unknowns_of(levels));
  return solver.solve(levels).x;
}

// levels 0 .. count - 1, then others
Hierarchy with_others_below(const Hierarchy& levels, std::size_t count, Draw& draw) {
  Hierarchy changed(levels.begin(), levels.begin() + count);
  const Index n = unknowns_of(levels);
  for (Index k = draw.integer(0, 3); k > 0; --k) changed.push_back(mixed_level(draw, n, 0.1));
  for (std::size_t k = levels.size(); k > count; --k) {
    changed.push_back(levels[k - 1]);
    if (draw.chance(0.5)) changed.back().lower.array() -= 1.0;
  }
  return changed;
}

TEST_P(SolverProperties, LevelsBelowNeverHarmThoseAbove) {
  each_problem(60, {0.1, 1e-3, 1e-6, 0.0}, [this](const Hierarchy& levels, Draw& draw) {
    const auto count = static_cast<std::size_t>(draw.integer(1, static_cast<Index>(levels.size())));
    const Hierarchy some(levels.begin(), levels.begin() + count);
    const Hierarchy changed = with_others_below(levels, count, draw);
    // where rounding moves x, the whole solve is compared with its own answer at that level
    const Vector alone =
        sensitive() ? answers_by_level(changed, unknowns_of(levels))[count - 1] : solve(some);
    const Vector whole = solve(changed);
    const double scale =
        std::max({1.0, alone.lpNorm<Eigen::Infinity>(), whole.lpNorm<Eigen::Infinity>()});
    for (const Level& level : some) {
      for (Index i = 0; i < level.rows(); ++i) {
        const double size = scale * (level.bounds ? 1.0 : level.A.row(i).norm());
        const double before = violation(level, i, alone), now = violation(level, i, whole);
        EXPECT_LE(std::abs(now), std::abs(before) + kSame * size);
        if (level.lower[i] == level.upper[i]) {
          EXPECT_NEAR(now, before, kSame * size);
        }
      }
    }
  });
}

TEST_P(SolverProperties, TheOrderOfRowsInALevelChangesNothing) {
  // which of two rows that differ by less than 1e-10 counts as dependent is a matter of order
  if (is({"near_singular", "thin_cones"})) return;
  each_problem(40, {0.1, 1e-3, 0.0}, [this](const Hierarchy& levels, Draw& draw) {
    Hierarchy shuffled = levels;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      if (levels[k].bounds) continue;
      for (Index i = levels[k].rows() - 1; i > 0; --i) {
        const Index j = draw.integer(0, i);
        shuffled[k].A.row(i).swap(shuffled[k].A.row(j));
        std::swap(shuffled[k].lower[i], shuffled[k].lower[j]);
        std::swap(shuffled[k].upper[i], shuffled[k].upper[j]);
      }
    }
    expect_same_answer(levels, solve(levels), solve(shuffled));
  });
}

TEST_P(SolverProperties, ALevelScaledTogetherWithItsRegularisationIsTheSameLevel) {
  each_problem(40, {0.1, 1e-3, 0.0}, [this](const Hierarchy& levels, Draw& draw) {
    Hierarchy scaled = levels;
    for (Level& level : scaled) {
      if (level.bounds) continue;
      // powers of two round nothing
      const double scale = draw.choose({0.125, 0.5, 2.0, 8.0});
      level.A *= scale;
      level.lower *= scale;
      level.upper *= scale;
      level.rho *= scale;
    }
    expect_same_answer(levels, solve(levels), solve(scaled));
  });
}

TEST_P(SolverProperties, CopiesOfInequalityRowsThatHoldChangeNothing) {
  if (is({"thin_cones"})) return;
  each_problem(40, {0.1, 1e-3, 0.0}, [this](const Hierarchy& levels, Draw& draw) {
    const std::vector<Vector> x = answers_by_level(levels, unknowns_of(levels));
    Hierarchy copied = levels;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      for (Index i = 0; i < levels[k].rows(); ++i) {
        const Level& level = levels[k];
        const double margin = 1e-6 * std::max(1.0, x[k].lpNorm<Eigen::Infinity>());
        const double value = level.bounds ? x[k][i] : level.A.row(i).dot(x[k]);
        if (level.bounds || level.lower[i] == level.upper[i] || draw.chance(0.5)) continue;
        if (value < level.lower[i] + margin || value > level.upper[i] - margin) continue;
        append_row(copied[k], level.A.row(i), level.lower[i], level.upper[i]);
      }
    }
    expect_same_answer(levels, solve(levels), solve(copied));
  });
}

TEST_P(SolverProperties, LimitsStatedAgainBelowChangeNothing) {
  if (is({"thin_cones"})) return;
  each_problem(40, {0.1, 1e-3, 0.0}, [this](const Hierarchy& levels, Draw& draw) {
    const auto k = static_cast<std::size_t>(draw.integer(0, static_cast<Index>(levels.size()) - 1));
    Level again = levels[k];
    // a violated limit with rho = 0 cannot be improved either; with rho it can
    again.rho = 0.0;
    const Vector x = solve(Hierarchy(levels.begin(), levels.begin() + k + 1));
    for (Index i = 0; i < again.rows(); ++i) {
      if (std::abs(violation(again, i, x)) == 0.0 && again.lower[i] < again.upper[i]) continue;
      again.lower[i] = -kNoLimit;
      again.upper[i] = kNoLimit;
    }
    Hierarchy repeated = levels;
    repeated.insert(repeated.begin() + k + 1, again);
    expect_same_answer(levels, solve(levels), solve(repeated));
  });
}

TEST_P(SolverProperties, SameInputSameBitsAndResetIsCold) {
  each_problem(30, {0.1, 0.0}, [](const Hierarchy& levels, Draw&) {
    const Index n = unknowns_of(levels);
    Solver a(n), b(n);
    const Vector cold = a.solve(levels).x, warm = a.solve(levels).x;
    EXPECT_EQ(b.solve(levels).x, cold);
    EXPECT_EQ(b.solve(levels).x, warm);
    const double optimality = b.solution().optimality;
    a.reset();
    EXPECT_EQ(a.solve(levels).x, cold);
    EXPECT_EQ(a.solve(levels).x, warm);
    EXPECT_EQ(a.solution().optimality, optimality);
  });
}

double wild_number(Draw& draw) {
  return draw.choose({std::nan(""), kNoLimit, -kNoLimit, 1e300, -1e300, 1e155, 1e-155, 5e-324, 1e20,
                      -1e20, 1e19, 1e100, 0.0});
}

TEST_P(SolverProperties, WildNumbersAreRefusedOrSolvedNeverWorse) {
  each_problem(100, {0.1, 0.0}, [](Hierarchy levels, Draw& draw) {
    for (Index count = draw.integer(1, 3); count > 0; --count) {
      Level& level = levels[draw.integer(0, static_cast<Index>(levels.size()) - 1)];
      if (level.rows() == 0) continue;
      const Index i = draw.integer(0, level.rows() - 1), what = draw.integer(0, 3);
      if (what == 0 && !level.bounds)
        level.A(i, draw.integer(0, level.A.cols() - 1)) = wild_number(draw);
      if (what == 1) level.lower[i] = wild_number(draw);
      if (what == 2) level.upper[i] = wild_number(draw);
      if (what == 3) level.lower[i] = level.upper[i] = wild_number(draw);
    }
    bool refused = false;
    try {
      check(levels, unknowns_of(levels));
    } catch (const Error& error) {
      refused = true;
      EXPECT_NE(std::string(error.what()).find("level "), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("row "), std::string::npos) << error.what();
    }
    Solver solver(unknowns_of(levels));
    for (int warm = 0; warm < 2; ++warm) {
      const Solution& solution = solver.solve(levels);
      EXPECT_EQ(solution.status == SolverStatus::InvalidInput, refused);
      EXPECT_TRUE(solution.x.allFinite());
      if (solution.status == SolverStatus::Solved) {
        EXPECT_LE(solution.optimality, 1e-9);
      }
    }
  });
}

HURCULES_FOR_EACH_CLASS(SolverProperties);

}  // namespace
}  // namespace hurcules

// Strategy: every class of hierarchies along a path: targets, limits and rows move a little from
// tick to tick. On every tick the warm solve is Solved and proven like a cold one, and gives the
// same answer. Tested in x where x is insensitive to rounding, else in the violations.
#include <gtest/gtest.h>

#include <cmath>

#include "hurcules/solver/solver.hpp"
#include "support/each_problem.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

class SolverTrajectories : public EachClass {
 protected:
  [[nodiscard]] bool sensitive() const {
    return is({"near_singular", "thin_cones", "scales", "facing_limits"});
  }
};

// the hierarchy at a phase of its path; a step of 1 in the phase is a tick
class Path {
 public:
  Path(const Hierarchy& levels, Draw& draw, bool rows_move) : start_(levels) {
    for (const Level& level : levels) {
      shift_.push_back(0.3 * draw.vector(level.rows()));
      const Index m = rows_move && !level.bounds ? level.rows() : 0;
      turn_.push_back(0.1 * draw.unit_rows(m, m ? level.A.cols() : 1));
    }
  }
  [[nodiscard]] Hierarchy at(int tick) const {
    Hierarchy levels = start_;
    const double phase = std::sin(0.05 * tick);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      levels[k].lower += phase * shift_[k];
      // an equality stays one
      levels[k].upper =
          (levels[k].lower.array() == start_[k].upper.array() + phase * shift_[k].array())
              .select(levels[k].lower, start_[k].upper + phase * shift_[k]);
      if (turn_[k].size()) levels[k].A += phase * turn_[k];
    }
    return levels;
  }

 private:
  Hierarchy start_;
  std::vector<Vector> shift_;
  std::vector<Matrix> turn_;
};

TEST_P(SolverTrajectories, WarmEqualsColdOnEveryTick) {
  each_problem(12, {0.1, 1e-3, 0.0}, [this](const Hierarchy& levels, Draw& draw) {
    const Index n = unknowns_of(levels);
    const Path path(levels, draw, draw.chance(0.5));
    Solver warm(n);
    for (int tick = 0; tick < 60; ++tick) {
      SCOPED_TRACE("tick " + std::to_string(tick));
      const Hierarchy now = path.at(tick);
      Solver cold(n);
      const Solution& wanted = cold.solve(now);
      const Solution& solution = warm.solve(now);
      ASSERT_EQ(to_string(solution.status), "solved");
      ASSERT_LE(solution.optimality, 1e-9);
      const double size = std::max(1.0, wanted.x.lpNorm<Eigen::Infinity>());
      if (!sensitive()) {
        ASSERT_LE((solution.x - wanted.x).lpNorm<Eigen::Infinity>(), 1e-7 * size);
      }
      for (std::size_t k = 0; k < now.size(); ++k) {
        const double norm =
            now[k].bounds || !now[k].rows() ? 1.0 : now[k].A.rowwise().norm().maxCoeff();
        const double allowed = is({"thin_cones"}) ? kThinRounding : 1e-8;
        ASSERT_LE((solution.violations[k] - wanted.violations[k]).norm(), allowed * norm * size);
      }
    }
  });
}

HURCULES_FOR_EACH_CLASS(SolverTrajectories);

}  // namespace
}  // namespace hurcules

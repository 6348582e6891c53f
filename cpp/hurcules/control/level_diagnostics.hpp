// What each level of a stack fell short of and why, in plain words, for operators and logs:
//
//   left hand: 0.12 m short, held by HIP upper limit and LSP upper limit
// and how near each level is to a singularity.
#pragma once

#include <string>
#include <vector>

#include "hurcules/control/dead_zone.hpp"
#include "hurcules/control/stack_problem.hpp"
#include "hurcules/solver/sensitivity/level_report.hpp"
#include "hurcules/solver/solver.hpp"

namespace hurcules {

// A task that is off its interval and is not being brought back as it asks.
struct Shortfall {
  std::string task;
  double short_by = 0.0;             // [unit] length of the error outside its interval
  std::string unit;                  // Task::unit, "N" of what a force lacks
  std::vector<std::string> held_by;  // limits, other tasks, or a direction that is missing
  bool invalid = false;              // its numbers are not finite: nothing was solved
  bool too_much = false;             // of a force: more than is wanted
  [[nodiscard]] std::string text() const;
};

struct LevelDiagnostics {
  std::string level;
  // of the level's equality rows on the directions that the levels above left: the smallest is the
  // distance to singularity, the product the manipulability; unit of the rows, 1 without such rows
  double smallest_singular_value = 1.0;
  double manipulability = 1.0;
  std::vector<Shortfall> shortfalls;  // empty: all is well
};

// What a controller knows after a solve.
struct SolvedStack {
  const Robot& robot;
  const StackProblem& problem;
  const Solution& solution;
  std::vector<LevelReport> reports;      // of the final levels
  const Eigen::VectorXi& active_limits;  // (n)
  const DeadZone* zone = nullptr;        // null: no level was shortened
};
// [unit] length of a task's error outside its interval, as it was measured last; rows of weight 0 ask
// for nothing
[[nodiscard]] double short_by(const Task& task);
[[nodiscard]] Shortfall shortfall_of(const Task& task, std::vector<std::string> held_by = {});
// of a task whose target gave way by so much [unit], held by motors at their limits
[[nodiscard]] Shortfall gave_way(const Task& task, double by, std::vector<std::string> held_by);
// none where the solver's method makes no reports
[[nodiscard]] std::vector<LevelReport> reports_of(const Solver& solver);
[[nodiscard]] std::vector<LevelDiagnostics> level_diagnostics(const SolvedStack& solved);

}  // namespace hurcules

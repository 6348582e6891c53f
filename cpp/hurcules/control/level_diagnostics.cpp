#include "hurcules/control/level_diagnostics.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "hurcules/base/number_text.hpp"
#include "hurcules/tasks/contact_task.hpp"
#include "hurcules/tasks/force_task.hpp"
#include "hurcules/tasks/pose_task.hpp"
#include "hurcules/tasks/torque_limits.hpp"

namespace hurcules {

namespace {

constexpr double kSmall = 1e-3;  // [m] or [rad] errors below it are nobody's concern
constexpr double kUnkept = 0.1;  // [N m] or [m/s^2] the same
constexpr double kShare = 0.1;   // of what a task asks for; regularisation leaves less than that

// equality rows that ask for something
Index equalities(const StackLevel& source, const Level& level) {
  Index rows = (level.lower.array() == level.upper.array()).count(), first = 0;
  for (const Task* task : source.tasks) {
    for (Index i = 0; i < task->rows(); ++i) {
      const bool equal = level.lower[first + i] == level.upper[first + i];
      if (equal && task->weights()[i] == 0.0) --rows;
    }
    first += task->rows();
  }
  return rows;
}

// of these, largest first
Vector singular_values(const LevelReport& report, Index rows) {
  return report.singular_values.head(std::min(report.singular_values.size(), rows));
}

// what a row of a level is about
std::string row_name(const Robot& robot, const StackLevel& level, Index row) {
  Index first = 0;
  for (const Task* task : level.tasks) {
    if (row < first + task->rows()) return task->row_name(robot, row - first);
    first += task->rows();
  }
  return level.name;
}

std::string holder(const SolvedStack& solved, const ActiveRow& active) {
  const StackLevel& level = solved.problem.stack().levels()[static_cast<std::size_t>(active.level)];
  if (active.level != solved.problem.bounds_level())
    return row_name(solved.robot, level, active.row);
  if (active.row >= solved.active_limits.size()) return "the friction of its contacts";
  const auto i = static_cast<std::size_t>(active.row);
  const std::string side = active.side == Side::Upper ? " upper" : " lower";
  const bool limit = solved.active_limits[active.row] != 0;
  return solved.robot.coordinates()[i].name + (limit ? side + " limit" : " speed or acceleration");
}

// of the rows as they are, without the levels above
Index own_rank(const Level& level) {
  if (level.bounds) return level.rows();
  Eigen::ColPivHouseholderQR<Matrix> qr(level.A);
  qr.setThreshold(1e-9);
  return qr.rank();
}

// the levels above k with equality rows, which took the directions that it lacks
std::string above(const SolvedStack& solved, int k) {
  std::string names;
  for (std::size_t i = 0; i < static_cast<std::size_t>(k); ++i) {
    const Level& level = solved.problem.hierarchy()[i];
    if (level.bounds || !(level.lower.array() == level.upper.array()).any()) continue;
    names += (names.empty() ? "" : ", ") + solved.problem.stack().levels()[i].name;
  }
  return names.empty() ? "tasks above" : "tasks above (" + names + ")";
}

// what pushes back on level k
std::vector<std::string> holders(const SolvedStack& solved, int k, const LevelReport* report) {
  std::vector<std::string> names;
  const auto add = [&names](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const ActiveRow& active : solved.solution.working_set) {
    if (active.held_by != k || active.multiplier <= 0.0) continue;
    add(holder(solved, active));
  }
  if (solved.zone) {
    for (const auto& [level, row] : solved.zone->pressed_rows(static_cast<std::size_t>(k)))
      add(row_name(solved.robot, solved.problem.stack().levels()[level], row));
  }
  for (Index i = 0; solved.zone && i < solved.active_limits.size(); ++i) {
    const int side = solved.zone->pressed(static_cast<std::size_t>(k), i);
    if (side == 0) continue;
    const Coordinate& coordinate = solved.robot.coordinates()[static_cast<std::size_t>(i)];
    add(coordinate.name + (side > 0 ? " upper limit" : " lower limit"));
  }
  if (!report) return names;
  const Level& level = solved.problem.hierarchy()[static_cast<std::size_t>(k)];
  const StackLevel& source = solved.problem.stack().levels()[static_cast<std::size_t>(k)];
  const Index rows = equalities(source, level);
  const Vector values = singular_values(*report, rows);
  const bool weak = values.size() > 0 && values.minCoeff() < std::max(report->rho, 1e-6);
  if (report->rank < own_rank(level)) {
    names.push_back(above(solved, k));
  } else if (weak || report->rank < rows) {
    names.emplace_back("a singular posture");
  }
  return names;
}

// the largest that the rows of a task ask for, and their violation
bool is_kept_from(const Level& level, const Vector& violation, Index row, Index rows) {
  double asked = 0.0;
  for (Index i = row; i < row + rows; ++i) {
    if (level.lower[i] > 0.0) asked = std::max(asked, level.lower[i]);
    if (level.upper[i] < 0.0) asked = std::max(asked, -level.upper[i]);
  }
  return violation.segment(row, rows).cwiseAbs().maxCoeff() > kShare * asked && asked > 0.0;
}

// rows that are kept or not, and have no error that comes back
bool has_no_target(const Task& task) {
  return dynamic_cast<const ContactTask*>(&task) || dynamic_cast<const TorqueLimits*>(&task);
}

// what a solution leaves of the rows of a task, in their unit
double unkept(const Task& task, const Vector& violation, Index first) {
  double sum = 0.0;
  for (Index i = 0; i < task.rows(); ++i)
    if (task.weights()[i] > 0.0) sum += std::pow(violation[first + i] / task.weights()[i], 2);
  return std::sqrt(sum);
}

bool says_something(const Task& task) {
  return task.error().allFinite() && task.jacobian().allFinite() && task.drift().allFinite() &&
         task.velocity_des().allFinite() && task.acceleration_des().allFinite() &&
         !task.lower().hasNaN() && !task.upper().hasNaN();
}

// [N] that a force task lacks of what is wanted, negative: has too much; 0 in the air
double lacking(const ForceTask& task) {
  if (task.state() == ContactState::Free) return 0.0;
  const double wanted = std::abs(task.force_des());
  const double lacks = wanted - std::abs(task.force());
  const double small = std::max(kShare * wanted, task.options().contact.f_min);
  return std::abs(lacks) > small ? lacks : 0.0;
}

// of a force task that does what it wants to no more
std::string stop_of(const ForceTask* task) {
  if (task && task->state() == ContactState::Stopped) return "its stop above f_max";
  if (task && task->state() == ContactState::SensorLost) return "the loss of its sensor";
  return "";
}

LevelDiagnostics diagnose(const SolvedStack& solved, std::size_t k) {
  const StackLevel& source = solved.problem.stack().levels()[k];
  LevelDiagnostics made;
  made.level = source.name;
  const LevelReport* const report = k < solved.reports.size() ? &solved.reports[k] : nullptr;
  if (report) {
    const Level& level = solved.problem.hierarchy()[k];
    const Vector values = singular_values(*report, equalities(source, level));
    if (values.size() > 0) {
      made.smallest_singular_value = values.minCoeff();
      made.manipulability = values.prod();
    }
  }
  if (solved.solution.status == SolverStatus::InvalidInput) {
    if (source.limits && !source.limits->are_numbers())
      made.shortfalls.push_back({source.limits->name(), 0.0, "", {}, true});
    for (const Task* task : source.tasks)
      if (!says_something(*task)) made.shortfalls.push_back({task->name(), 0.0, "", {}, true});
    return made;
  }
  Index row = 0;
  for (const Task* task : source.tasks) {
    const Index first = row;
    row += task->rows();
    if (k >= solved.solution.violations.size()) continue;
    if (has_no_target(*task)) {
      const double left = unkept(*task, solved.solution.violations[k], first);
      if (left > kUnkept)
        made.shortfalls.push_back({task->name(), left, task->unit(),
                                   holders(solved, static_cast<int>(k), report), false});
      continue;
    }
    const auto* const force = dynamic_cast<const ForceTask*>(task);
    const double lacks = force ? lacking(*force) : 0.0;
    if (const std::string stop = stop_of(force); !stop.empty()) {
      made.shortfalls.push_back({task->name(), std::abs(lacks), "N", {stop}, false, lacks < 0.0});
      continue;
    }
    if (lacks != 0.0 && is_kept_from(solved.problem.hierarchy()[k], solved.solution.violations[k],
                                     first, task->rows())) {
      made.shortfalls.push_back({task->name(), std::abs(lacks), "N",
                                 holders(solved, static_cast<int>(k), report), false, lacks < 0.0});
      continue;
    }
    const bool shortened = solved.zone && solved.zone->share(k) < 1.0 - kShare;
    if (short_by(*task) < kSmall) continue;
    if (!shortened && !is_kept_from(solved.problem.hierarchy()[k], solved.solution.violations[k],
                                    first, task->rows())) {
      continue;
    }
    made.shortfalls.push_back(shortfall_of(*task, holders(solved, static_cast<int>(k), report)));
  }
  return made;
}

}  // namespace

std::string Shortfall::text() const {
  if (invalid) return task + ": its numbers are not finite, the controller brakes";
  std::string line = task + ": " + number_text(short_by, 3) + (unit.empty() ? "" : " " + unit);
  line += too_much ? " too much" : " short";
  for (std::size_t i = 0; i < held_by.size(); ++i) {
    line += i == 0 ? ", held by " : i + 1 < held_by.size() ? ", " : " and ";
    line += held_by[i];
  }
  return line;
}

double short_by(const Task& task) {
  double squares = 0.0;
  for (Index i = 0; i < task.rows(); ++i) {
    if (task.weights()[i] > 0.0) squares += std::pow(task.beyond(i), 2);
  }
  return std::sqrt(squares);
}

Shortfall shortfall_of(const Task& task, std::vector<std::string> held_by) {
  return {task.name(), short_by(task), task.unit(), std::move(held_by)};
}

Shortfall gave_way(const Task& task, double by, std::vector<std::string> held_by) {
  const bool pose = dynamic_cast<const PoseTask*>(&task) != nullptr;  // its position alone
  return {task.name(), by, pose ? "m" : task.unit(), std::move(held_by)};
}

std::vector<LevelReport> reports_of(const Solver& solver) {
  if (!solver.solved()) return {};
  return solver.reports();
}

std::vector<LevelDiagnostics> level_diagnostics(const SolvedStack& solved) {
  std::vector<LevelDiagnostics> diagnostics;
  for (std::size_t k = 0; k < solved.problem.hierarchy().size(); ++k)
    diagnostics.push_back(diagnose(solved, k));
  return diagnostics;
}

}  // namespace hurcules

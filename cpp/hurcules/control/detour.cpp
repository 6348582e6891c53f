#include "hurcules/control/detour.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"

namespace hurcules {

namespace {

constexpr double kCrawl = 1e-2;     // [rad/s] or [m/s]
constexpr double kStill = 0.1;      // [s] slower than that, and no nearer: it may be so for ever
constexpr double kBarred = 1.0;     // [s] the same on the way, which may begin slowly
constexpr double kNearer = 1e-3;    // [m/s] or [rad/s], less is no nearer; at most this share
constexpr double kShare = 0.1;      // of how fast a task is to come
constexpr double kRest = 1e-3;      // [rad/s] or [m/s]: it stands
constexpr double kMostTicks = 1e6;  // of a look
constexpr double kThere = 1e-2;     // [rad] or [m] of each coordinate: the posture is reached

std::vector<StackLevel> joined(std::vector<StackLevel> levels,
                               const std::vector<StackLevel>& more) {
  levels.insert(levels.end(), more.begin(), more.end());
  return levels;
}

std::vector<Task*> tasks_of(const std::vector<StackLevel>& levels) {
  std::vector<Task*> tasks;
  for (const StackLevel& level : levels)
    tasks.insert(tasks.end(), level.tasks.begin(), level.tasks.end());
  require(!tasks.empty(), "Detour wants at least one task as a target");
  return tasks;
}

Index rows_of(const std::vector<Task*>& tasks) {
  Index rows = 0;
  for (const Task* const task : tasks) rows += task->rows();
  return rows;
}

}  // namespace

Detour::Detour(const Robot& robot, const std::vector<StackLevel>& before,
               const std::vector<StackLevel>& targets, const std::vector<StackLevel>& below,
               DetourOptions options)
    : options_(options),
      posture_("detour", robot),
      targets_(tasks_of(targets)),
      direct_(joined(joined(before, targets), below)),
      way_(joined(before, {StackLevel(posture_)})),
      probe_(robot.model(), robot.coordinate_names()),
      search_(robot, Stack(joined(before, targets)), options.search),
      first_target_(before.size()),
      moved_by_(options.tolerance),
      errors_(rows_of(targets_)) {
  require(options.tolerance > 0.0,
          "Detour: tolerance wants a positive number, got " + number_text(options.tolerance));
  require(options.nearer > 0.0,
          "Detour: nearer wants a positive number, got " + number_text(options.nearer));
  require(options.rate > 0.0 && std::isfinite(options.rate),
          "Detour: rate wants a positive number, got " + number_text(options.rate));
}

void Detour::reset() {
  state_ = State::Direct;
  still_ = 0.0;
  judged_ = false;
  decision_.clear();
}

bool Detour::look(const Robot& robot, const ConstVectorRef& velocity, double dt) {
  if (velocity.size() != robot.size() || !velocity.allFinite()) {
    throw Error("Detour: a velocity wants " + std::to_string(robot.size()) +
                " finite numbers, got " + std::to_string(velocity.size()) +
                (velocity.allFinite() ? "" : ", not all finite"));
  }
  decision_.clear();
  const double speed = velocity.cwiseAbs().maxCoeff();
  if (state_ != State::Direct && targets_moved(robot)) return let_targets_rule("a target moved");
  switch (state_) {
    case State::Direct: {
      double most = 0.0, slowest = posture_.max_speed();
      for (const Task* const task : targets_) {
        most = std::max(most, short_by(*task));
        slowest = std::min(slowest, task->max_speed());
      }
      if (most <= options_.tolerance) judged_ = false;
      const bool waits = rests(most, speed, slowest, dt) >= kStill;
      if (waits && most > options_.tolerance && !(judged_ && !targets_moved(robot)))
        begin_search(robot);
      return false;
    }
    case State::Searching: {
      const double ticks = std::clamp(options_.rate * dt, 1.0, kMostTicks);
      return !search_.advance(static_cast<int>(ticks)) && end_search(robot, speed < kRest);
    }
    case State::Way:
      posture_.update(robot);
      const double off = posture_.error().cwiseAbs().maxCoeff();
      if (off < kThere) return let_targets_rule(returns_ ? "it is back" : "the posture is reached");
      return rests(off, speed, posture_.max_speed(), dt) >= kBarred && be_barred(off);
  }
  return false;
}

// [s] that it has hardly moved and come no nearer; slowest [1/s]: how fast it is to come
double Detour::rests(double missing, double speed, double slowest, double dt) {
  const double least = std::min(kNearer, kShare * slowest) * std::max(still_, kStill);
  if (speed > kCrawl || still_ == 0.0 || std::abs(missing - then_) > least) {
    then_ = missing;
    still_ = dt;
    return 0.0;
  }
  return still_ += dt;
}

void Detour::begin_search(const Robot& robot) {
  const Task* worst = targets_.front();
  for (const Task* const task : targets_)
    if (short_by(*task) > short_by(*worst)) worst = task;
  short_ = shortfall_of(*worst).text() + "; ";
  judge(robot, robot.qpos());
  moved_by_ = options_.tolerance;
  search_.begin(robot);
  state_ = State::Searching;
}

bool Detour::end_search(const Robot& robot, bool rests) {
  const Posture found = search_.best();
  if (found.reached && found.starts == 1 && !rests) {  // it gets there by itself
    reset();
    return false;
  }
  const double away = (found.configuration - robot.configuration()).cwiseAbs().maxCoeff();
  if (found.reached && away < kThere) {  // no other posture, but its last millimetre
    state_ = State::Direct;
    return false;
  }
  const double nearer = found.reached ? 0.0 : search_.nearer(first_target_);
  if (!found.reached && nearer < options_.nearer) {
    state_ = State::Direct;
    decision_ = short_ + "none of " + std::to_string(found.starts) +
                " descents finds a posture for all targets" +
                (std::isfinite(options_.nearer) ? ", or a nearer one" : "");
    return false;
  }
  judge(robot, found.qpos);
  moved_by_ = found.reached ? options_.tolerance : options_.nearer;
  posture_.set_target(found.configuration);
  began_ = robot.configuration();
  returns_ = false;
  state_ = State::Way;
  still_ = 0.0;
  decision_ = short_ + "goes round by another posture";
  if (!found.reached) decision_ += ", nearer by " + number_text(nearer, 3);
  return true;
}

// back to where it came from, unless that is barred too
bool Detour::be_barred(double off) {
  const std::string why = "barred, " + number_text(off, 3) + " before the posture";
  if (returns_) return let_targets_rule(why);
  returns_ = true;
  posture_.set_target(began_);
  still_ = 0.0;
  decision_ = why + "; goes back";
  return false;
}

// whether a stack must change
bool Detour::let_targets_rule(const std::string& why) {
  const bool was_on_the_way = on_the_way();
  state_ = State::Direct;
  still_ = 0.0;
  if (was_on_the_way) decision_ = why + "; the targets rule again";
  return was_on_the_way;
}

void Detour::judge(const Robot& robot, const Vector& qpos) {
  judged_ = true;
  judged_at_ = qpos;
  judged_errors_ = errors_at(robot, qpos);
}

bool Detour::targets_moved(const Robot& robot) {
  return (errors_at(robot, judged_at_) - judged_errors_).cwiseAbs().maxCoeff() > moved_by_;
}

// of all targets at this posture, the support being where it is now; they are measured where the robot
// is again afterwards
const Vector& Detour::errors_at(const Robot& robot, const Vector& qpos) {
  probe_.set_qpos(qpos);
  if (robot.root_qpos() >= 0 && !robot.floating()) {
    const Frame support = robot.support();
    const Matrix3 turn = robot.orientation(support) * probe_.orientation(support).transpose();
    qpos_ = qpos;
    auto root = qpos_.segment<7>(robot.root_qpos());
    const Vector3 place = root.head<3>();
    const Eigen::Quaterniond stood(root[3], root[4], root[5], root[6]);
    const Eigen::Quaterniond turned = Eigen::Quaterniond(turn) * stood;
    root << robot.position(support) + turn * (place - probe_.position(support)), turned.w(),
        turned.vec();
    probe_.set_qpos(qpos_);
  }
  Index row = 0;
  for (Task* const task : targets_) {
    task->update(probe_);
    errors_.segment(row, task->rows()) = (task->weights().array() > 0.0).select(task->error(), 0.0);
    row += task->rows();
    task->update(robot);
  }
  return errors_;
}

}  // namespace hurcules

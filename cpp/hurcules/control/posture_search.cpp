#include "hurcules/control/posture_search.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/control/level_diagnostics.hpp"

namespace hurcules {

namespace {

constexpr double kDt = 0.02, kGain = 20.0;  // [s], [1/s] of a descent
constexpr int kSecond = 50;                 // [ticks]
constexpr int kLeast = 10, kMost = 1000;    // [s] it takes: a base may have far to go
constexpr double kWay = 0.1;                // [m or rad] a second, of one that goes on then
constexpr double kFast = 1.5;   // [m or rad/s] at least, also where a task is to go slowly
constexpr double kWide = 1e5;   // [rad] or [m] of a range: a wider one is none
constexpr double kRest = 1e-5;  // [rad/s] or [m/s]: it goes no farther
constexpr double kFree = M_PI;  // [rad] or [m] about where one without range is

VelocityControllerOptions descent() {
  VelocityControllerOptions options;
  options.dt = kDt;
  options.gain = kGain;
  options.max_acceleration = std::numeric_limits<double>::infinity();
  options.transition = 0.0;
  return options;
}

// the same levels of other tasks
Stack copied(const Stack& stack, std::vector<const Task*>& originals,
             std::vector<std::unique_ptr<Task>>& tasks) {
  std::vector<StackLevel> levels = stack.levels();
  for (StackLevel& level : levels) {
    for (Task*& task : level.tasks) {
      originals.push_back(task);
      tasks.push_back(task->clone());
      task = tasks.back().get();
    }
  }
  return Stack(std::move(levels));
}

// [m] or [rad] that the row lacks whose interval is farthest off; rows of weight 0 lack nothing
double lacking(const Task& task) {
  double most = 0.0;
  for (Index i = 0; i < task.rows(); ++i) {
    if (!(task.weights()[i] > 0.0)) continue;
    const double error = task.error()[i];
    most = std::max(most, std::abs(std::clamp(error, task.lower()[i], task.upper()[i]) - error));
  }
  return most;
}

double farthest(const Posture& posture, const Vector& from) {
  return (posture.configuration - from).cwiseAbs().maxCoeff();
}

}  // namespace

PostureSearch::PostureSearch(const Robot& robot, const Stack& stack, PostureSearchOptions options)
    : options_(options),
      robot_(robot.model(), robot.coordinate_names()),
      stack_(copied(stack, originals_, tasks_)),
      controller_(robot_, descent()),
      random_(options.seed),
      lacks_(stack.levels().size(), 0.0) {
  require(!tasks_.empty(), "inverse_kinematics: wanted at least one task");
  require(options.starts >= 1,
          "inverse_kinematics: starts wants a number >= 1, got " + std::to_string(options.starts));
  require(options.tolerance > 0.0, "inverse_kinematics: tolerance wants a positive number, got " +
                                       number_text(options.tolerance));
  controller_.set_stack(stack_);
  begin(robot);
}

void PostureSearch::begin(const Robot& robot) {
  if (robot.support_name() != robot_.support_name()) {
    robot_.set_qpos(robot.qpos());
    robot_.stand_on(robot.support());
  }
  robot_.set_qpos(robot.qpos());
  present_ = robot_.configuration();
  whole_ = robot_.qpos();
  std::vector<double> state;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    state.clear();
    StateWriter writer(state);
    originals_[i]->save(writer);
    originals_[i]->save_settings(writer);
    StateReader reader(state);
    tasks_[i]->restore(reader);
    tasks_[i]->restore_settings(reader);
    tasks_[i]->set_max_speed(std::max(tasks_[i]->max_speed(), kFast));
    tasks_[i]->set_max_acceleration(std::numeric_limits<double>::infinity());
  }
  random_ = Random(options_.seed);
  ends_.clear();
  over_ = false;
  begin_descent();
}

// from where its robot is
void PostureSearch::begin_descent() {
  controller_.reset();
  nearest_.assign(lacks_.size(), std::numeric_limits<double>::infinity());
  ticks_ = 0;
}

bool PostureSearch::advance(int ticks) {
  for (int i = 0; i < ticks && !over_; ++i) tick();
  return !over_;
}

void PostureSearch::tick() {
  controller_.compute(robot_);
  measure();
  if (ends_.empty() && ticks_ == 0) present_lacks_ = lacks_;
  const bool rests = controller_.velocity().cwiseAbs().maxCoeff() < kRest;
  if (most_ <= 0.1 * options_.tolerance || rests || gets_no_nearer()) {
    end_descent();
    return;
  }
  ++ticks_;
  Vector q = robot_.configuration();
  controller_.integrate(q);
  robot_.set_configuration(q);
}

// of the tasks where the controller has measured them
void PostureSearch::measure() {
  most_ = 0.0;
  for (std::size_t k = 0; k < lacks_.size(); ++k) {
    double squares = 0.0;
    for (const Task* const task : stack_.levels()[k].tasks) {
      most_ = std::max(most_, lacking(*task));
      const double by = short_by(*task);
      squares += by * by;
    }
    lacks_[k] = std::sqrt(squares);
  }
}

bool PostureSearch::gets_no_nearer() {
  if (ticks_ >= kMost * kSecond) return true;
  if (ticks_ == 0 || ticks_ % kSecond != 0) return false;
  bool goes_on = false;
  for (std::size_t k = 0; k < lacks_.size(); ++k) {
    goes_on = goes_on || lacks_[k] < nearest_[k] - kWay;
    nearest_[k] = std::min(nearest_[k], lacks_[k]);
  }
  return !goes_on && ticks_ >= kLeast * kSecond;
}

void PostureSearch::end_descent() {
  Posture posture{robot_.configuration(), robot_.qpos()};
  posture.error = most_;
  posture.reached = posture.error <= options_.tolerance;
  ends_.push_back({std::move(posture), lacks_});
  const auto begun = static_cast<int>(ends_.size());
  over_ = (begun == 1 && ends_.front().posture.reached) || begun == options_.starts;
  if (over_) return;
  const Vector q = drawn();
  robot_.set_qpos(whole_);
  robot_.set_configuration(q);
  begin_descent();
}

// a random posture, the farther from the present one the more descents there were
Vector PostureSearch::drawn() {
  Vector inside = present_, q = present_;
  const std::vector<Coordinate>& coordinates = robot_.coordinates();
  for (Index i = 0; i < q.size(); ++i) {
    const Coordinate& one = coordinates[static_cast<std::size_t>(i)];
    const bool free = !(one.upper - one.lower < kWide);
    const double lower = free ? present_[i] - kFree : one.lower;
    const double upper = free ? present_[i] + kFree : one.upper;
    inside[i] = std::clamp(present_[i], one.lower, one.upper);
    q[i] = lower + 0.5 * (random_.symmetric() + 1.0) * (upper - lower);
  }
  for (const RotationVector& rotation : robot_.rotations()) {
    auto vector = q.segment<3>(rotation.first);
    if (vector.norm() > rotation.range) vector *= rotation.range / vector.norm();
  }
  const double share = static_cast<double>(ends_.size()) / options_.starts;
  return inside + share * (q - inside);
}

const PostureSearch::End& PostureSearch::best_end() const {
  require(over_, "the search for a posture is not over yet: advance returns true");
  const auto nearer = [&](const End& a, const End& b) {
    if (a.posture.reached != b.posture.reached) return a.posture.reached;
    if (a.posture.reached) return farthest(a.posture, present_) < farthest(b.posture, present_);
    const auto less = [&](double one, double other) {
      return std::floor(one / step_of_lacks()) < std::floor(other / step_of_lacks());
    };
    return std::lexicographical_compare(a.lacks.begin(), a.lacks.end(), b.lacks.begin(),
                                        b.lacks.end(), less);
  };
  return *std::min_element(ends_.begin(), ends_.end(), nearer);
}

Posture PostureSearch::best() const {
  Posture best = best_end().posture;
  best.starts = static_cast<int>(ends_.size());
  best.reaching = static_cast<int>(std::count_if(
      ends_.begin(), ends_.end(), [](const End& one) { return one.posture.reached; }));
  return best;
}

double PostureSearch::nearer(std::size_t first) const {
  const std::vector<double>& found = best_end().lacks;
  double most = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double less = present_lacks_[k] - found[k];
    if (less < -step_of_lacks()) break;
    if (k >= first) most = std::max(most, less);
  }
  return most;
}

Posture inverse_kinematics(const Robot& robot, const Stack& stack,
                           const PostureSearchOptions& options) {
  PostureSearch search(robot, stack, options);
  while (search.advance(1000)) {
  }
  return search.best();
}

}  // namespace hurcules

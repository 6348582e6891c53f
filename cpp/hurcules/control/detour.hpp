// A way round by another posture, where a controller rests short of what it could reach.
//
// A controller descends; where limits of joints end the descent, the target wants another posture: an
// elbow or a wrist turned the other way. Once the robot rests short of a target, a detour looks for
// one (posture_search.hpp), leads all joints there with what comes before all else kept, and lets the
// targets rule again. The hand may go a long way round meanwhile. Where no posture meets all targets,
// one that comes clearly nearer to the first of them that it can is as good.
#pragma once

#include <string>
#include <vector>

#include "hurcules/control/posture_search.hpp"
#include "hurcules/tasks/posture_task.hpp"

namespace hurcules {

struct DetourOptions {
  PostureSearchOptions search = {};
  double tolerance = 1e-3;  // [m] or [rad] that a target may be short of at rest
  // [m] or [rad] by which a posture that does not meet all targets must come nearer; inf: none does
  double nearer = 0.02;
  double rate = 5e3;  // [1/s] ticks of a search a second of the loop; each costs a control tick
};

class Detour {
 public:
  // Levels in decreasing priority: `before` holds on the way too (limits, distances), `targets` shall be
  // met, `below` takes what freedom is left. The robot is the one that the tasks were made for, or one
  // of the same model. Throws Error without a target, for a task that stands twice, and options that
  // are none.
  Detour(const Robot& robot, const std::vector<StackLevel>& before,
         const std::vector<StackLevel>& targets, const std::vector<StackLevel>& below = {},
         DetourOptions options = {});

  // what rules at the start, and what rules on the way
  [[nodiscard]] const Stack& direct() const { return direct_; }
  [[nodiscard]] const Stack& way() const { return way_; }
  [[nodiscard]] PostureTask& posture() { return posture_; }  // of the way; to bound its speed, say

  // After each tick: the robot at the reference, its velocity (n), the period [s]. True where from now on
  // the other stack shall rule. While the robot rests short of a target, each look takes a search some
  // ticks further. For the same targets there is one search: where it finds none, the robot stays at
  // rest until a target moves; where what comes before bars the way, it goes back first. A target that
  // moves on the way ends the detour: by `tolerance`, or by `nearer` where it is not to be met.
  bool look(const Robot& robot, const ConstVectorRef& velocity, double dt);
  [[nodiscard]] bool on_the_way() const { return state_ == State::Way; }
  // what the last look decided, in words; "" where all goes on
  [[nodiscard]] const std::string& decision() const { return decision_; }
  // the direct stack rules, as at the start
  void reset();

 private:
  enum class State { Direct, Searching, Way };
  double rests(double missing, double speed, double slowest, double dt);
  void begin_search(const Robot& robot);
  bool end_search(const Robot& robot, bool rests);
  bool let_targets_rule(const std::string& why);
  bool be_barred(double off);
  void judge(const Robot& robot, const Vector& qpos);
  [[nodiscard]] bool targets_moved(const Robot& robot);
  const Vector& errors_at(const Robot& robot, const Vector& qpos);

  DetourOptions options_;
  PostureTask posture_;
  std::vector<Task*> targets_;
  Stack direct_, way_;
  Robot probe_;  // where the targets are judged
  PostureSearch search_;
  State state_ = State::Direct;
  double still_ = 0.0;  // [s] that it has come no nearer
  double then_ = 0.0;   // [m] or [rad] that was missing at the start of that
  bool judged_ = false;
  bool returns_ = false;      // the way was barred
  Vector began_;              // (n) where it began
  std::size_t first_target_;  // of the levels of the search
  double moved_by_;           // [m] or [rad] from which on a target has moved
  Vector judged_at_,
      judged_errors_;     // (nq), (rows) what the targets lacked there at the last search
  Vector errors_, qpos_;  // (rows), (nq) scratch
  std::string short_, decision_;
};

}  // namespace hurcules

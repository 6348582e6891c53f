// Who commands a simulation from above: a mission, say. The simulation asks it each tick what to do
// and tells it what came of it.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/control/whole_body_controller.hpp"
#include "hurcules/sim/plant.hpp"
#include "hurcules/sim/recorder.hpp"

namespace hurcules {

// One number that a run is judged by.
struct Figure {
  std::string name;     // with its unit: pelvis_error_m
  double value = 0.0;   // NaN: has not happened
  double thesis = 0.0;  // what the thesis reports, NaN for nothing
  // what it must be, for success
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

// Why a supervisor left the way that its phases would go.
struct Cause {
  std::size_t phase = 0;
  std::size_t trouble = 0;  // 0: it took too long, else the number of one of its troubles and 1
  std::size_t reaction =
      0;  // the number of what it does about that and 1; 0: not told, or none is left
};

// What came out of a tick, for the figures.
struct TickReport {
  double time = 0.0;                     // [s]
  const Eigen::VectorXi& active_limits;  // (n), -1 0 1
  double joint_error = 0.0;              // [rad] largest of all coordinates' joints
  double torque_excess = 0.0;            // [N m] worst demand so far above what a motor can give
  // the controller's tasks, in its order, measured at the plan or at the real robot
  const std::vector<const Task*>& tasks;
};

class Supervisor {
 public:
  virtual ~Supervisor() = default;

  // once, before anything else: the plant that it will see, and the log, to which it may add
  // channels of its own and whose channels it may watch
  virtual void attach(const Plant& /*plant*/, Recorder& /*log*/) {}

  // qpos (nq) at which a run of this seed starts; `robot` is scratch and stands on the support
  [[nodiscard]] virtual Vector start(const Plant& plant, Robot& robot, std::uint64_t seed) = 0;
  // the controller and the world stand there
  virtual void reset(WholeBodyController& controller, const Robot& world) = 0;
  // what the operator would command for the next dt [s], (k)
  virtual const Vector& command(double dt) = 0;
  // which brakes are shut in this tick; those of the tracks are the drive's
  virtual void brake(Brakes& /*brakes*/) {}
  // after the tasks were measured at the plan; then again at the real robot
  virtual void note_commanded(const WholeBodyController& controller, const TickReport& report) = 0;
  virtual void note_measured(const TickReport& report) = 0;
  // goes on to the next phase where one is over; false when the last one is
  virtual bool advance(WholeBodyController& controller, double time) = 0;
  // what it reacted to in the last advance, and that in words
  [[nodiscard]] virtual std::optional<Cause> reacted() const { return std::nullopt; }
  [[nodiscard]] virtual std::string text(const Cause& /*cause*/) const { return ""; }
  // the body that the present phase stands on has borne nothing for too long: once a phase
  [[nodiscard]] virtual bool unborne() const { return false; }
  // the present phase, and what it waits for, in words
  [[nodiscard]] virtual std::string waits_for() const { return ""; }

  // begins this phase at this time [s]
  virtual void go(std::size_t phase, WholeBodyController& controller, double time) = 0;

  // Stands still, its clocks too, until it is resumed: where it was, or, where somebody commanded
  // meanwhile, with its phase begun anew.
  virtual void pause() {}
  virtual void resume(WholeBodyController& /*controller*/, double /*time*/) {}
  [[nodiscard]] virtual bool paused() const { return false; }
  // [s] until when it waits for an answer, after which silence is a no; none: it does not ask
  [[nodiscard]] virtual std::optional<double> asks_until() const { return std::nullopt; }
  // what it asks, in words
  [[nodiscard]] virtual std::string question() const { return ""; }
  virtual void answer(bool /*yes*/) {}

  [[nodiscard]] virtual std::vector<std::string> phase_names() const = 0;
  [[nodiscard]] virtual std::size_t phase() const = 0;
  [[nodiscard]] virtual const std::vector<Figure>& figures() const = 0;
  // "" when all went well, else what is missing; asked once, at the end
  [[nodiscard]] virtual std::string_view verdict() const = 0;
  virtual void save(StateWriter& writer) const = 0;
  virtual void restore(StateReader& reader) = 0;
  // the same for a controller that was cloned from this one's
  [[nodiscard]] virtual std::unique_ptr<Supervisor> clone(
      WholeBodyController& controller) const = 0;
};

}  // namespace hurcules

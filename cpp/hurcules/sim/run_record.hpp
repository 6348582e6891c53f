// What a run leaves behind, tick by tick: the telemetry, its time series, the events.
#pragma once

#include <string>
#include <vector>

#include "hurcules/control/whole_body_controller.hpp"
#include "hurcules/sim/events.hpp"
#include "hurcules/sim/monitors.hpp"
#include "hurcules/sim/recorder.hpp"
#include "hurcules/sim/stage_timer.hpp"
#include "hurcules/sim/telemetry.hpp"

namespace hurcules {

class RunRecord {
 public:
  // what is measured at; the true robot, and the robot as the sensors say (the same without models)
  struct Sensed {
    const Robot& world;
    const Robot& seen;
    const Vector& qvel;       // (nv) true
    const Vector& seen_qvel;  // (nv)
  };
  // of a controller, whose stacks, joints and commands name the channels
  RunRecord(const WholeBodyController& controller, std::vector<std::string> phases);
  RunRecord(const RunRecord&) = delete;
  RunRecord& operator=(const RunRecord&) = delete;

  void reset();
  void note_sensed(const WholeBodyController& controller, const Sensed& sensed);
  // where the support is and how it moves
  void note_base(const Sensed& sensed, Frame support, const std::optional<Frame>& target);
  // after solve: the answer, and the errors of the tasks at the plan
  void note_solution(const WholeBodyController& controller);
  void note_servo(const WholeBodyController& controller);
  // errors of the tasks as measured at the real robot, in the controller's order
  void note_measured(const WholeBodyController& controller, const std::vector<const Task*>& tasks);
  void note_events(const Monitors& monitors);
  void note_phase(std::size_t phase);
  // of what happens in a phase
  void note(EventKind kind, std::size_t phase, int side = 0, int answer = 0);

  [[nodiscard]] std::string text(const Event& event, const Monitors& monitors) const;
  [[nodiscard]] const TelemetryNames& names() const { return names_; }
  void truncate(double time);  // [s]
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

  Telemetry telemetry;
  Recorder log, timings, observation;
  EventList events;
  Vector stage_seconds;  // (kStages)

 private:
  // where the telemetry keeps the levels of a stack, and the rows of their tasks
  struct TaskPlace {
    std::size_t task = 0;  // number among the controller's
    Index first_row = 0;
  };
  struct StackPlaces {
    std::vector<Index> level;
    std::vector<std::vector<TaskPlace>> tasks;  // of each level
  };
  void copy_errors(const StackPlaces& places, const std::vector<const Task*>& tasks, Vector& levels,
                   Vector& rows) const;

  TelemetryNames names_;
  std::vector<std::string> phases_;
  std::vector<StackPlaces> places_;          // one for each stack
  std::vector<const Task*> planned_;         // the controller's tasks
  std::vector<const ForceTask*> forces_;     // of them
  Vector previous_active_, previous_alarm_;  // (n), (Monitors::kQuantities)
};

}  // namespace hurcules

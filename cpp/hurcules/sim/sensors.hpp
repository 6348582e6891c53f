// All sensors of the robot: what the control loop may know of the physics.
//
// Each sensor is ideal until a model is given for it, and an ideal one repeats the physics bit for
// bit. Sensors are sampled once a tick, after the step; the next tick acts on that. A fault can be
// put into single entries. The suite is part of a simulation's snapshot.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/range_finder.hpp"
#include "hurcules/sim/recorder.hpp"
#include "hurcules/sim/sensor.hpp"
#include "hurcules/sim/sensor_monitor.hpp"

namespace hurcules {

enum class FaultKind {
  NotANumber,  // the entry reads NaN
  Frozen,      // it repeats what it said last
};

struct SensorFault {
  std::string entry;  // "encoder_position/LSP"
  FaultKind kind = FaultKind::NotANumber;
  double start = 0.0;  // [s] of the simulation
};

struct SensorOptions {
  std::map<std::string, SensorModel> models;  // by sensor; the others are ideal
  RangeFinderOptions range;
  std::vector<SensorFault> faults;
  SensorMonitorOptions monitor;
  double hold_seconds = 1.0;  // [s] that a robot which lost a joint's encoder is held and watched
};

class Sensors {
 public:
  // of the robot whose coordinates `robot` has; dt [s] from one sample to the next. Throws Error for
  // a sensor or an entry that does not exist, and numbers out of range.
  Sensors(const Robot& robot, double dt, const SensorOptions& options);
  // readings start as the truth; draws biases
  void reset(const mjData_* data, std::uint64_t seed);
  // after a step; time [s] at its end
  void sample(const mjModel_* model, mjData_* data, double time);

  // some entry of the state (encoders, pose) may differ from the physics
  [[nodiscard]] bool alter_state() const { return alter_state_; }
  // the state as the sensors say it; what is not measured stays. An entry that reads NaN keeps the
  // last number that it said. (nq), (nv)
  void overwrite(VectorRef qpos, VectorRef qvel);
  // None while the encoders can be believed, and when nothing alters the state
  [[nodiscard]] SensorMonitor::Finding monitor(const Vector& q_des);
  // whose encoder it is
  [[nodiscard]] const std::string& joint_of(const SensorMonitor::Finding& finding) const {
    return sensors_.front().setup().entries[static_cast<std::size_t>(finding.entry)];
  }
  [[nodiscard]] std::string text(const SensorMonitor::Finding& finding) const;

  [[nodiscard]] const std::vector<Sensor>& all() const { return sensors_; }
  [[nodiscard]] const RangeFinder& range() const { return range_; }
  [[nodiscard]] const SensorOptions& options() const { return options_; }
  [[nodiscard]] std::vector<std::string> names() const;
  // sensor/NAME/ENTRY of those that are not ideal
  void add_log_channels(Recorder& recorder) const;
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Fault {
    std::size_t sensor = 0;
    Index entry = 0;
    FaultKind kind = FaultKind::NotANumber;
    double start = 0.0;  // [s]
    double held = 0.0;   // what the entry said last
  };
  void add_fault(const SensorFault& fault);
  [[nodiscard]] std::size_t find(const std::string& name) const;

  SensorOptions options_;
  std::vector<Sensor> sensors_;
  std::vector<Vector> usable_;  // as the readings, finite
  std::vector<bool> written_;   // to the state
  std::vector<Fault> faults_;
  RangeFinder range_;
  SensorMonitor monitor_;
  bool has_encoders_ = false, alter_state_ = false;
};

}  // namespace hurcules

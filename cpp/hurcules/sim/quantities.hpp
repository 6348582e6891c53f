// Named numbers of a simulation, found once and read together: what an environment observes, say.
//
//   position/FRAME, rotation/FRAME   (3) [m] of its origin, (3) its rotation vector [rad], in W
//   matrix/FRAME                     (9) R_WF row by row
//   velocity/FRAME, spin/FRAME       (3) [m/s], (3) [rad/s] in W
//   value/TASK, target/TASK          (m) of a task whose value is a list of numbers, at the real robot
//   force/TASK                       (1) [N] what a force task read last
//   distance/OBJECT/OBJECT           (1) [m] between two sites, bodies, cameras or geoms
//   joint/JOINT, joint_velocity/JOINT  (1) of any hinge or slide of the model
//   sensor/SENSOR                    (its size) a sensor of the model
//   monitor/NAME                     (1) see Monitors::names
//   excess/KIND, commanded_excess/KIND  (1) worst so far over position, velocity, torque limits
//   contact_force/BODY               (1) [N] sum of the normal forces on a body and all below it
//   self_contacts                    (1) pairs of the robot's own shapes that touch
//   scaled                           (1) 1 where motors slow the motion down
//   finished, ending                 (1) 1 where the simulation is over; its Ending, 0 until then
// and each channel of the observation and the log by its name ("q/KN", "base/x"), or all of them by
// the part before the "/" ("q").
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hurcules/sim/data_quantity.hpp"
#include "hurcules/sim/simulation.hpp"

namespace hurcules {

class Quantities {
 public:
  // throws Error for a name that does not exist
  Quantities(const Simulation& simulation, const std::vector<std::string>& names);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] const std::vector<Index>& sizes() const { return sizes_; }  // of each name
  [[nodiscard]] Index size() const { return size_; }                        // of all
  // as they are now; out (size), one name after the other. `simulation` is the one that the names
  // were found in, or a copy of it; throws Error for another one.
  void read(const Simulation& simulation, VectorRef out) const;

 private:
  enum class Kind {
    Position,
    Rotation,
    RotationMatrix,
    Velocity,
    Spin,
    Value,
    Target,
    Force,
    Data,
    Observation,
    Log,
    Excess,
    ExcessNow,
    CommandedExcess,
    SelfContacts,
    Scaled,
    Finished,
    Ending,
  };
  struct Quantity {
    Kind kind = Kind::Scaled;
    Index size = 1;
    Frame frame;
    std::vector<Index> places;  // channels, or number of the task
    std::optional<DataQuantity> data;
    bool measured = false;  // of Observation: an error of a task
  };
  [[nodiscard]] static Quantity find(const Simulation& simulation, const std::string& name);
  static void read(const Quantity& quantity, const Simulation& simulation, VectorRef out);

  double identity_;
  Index sensor_rows_;
  std::vector<std::string> names_;
  std::vector<Quantity> quantities_;
  std::vector<Index> sizes_;
  Index size_ = 0;
};

}  // namespace hurcules

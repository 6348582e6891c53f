// A mission: a table of phases that commands a simulation, and the figures that tell how it went.
//
// It is made for a controller, whose tasks it knows by name. A command moves the controller's
// channels: the operator's or, in its place, somebody else's.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hurcules/mission/phase.hpp"
#include "hurcules/mission/robot_tables.hpp"
#include "hurcules/sim/simulation.hpp"

namespace hurcules {

// What a mission wants to find when it starts.
struct MissionSetup {
  std::string name;
  std::string scene;         // file under models/
  std::string keyframe;      // where the robot starts
  std::string support;       // body that the robot stands on
  double max_seconds = 0.0;  // [s] the mission fails when it takes longer
  double min_height = 0.0;   // [m] of the pelvis above the support; below, the robot fell
  double max_tilt = 0.0;     // [rad] of the support against its start; above, the robot fell
  std::vector<ServoGains> servo;
};

class Mission : public Supervisor {
 public:
  Mission(const Mission&) = delete;
  Mission& operator=(const Mission&) = delete;

  [[nodiscard]] const MissionSetup& setup() const { return setup_; }
  [[nodiscard]] const std::vector<Phase>& phases() const { return phases_; }

  Vector start(const Plant& plant, Robot& robot, std::uint64_t seed) override;
  void reset(WholeBodyController& controller, const Robot& world) override;
  const Vector& command(double dt) override;
  void note_commanded(const WholeBodyController& controller, const TickReport& report) override = 0;
  bool advance(WholeBodyController& controller, double time) override;
  [[nodiscard]] std::vector<std::string> phase_names() const override;
  [[nodiscard]] std::size_t phase() const override { return phase_; }
  [[nodiscard]] const std::vector<Figure>& figures() const override { return figures_; }
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

 protected:
  // variation: scale of what differs between seeds (variation.hpp)
  Mission(MissionSetup setup, const WholeBodyController& controller, double variation);
  virtual void begin(WholeBodyController& controller, const Robot& world) = 0;
  // what it remembers beside its figures
  virtual void save_memory(StateWriter& writer) const = 0;
  virtual void restore_memory(StateReader& reader) = 0;
  [[nodiscard]] double variation() const { return variation_; }

  std::vector<Phase> phases_;
  std::vector<Figure> figures_;

 private:
  void enter(std::size_t phase, WholeBodyController& controller, double time);

  MissionSetup setup_;
  double variation_;
  const Task* limits_;  // of the first stack, null for none
  std::size_t phase_ = 0;
  double phase_start_ = 0.0;  // [s]
  Vector operated_;
};

struct MissionOptions : SimulationOptions {
  double variation = 1.0;                // scale of what differs between seeds, >= 0
  std::string method = "lexicographic";  // of the solver
  BaseSource base = BaseSource::Held;
};

// The simulation of a mission by name, in its scene. Throws Error with the names that exist.
class MissionSimulation : public Simulation {
 public:
  MissionSimulation(const ModelPtr& model, const std::string& mission,
                    const MissionOptions& options = {}, mjData_* data = nullptr);
  [[nodiscard]] const Mission& mission() const {
    return static_cast<const Mission&>(*supervisor());
  }

 private:
  MissionSimulation(const ModelPtr& model, const std::shared_ptr<WholeBodyController>& controller,
                    const std::string& mission, const MissionOptions& options, mjData_* data);
};

// the parts of it: a controller, and the mission for it
[[nodiscard]] std::shared_ptr<WholeBodyController> make_mission_controller(
    const std::string& mission, const ModelPtr& model, const MissionOptions& options = {});
[[nodiscard]] std::unique_ptr<Mission> make_mission(const std::string& mission,
                                                    WholeBodyController& controller,
                                                    double variation = 1.0);
// what each mission wants, without a robot
[[nodiscard]] const MissionSetup& mission_setup(const std::string& name);
[[nodiscard]] std::vector<std::string> mission_names();

}  // namespace hurcules

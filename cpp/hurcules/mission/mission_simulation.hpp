// The missions that come with the library, by name, and their simulations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hurcules/mission/mission.hpp"
#include "hurcules/sim/simulation.hpp"

namespace hurcules {

struct MissionOptions : SimulationOptions {
  double variation = 1.0;                // scale of what differs between seeds, >= 0
  std::string method = "lexicographic";  // of the solver
  BaseSource base = BaseSource::Held;
};

// The simulation of a mission: one by name, in its scene (throws Error with the names that exist),
// or one made for a controller.
class MissionSimulation : public Simulation {
 public:
  MissionSimulation(const ModelPtr& model, const std::string& mission,
                    const MissionOptions& options = {}, mjData_* data = nullptr);
  MissionSimulation(const ModelPtr& model, const std::shared_ptr<WholeBodyController>& controller,
                    std::unique_ptr<Mission> mission, const MissionOptions& options = {},
                    mjData_* data = nullptr);
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

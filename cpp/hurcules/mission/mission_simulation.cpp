#include "hurcules/mission/mission_simulation.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/stretch.hpp"

namespace hurcules {

namespace {

struct Entry {
  MissionSetup setup;
  std::shared_ptr<WholeBodyController> (*controller)(const Robot& robot,
                                                     const MissionOptions& options);
  std::unique_ptr<Mission> (*mission)(WholeBodyController& controller, double variation);
};

template <class M>
Entry entry() {
  return {M::setup_of(), &M::make_controller,
          [](WholeBodyController& controller, double variation) -> std::unique_ptr<Mission> {
            return std::make_unique<M>(controller, variation);
          }};
}

// all missions that there are
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {entry<Stretch>()};
  return all;
}

const Entry& find(const std::string& name) {
  for (const Entry& candidate : entries()) {
    if (candidate.setup.name == name) return candidate;
  }
  throw Error(unknown_name("mission", name, mission_names()));
}

SimulationOptions with_setup(const MissionSetup& setup, const MissionOptions& options) {
  SimulationOptions all = options;
  all.max_seconds = std::min(all.max_seconds, setup.max_seconds);
  const double low = -std::numeric_limits<double>::infinity();
  if (setup.max_tilt > 0.0)
    all.fall = {setup.fall_frame, setup.fall_frame.empty() ? low : setup.min_height,
                setup.max_tilt};
  return all;
}

const Mission& given(const std::unique_ptr<Mission>& mission) {
  require(mission != nullptr, "a mission is wanted, none came");
  return *mission;
}

}  // namespace

const MissionSetup& mission_setup(const std::string& name) {
  return find(name).setup;
}

std::shared_ptr<WholeBodyController> make_mission_controller(const std::string& mission,
                                                             const ModelPtr& model,
                                                             const MissionOptions& options) {
  const Entry& entry = find(mission);
  Robot robot(model);
  robot.stand_on(entry.setup.support);
  return entry.controller(robot, options);
}

std::unique_ptr<Mission> make_mission(const std::string& mission, WholeBodyController& controller,
                                      double variation) {
  return find(mission).mission(controller, variation);
}

MissionSimulation::MissionSimulation(const ModelPtr& model, const std::string& mission,
                                     const MissionOptions& options, mjData_* data)
    : MissionSimulation(model, make_mission_controller(mission, model, options), mission, options,
                        data) {}

MissionSimulation::MissionSimulation(const ModelPtr& model,
                                     const std::shared_ptr<WholeBodyController>& controller,
                                     const std::string& mission, const MissionOptions& options,
                                     mjData_* data)
    : MissionSimulation(model, controller, make_mission(mission, *controller, options.variation),
                        options, data) {}

MissionSimulation::MissionSimulation(const ModelPtr& model,
                                     const std::shared_ptr<WholeBodyController>& controller,
                                     std::unique_ptr<Mission> mission,
                                     const MissionOptions& options, mjData_* data)
    // braces: the setup is read before the mission is given away
    : Simulation{model, controller, with_setup(given(mission).setup(), options), std::move(mission),
                 data} {}

std::vector<std::string> mission_names() {
  std::vector<std::string> names;
  for (const Entry& candidate : entries()) names.push_back(candidate.setup.name);
  return names;
}

}  // namespace hurcules

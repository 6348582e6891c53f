// What a mission sees of its scene beside the robot: a person, a load, and where the load and its
// container are as the cameras tell it; as columns of the log.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/base/random.hpp"
#include "hurcules/mission/mission_setup.hpp"
#include "hurcules/sim/casualty_monitor.hpp"
#include "hurcules/sim/load_monitor.hpp"
#include "hurcules/sim/place_monitor.hpp"
#include "hurcules/sim/plant.hpp"

namespace hurcules {

class SceneMonitors {
 public:
  // what the setup names, with its columns; the log reads where they are, so this stays in place.
  // Throws Error for names that the model has not.
  void attach(const MissionSetup& setup, const Plant& plant, Recorder& log);
  // of what the cameras tell, at most two standard deviations, times scale
  void draw_errors(Random& random, double scale);
  // a run begins, with the errors that were drawn last
  void reset();
  void look();
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  const mjModel_* model_ = nullptr;
  const mjData_* data_ = nullptr;
  std::unique_ptr<CasualtyMonitor> casualty_;
  std::unique_ptr<LoadMonitor> load_;
  std::vector<std::pair<std::string, PlaceMonitor>> places_;  // by the prefix of their quantities
  std::vector<Vector> errors_;                                // of these, over their deviations
};

}  // namespace hurcules

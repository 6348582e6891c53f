#include "hurcules/mission/mission.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/stretch.hpp"
#include "hurcules/mission/variation.hpp"

namespace hurcules {

Mission::Mission(MissionSetup setup, const WholeBodyController& controller, double variation)
    : setup_(std::move(setup)),
      variation_(variation),
      limits_(controller.law(0).limits()),
      operated_(Vector::Zero(controller.scale().size())) {
  require(variation_ >= 0.0 && std::isfinite(variation_), "variation wants a number >= 0");
}

Vector Mission::start(const Plant& plant, Robot& robot, std::uint64_t seed) {
  Vector qpos = plant.keyframe_qpos(plant.find_keyframe(setup_.keyframe));
  Random random(seed);
  Variation variation;
  variation.scale = variation_;
  const int casualty = plant.other_free_joint(robot.root_body());
  if (casualty >= 0) vary_place(variation, random, qpos.segment<7>(casualty));
  // the posture varies, the support stays: the root of the robot follows
  robot.set_qpos(qpos);
  Vector q = robot.configuration();
  if (limits_) vary_posture(variation, random, {limits_->lower(), limits_->upper()}, q);
  robot.set_configuration(q);
  return robot.qpos();
}

void Mission::reset(WholeBodyController& controller, const Robot& world) {
  for (Figure& figure : figures_) figure.value = std::numeric_limits<double>::quiet_NaN();
  begin(controller, world);
  enter(0, controller, 0.0);
}

bool Mission::advance(WholeBodyController& controller, double time) {
  while (phases_[phase_].done(time - phase_start_)) {
    if (phase_ + 1 == phases_.size()) return false;
    enter(phase_ + 1, controller, time);
  }
  return true;
}

void Mission::enter(std::size_t phase, WholeBodyController& controller, double time) {
  phase_ = phase;
  phase_start_ = time;
  controller.use(phases_[phase_].stack);
  if (phases_[phase_].enter) phases_[phase_].enter(time);
}

const Vector& Mission::command(double dt) {
  operated_.setZero();
  if (phases_[phase_].operate) phases_[phase_].operate(operated_, dt);
  return operated_;
}

std::vector<std::string> Mission::phase_names() const {
  std::vector<std::string> names;
  for (const Phase& phase : phases_) names.push_back(phase.name);
  return names;
}

void Mission::save(StateWriter& writer) const {
  writer.put(static_cast<double>(phase_));
  writer.put(phase_start_);
  for (const Figure& figure : figures_) writer.put(figure.value);
  save_memory(writer);
}

void Mission::restore(StateReader& reader) {
  phase_ = static_cast<std::size_t>(reader.get_count(static_cast<Index>(phases_.size()) - 1));
  phase_start_ = reader.get();
  for (Figure& figure : figures_) figure.value = reader.get_any();
  restore_memory(reader);
}

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
  all.fall = {"pelvis", setup.min_height, setup.max_tilt};
  return all;
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
    : Simulation(model, controller, with_setup(mission_setup(mission), options),
                 make_mission(mission, *controller, options.variation), data) {}

std::vector<std::string> mission_names() {
  std::vector<std::string> names;
  for (const Entry& candidate : entries()) names.push_back(candidate.setup.name);
  return names;
}

}  // namespace hurcules

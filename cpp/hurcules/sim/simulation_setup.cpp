// How a simulation is put together.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/sim/simulation.hpp"

namespace hurcules {

namespace {

// level and task names of all stacks of a mission, in the order in which they first appear
void add_names(const Stack& stack, TelemetryNames& names) {
  for (const StackLevel& level : stack.levels()) {
    if (std::find(names.levels.begin(), names.levels.end(), level.name) != names.levels.end()) {
      continue;
    }
    names.levels.push_back(level.name);
    for (const Task* task : level.tasks) {
      for (Index i = 0; i < task->rows() && !task->bounds_coordinates(); ++i) {
        names.task_rows.push_back(task->name() + "/" + std::to_string(i));
      }
    }
  }
}

TelemetryNames names_of(const Mission& mission, const Robot& robot, const Servo& servo) {
  TelemetryNames names;
  names.coordinates = robot.coordinate_names();
  names.joints = servo.names();
  for (const Phase& phase : mission.phases()) add_names(phase.stack, names);
  for (const Channel& channel : mission.channels()) names.commands.push_back(channel.name);
  return names;
}

// address of the first free joint outside the robot's tree, -1 for none: the casualty
int other_free_joint(const mjModel* m, int robot_root) {
  for (int j = 0; j < m->njnt; ++j) {
    if (m->jnt_type[j] == mjJNT_FREE && m->body_rootid[m->jnt_bodyid[j]] != robot_root) {
      return m->jnt_qposadr[j];
    }
  }
  return -1;
}

// body at the root of the robot's tree
int root_of(const Robot& robot) {
  const mjModel* const m = robot.model().get();
  return m->body_rootid[m->jnt_bodyid[robot.coordinates().front().joints.front().joint]];
}

}  // namespace

Simulation::Simulation(ModelPtr model, const std::string& mission, SimulationOptions options,
                       mjData* data)
    : options_(std::move(options)),
      physics_(std::move(model), data),
      world_(physics_.model_ptr()),
      plan_(physics_.model_ptr()),
      mission_(make_mission(mission, plan_)),
      servo_(world_, mission_->setup().servo, physics_.dt()),
      power_meter_(physics_.model(), options_.power),
      battery_(options_.battery),
      sensors_(world_, root_of(world_), options_.sensors),
      monitors_(physics_.model(), root_of(world_), options_.power.motors, options_.monitors),
      limit_watch_(world_, servo_.pid().options().max_torque),
      fall_watch_({mission_->setup().min_height, mission_->setup().max_tilt}),
      names_(names_of(*mission_, plan_, servo_)),
      telemetry_(names_),
      stage_seconds_(Vector::Zero(kStages)),
      start_qpos_(plan_.qpos()),
      previous_active_(Vector::Zero(plan_.size())),
      previous_alarm_(Vector::Zero(Monitors::kQuantities)),
      held_back_(Vector::Zero(plan_.size())),
      wished_(held_back_),
      seen_qpos_(world_.qpos()),
      seen_qvel_(Vector::Zero(physics_.model()->nv)),
      support_(plan_.frame(mission_->setup().support)),
      pelvis_(plan_.frame("pelvis")) {
  require(options_.variation >= 0.0 && std::isfinite(options_.variation),
          "variation wants a number >= 0");
  const mjModel* const m = physics_.model();
  casualty_qpos_ = other_free_joint(m, root_of(world_));
  if (mj_name2id(m, mjOBJ_SITE, "casualty_chest") >= 0) casualty_ = world_.frame("casualty_chest");
  plan_.stand_on(mission_->setup().support);
  if (sensors_.alter_state()) seen_ = std::make_unique<Robot>(physics_.model_ptr());
  make_controllers();
  telemetry_.add_log_channels(names_, options_.clock != nullptr, log_);
  monitors_.add_log_channels(log_);
  sensors_.add_log_channels(log_);
  telemetry_.add_observation_channels(names_, observation_);
  timings_.add("time", &telemetry_.time);
  for (Index i = 0; i < kStages; ++i) timings_.add(stage_names()[i], stage_seconds_.data() + i);
  reset(options_.seed);
}

void Simulation::make_controllers() {
  VelocityControllerOptions options;
  options.dt = dt();
  options.law = Law::Thesis;  // its missions show the thesis' figures
  options.solver.method = options_.method;
  options.solver.handover = Handover::Smooth;
  std::vector<std::string> stacks;
  for (const Phase& phase : mission_->phases()) {
    const std::string text = phase.stack.text();
    const auto found = std::find(stacks.begin(), stacks.end(), text);
    controller_of_phase_.push_back(static_cast<std::size_t>(found - stacks.begin()));
    if (found != stacks.end()) continue;
    stacks.push_back(text);
    controllers_.push_back(std::make_unique<VelocityController>(plan_, options));
    controllers_.back()->set_stack(phase.stack);
    places_.push_back(places_of(phase.stack));
  }
}

Simulation::StackPlaces Simulation::places_of(const Stack& stack) const {
  const auto find = [](const std::vector<std::string>& names, const std::string& name) {
    return static_cast<Index>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  StackPlaces places;
  for (const StackLevel& level : stack.levels()) {
    places.level.push_back(find(names_.levels, level.name));
    places.first_row.push_back(find(names_.task_rows, level.tasks.front()->name() + "/0"));
  }
  return places;
}

}  // namespace hurcules

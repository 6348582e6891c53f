// An arm whose tip is led, `tip < posture`, in the physics; and what every simulation must keep.
#pragma once

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "hurcules/sim/simulation.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "hurcules/tasks/posture_task.hpp"

namespace hurcules_test {

// the channel "tip" takes velocities of up to `scale` [m/s]; from the keyframe, "" for the first posture
inline hurcules::Simulation tip_simulation(const hurcules::ModelPtr& model,
                                           const std::string& keyframe,
                                           hurcules::ControlOrder order, double scale,
                                           hurcules::WholeBodyControllerOptions options = {}) {
  using namespace hurcules;
  Robot robot(model);
  robot.set_keyframe(keyframe);
  auto tip = std::make_unique<PositionTask>("tip", robot, "tip");
  auto posture = std::make_unique<PostureTask>("posture", robot);
  std::vector<Channel> channels = {{"tip", ChannelKind::Twist, *tip, Vector::Constant(1, scale)}};
  options.dt = model->opt.timestep;
  auto controller = std::make_shared<WholeBodyController>(
      robot, std::vector<NamedStack>{{"lead", *tip < *posture, order}}, std::move(channels),
      std::move(options));
  controller->keep(std::move(tip));
  controller->keep(std::move(posture));
  SimulationOptions quiet;
  quiet.record = false;
  return {model, std::move(controller), quiet};
}

// goes on from a snapshot, and in a copy, by the same bits; returns snapshot and what it leads to
struct GoneOn {
  std::vector<double> state, later;
};
inline GoneOn expect_same_bits(hurcules::Simulation& simulation, const hurcules::Vector& command) {
  simulation.step(100, &command);
  GoneOn gone{simulation.state(), {}};
  const auto copy = simulation.clone();
  simulation.step(200, &command);
  gone.later = simulation.state();
  copy->step(200, &command);
  simulation.restore(gone.state);
  simulation.step(200, &command);
  EXPECT_EQ(simulation.state(), gone.later);
  EXPECT_EQ(copy->state(), gone.later);
  return gone;
}

}  // namespace hurcules_test

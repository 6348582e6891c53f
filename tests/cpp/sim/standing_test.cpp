// Strategy: a quadruped that stands by torques in the physics, which know nothing of the controller's
// model of contacts. It stands, reaches, is pushed and stands again; bits, memory, hand-over of an arm
// between references and torques.
#include <mujoco/mujoco.h>

#include <cstring>

#include "hurcules/sim/simulation_batch.hpp"
#include "hurcules/tasks/center_of_mass_task.hpp"
#include "hurcules/tasks/contact_task.hpp"
#include "hurcules/tasks/orientation_task.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "hurcules/tasks/posture_task.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/quadruped.hpp"
#include "support/tiny_models.hpp"
#include "support/tip_simulation.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

std::shared_ptr<WholeBodyController> standing(const ModelPtr& model) {
  Robot robot(model, {}, true);
  robot.set_keyframe("stand");
  std::vector<std::unique_ptr<Task>> kept;
  std::vector<Task*> feet;
  for (const char* const name : {"FL", "FR", "HL", "HR"}) {
    kept.push_back(std::make_unique<ContactTask>(name, robot, std::string(name) + "_shank"));
    feet.push_back(kept.back().get());
  }
  auto com = std::make_unique<CenterOfMassTask>("com", robot);
  auto trunk = std::make_unique<OrientationTask>("trunk", robot, "trunk");
  auto hand = std::make_unique<PositionTask>("hand", robot, "hand");
  auto posture = std::make_unique<PostureTask>("posture", robot);
  WholeBodyControllerOptions options;
  options.dt = 0.002;
  const Stack stack =
      StackLevel("contacts", feet) < StackLevel(*com) + StackLevel(*trunk) < *hand < *posture;
  std::vector<Channel> channels = {{"hand", ChannelKind::Twist, *hand, Vector::Constant(1, 0.3)}};
  auto controller = std::make_shared<WholeBodyController>(
      robot, std::vector<NamedStack>{{"stand", stack, ControlOrder::Torque}}, std::move(channels),
      options);
  for (auto* task : {&com}) controller->keep(std::move(*task));
  controller->keep(std::move(trunk));
  controller->keep(std::move(hand));
  controller->keep(std::move(posture));
  for (auto& task : kept) controller->keep(std::move(task));
  return controller;
}

Simulation simulate() {
  const ModelPtr model = quadruped();
  SimulationOptions options;
  options.record = false;
  return {model, standing(model), options};
}

double fastest(const Simulation& simulation) {
  return simulation.plant().qvel().cwiseAbs().maxCoeff();
}

TEST(Standing, ReachesWhileItStands) {
  Simulation simulation = simulate();
  const Robot& world = simulation.world();
  const Frame hand = world.frame("hand"), foot = world.frame("FL_shank");
  simulation.step(250);
  const Vector3 start = world.position(hand), com = world.com(), stood = world.position(foot);
  const Vector command = Vector3(-0.05, 0.05, -0.03);
  simulation.step(500, &command);
  simulation.step(1000);
  EXPECT_LT((world.position(hand) - start - command).norm(), 1e-4);
  EXPECT_LT((world.com() - com).norm(), 1e-4);
  EXPECT_LT((world.position(foot) - stood).norm(), 1e-3);
  EXPECT_LT(fastest(simulation), 1e-3);
}

TEST(Standing, StandsAgainAfterAPush) {
  Simulation simulation = simulate();
  simulation.step(500);
  const Vector3 com = simulation.world().com();
  // 60 N for 0.1 s: 0.37 m/s if the feet did nothing
  mjData* const data = simulation.plant().data();
  const int trunk = simulation.world().root_body();
  data->xfrc_applied[6 * trunk + 1] = 60.0;
  simulation.step(50);
  data->xfrc_applied[6 * trunk + 1] = 0.0;
  EXPECT_GT(fastest(simulation), 0.1);
  simulation.step(2000);
  EXPECT_LT((simulation.world().com() - com).norm(), 2e-3);
  EXPECT_LT(fastest(simulation), 2e-3);
  EXPECT_FALSE(simulation.finished());
}

TEST(Standing, GoesOnFromASnapshotAndInACopyByTheSameBits) {
  Simulation simulation = simulate();
  const Vector command = Vector3(-0.05, 0.02, 0.0);
  expect_same_bits(simulation, command);
}

TEST(Standing, AllocatesNothing) {
  Simulation simulation = simulate();
  const Vector command = Vector3(-0.05, 0.02, 0.0);
  simulation.step(50, &command);
  const NoAllocation guard;
  simulation.step(200, &command);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(Standing, WantsPhysicsAndNoReferences) {
  const ModelPtr model = quadruped();
  SimulationOptions ideal;
  ideal.physics = false;
  EXPECT_TRUE(
      contains(error_text([&] { Simulation(model, standing(model), ideal); }), "without physics"));
  Robot robot(model, {}, true);
  PostureTask posture("posture", robot);
  EXPECT_TRUE(contains(error_text([&] {
                         WholeBodyController(robot, {{"a", Stack({posture})}});
                       }),
                       "'torque'"));
}

// the same arm by references, by torques and back: neither the place nor the torque jumps
TEST(Torques, AnArmGoesFromReferencesToTorquesAndBack) {
  std::string text = kArm;
  const ModelPtr model = load_model_text(text);
  Robot robot(model);
  robot.set_keyframe("home");
  auto tip = std::make_unique<PositionTask>("tip", robot, "tip");
  auto posture = std::make_unique<PostureTask>("posture", robot);
  const Stack stack = *tip < *posture;
  std::vector<Channel> channels = {{"tip", ChannelKind::Twist, *tip, Vector::Constant(1, 0.3)}};
  WholeBodyControllerOptions options;
  options.dt = model->opt.timestep;
  auto controller = std::make_shared<WholeBodyController>(
      robot, std::vector<NamedStack>{{"lead", stack}, {"torques", stack, ControlOrder::Torque}},
      std::move(channels), options);
  controller->keep(std::move(tip));
  controller->keep(std::move(posture));
  SimulationOptions quiet;
  quiet.record = false;
  Simulation simulation(model, controller, quiet);
  const Frame frame = simulation.world().frame("tip");
  simulation.step(200);
  const Vector3 start = simulation.world().position(frame);
  for (const char* const name : {"torques", "lead", "torques", "lead"}) {
    const Vector before = controller->servo().torque();
    controller->use(name);
    simulation.step(1);
    EXPECT_LT((controller->servo().torque() - before).cwiseAbs().maxCoeff(), 0.05) << name;
    simulation.step(400);
    EXPECT_LT((simulation.world().position(frame) - start).norm(), 1e-4) << name;
  }
  for (const char* const name : {"lead", "torques"}) {
    controller->use(name);
    const Vector3 from = simulation.world().position(frame);
    const Vector command = Vector3(-0.05, -0.05, 0.05);
    simulation.step(500, &command);
    simulation.step(1500);
    const Vector3 wanted = from + command * 500 * options.dt;
    EXPECT_LT((simulation.world().position(frame) - wanted).norm(), 1e-3) << name;
  }
}

// an arm whose joints stick: how far from its target the tip stays when torques give this share of
// the joints' dry friction
double short_of_target(double share) {
  std::string text = kArm;
  for (std::string::size_type at = 0; (at = text.find("<joint", at)) != std::string::npos; ++at)
    text.insert(at + 6, " frictionloss=\"1\"");
  const ModelPtr model = load_model_text(text);
  WholeBodyControllerOptions options;
  options.torque.friction = share;
  Simulation simulation = tip_simulation(model, "home", ControlOrder::Torque, 0.3, options);
  const Frame frame = simulation.world().frame("tip");
  const Vector3 start = simulation.world().position(frame);
  const Vector command = Vector3(-0.05, -0.05, 0.05);
  simulation.step(500, &command);
  simulation.step(1500);
  if (share == 1.0) {
    EXPECT_LT(fastest(simulation), 1e-3);
  }
  return (simulation.world().position(frame) - start - command * 500 * simulation.dt()).norm();
}

TEST(Torques, BearDryFriction) {
  EXPECT_GT(short_of_target(0.0), 0.01);
  EXPECT_LT(short_of_target(1.0), 1e-3);
}

}  // namespace

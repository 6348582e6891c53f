// Strategy: a robot of two boxes that lie on the ground, joined by a motor, with an arm on the first,
// in the physics: joints moved one by one by a channel or a phase, and a plan that stands on another
// body.
#include <mujoco/mujoco.h>

#include <cmath>
#include <memory>

#include "hurcules/mission/mission_simulation.hpp"
#include "hurcules/tasks/posture_task.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kDt = 0.002;
constexpr double kMostChange = 20.0 * kDt;  // [rad/s] in a tick

const char* const kBoxes = R"(<mujoco><compiler angle="radian"/>
  <option timestep="0.002" integrator="implicitfast"/>
  <default><joint axis="0 1 0" armature="0.05" damping="0.5" range="-2 2"/></default>
  <worldbody><geom name="floor" type="plane" size="5 5 0.1"/>
    <body name="back" pos="0 0 0.05"><freejoint/>
      <geom type="box" size="0.2 0.2 0.05" pos="-0.2 0 0" mass="20"/>
      <body name="front"><joint name="middle"/>
        <geom type="box" size="0.2 0.2 0.05" pos="0.2 0 0" mass="10" contype="2"/></body>
      <body name="arm" pos="-0.2 0 0.1"><joint name="shoulder" range="-1 1"/>
        <geom type="capsule" size="0.03" fromto="0 0 0 0 0 0.4" mass="2"/></body>
    </body></worldbody>
  <actuator><motor joint="middle" forcerange="-300 300"/>
    <motor joint="shoulder" forcerange="-100 100"/></actuator></mujoco>)";

std::shared_ptr<WholeBodyController> make_controller(const ModelPtr& model) {
  Robot robot(model);
  robot.stand_on("front");
  auto posture = std::make_unique<PostureTask>("posture", robot);
  WholeBodyControllerOptions options;
  options.dt = kDt;
  options.decoupled = false;
  auto controller = std::make_shared<WholeBodyController>(
      robot, std::vector<NamedStack>{{"rest", Stack({*posture})}},
      std::vector<Channel>{Channel::joints("joints", {"shoulder", "middle"}, 1.0)}, options);
  controller->keep(std::move(posture));
  return controller;
}

std::unique_ptr<Simulation> make() {
  const ModelPtr model = load_model_text(kBoxes);
  SimulationOptions options;
  options.record = false;
  return std::make_unique<Simulation>(model, make_controller(model), options);
}

TEST(JointChannel, MovesJointsOneByOneWhileNoStackRules) {
  const auto simulation = make();
  WholeBodyController& controller = simulation->controller();
  const Vector command = Eigen::Vector2d(0.5, 0.0);
  simulation->step(50, &command);
  EXPECT_EQ(controller.servo().position()[1], 0.0);  // a stack rules
  controller.move_joints();
  simulation->step(1, &command);
  EXPECT_NEAR(controller.servo().velocity()[1], kMostChange, 1e-12);
  simulation->step(500, &command);
  EXPECT_NEAR(controller.servo().velocity()[1], 0.5, 1e-12);
  EXPECT_NEAR(controller.servo().position()[1], 0.5, 0.01);
  EXPECT_NEAR(simulation->world().configuration()[1], 0.5, 0.01);
  EXPECT_EQ(controller.servo().position()[0], 0.0);
  const Vector none = Vector::Zero(2);
  simulation->step(1, &none);
  EXPECT_NEAR(controller.servo().velocity()[1], 0.5 - kMostChange, 1e-12);
  simulation->step(2000, &command);
  EXPECT_NEAR(controller.servo().position()[1], 1.0, 1e-9);  // its range
  controller.use("rest");
  simulation->step(200);
  EXPECT_NEAR(controller.q_des()[1], 1.0, 1e-3);
}

TEST(JointChannel, NoTorqueJumpsWhenThePlanStandsOnAnotherBody) {
  const auto simulation = make();
  WholeBodyController& controller = simulation->controller();
  controller.move_joints();
  simulation->step(1000);
  const double before = controller.servo().torque()[0];
  controller.stand_on("back");
  EXPECT_EQ(controller.plan().support_name(), "back");
  simulation->step(1);
  // standing on the front box the motor would hold 22 kg, on the other 10 kg: 60 N m apart
  EXPECT_NEAR(controller.servo().torque()[0], before, 0.6);
  EXPECT_LT((controller.servo().pid().torque() - controller.servo().demand()).norm(), 1e-9);
  simulation->step(1000);
  EXPECT_LT(std::abs(simulation->world().configuration()[0]), 1e-3);

  const std::vector<double> state = simulation->state();
  const auto copy = make();
  copy->restore(state);
  EXPECT_EQ(copy->controller().plan().support_name(), "back");
  simulation->step(200);
  copy->step(200);
  EXPECT_EQ(copy->state(), simulation->state());
  simulation->reset(0);
  EXPECT_EQ(controller.plan().support_name(), "front");
}

TEST(JointChannel, WantsJointsWithAnActuator) {
  EXPECT_TRUE(
      contains(error_text([] { (void)Channel::joints("joints", {}, 1.0); }), "at least one"));
  const ModelPtr model = load_model_text(kBoxes);
  Robot robot(model);
  PostureTask posture("posture", robot);
  EXPECT_TRUE(contains(error_text([&] {
                         WholeBodyController(robot, {{"rest", Stack({posture})}},
                                             {Channel::joints("joints", {"knee"}, 1.0)});
                       }),
                       "there are: middle, shoulder"));
}

// joints one by one on the other body, then a row that only reactions reach
MissionTable lift_table() {
  MissionTable table;
  table.phases = {{.name = "stand", .stack = "rest", .seconds = 0.1},
                  {.name = "turn",
                   .stack = "joints",
                   .seconds = 3.0,
                   .support = "back",
                   .posture = "joints",
                   .keys = {{0.3, {{"shoulder", 0.5}}}, {1.0, {{"shoulder", 0.8}}}}},
                  {.name = "rest", .stack = "joints", .seconds = 0.2, .last = true},
                  {.name = "safety", .stack = "rest", .seconds = 9.0}};
  table.safety = "safety";
  return table;
}

TEST(JointPhase, LeadsJointsThroughKeysWithoutACornerAndEndsWhereItSays) {
  const ModelPtr model = load_model_text(kBoxes);
  const auto controller = make_controller(model);
  MissionOptions all;
  all.record = false;
  all.variation = 0.0;
  MissionSimulation simulation(
      model, controller,
      std::make_unique<Mission>(MissionSetup{.name = "turn"}, lift_table(), *controller, 0.0), all);
  double jump = 0.0, before = 0.0, highest = 0.0;
  while (!simulation.finished()) {
    simulation.step(1);
    const JointServo& servo = controller->servo();
    jump = std::max(jump, std::abs(servo.velocity()[1] - before));
    before = servo.velocity()[1];
    highest = std::max(highest, servo.position()[1]);
  }
  EXPECT_EQ(simulation.reason(), "completed");
  EXPECT_NEAR(simulation.time(), 3.3, 1.5 * kDt);
  EXPECT_EQ(controller->plan().support_name(), "back");
  EXPECT_NEAR(controller->servo().position()[1], 0.8, 1e-9);
  EXPECT_NEAR(highest, 0.8, 1e-9);
  EXPECT_LT(jump, 0.5 * kMostChange);
}

TEST(JointPhase, IsCheckedWhenItIsLoaded) {
  const ModelPtr model = load_model_text(kBoxes);
  const auto controller = make_controller(model);
  const auto expect = [&](auto&& change, const char* wanted) {
    MissionTable table = lift_table();
    change(table.phases[1]);
    const std::string text = error_text([&] { check_table(table, *controller); });
    EXPECT_TRUE(contains(text, wanted)) << text;
    EXPECT_TRUE(contains(text, "phase 'turn'")) << text;
  };
  expect([](Phase& row) { row.keys[1].angles[0].second = 1.5; },
         "joint 'shoulder' goes from -1 to 1, 1.5 came");
  expect([](Phase& row) { row.keys[1].angles[0].first = "knee"; }, "there are: shoulder, middle");
  expect([](Phase& row) { row.support = "table"; }, "'table'");
  expect([](Phase& row) { row.stack = "rest"; }, "wants a PostureTask");
  expect([](Phase& row) { row.stack = "jionts"; }, "there are: rest, joints");
}

}  // namespace

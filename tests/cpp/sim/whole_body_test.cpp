// Strategy: a fixed three-joint arm with motors, made of text, in the physics: the loop without a
// mission. What it does in the end, sameness of bits, hand-over, what is refused.
#include <mujoco/mujoco.h>

#include <cmath>
#include <memory>

#include "hurcules/sim/simulation_batch.hpp"
#include "hurcules/tasks/custom_task.hpp"
#include "hurcules/tasks/distance_task.hpp"
#include "hurcules/tasks/orientation_task.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "hurcules/tasks/posture_task.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// an arm of 2 kg links under gravity, a finger that no coordinate moves
std::string arm(const std::string& actuators) {
  return R"(<mujoco><compiler angle="radian"/><option timestep="0.002" integrator="implicitfast"/>
  <default><joint axis="0 1 0" armature="0.05" damping="0.5" range="-2.5 2.5"/>
    <geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0" mass="2"/></default>
  <worldbody><body pos="0 0 1"><joint name="j1"/><geom/>
    <body pos="0.4 0 0"><joint name="j2"/><geom/>
      <body pos="0.4 0 0"><joint name="j3"/><geom/><site name="tip" pos="0.4 0 0"/>
        <body pos="0.4 0 0"><joint name="finger" type="slide" axis="1 0 0" range="0 0.05"/>
          <geom fromto="0 0 0 0.02 0 0" size="0.01" mass="0.1"/></body>
      </body></body></body></worldbody>
  <actuator>)" +
         actuators +
         R"(</actuator><keyframe><key name="bent" qpos="0.3 0.8 -0.6 0"/></keyframe></mujoco>)";
}

const char* const kMotors =
    R"(<motor joint="j1" forcerange="-200 200"/><motor joint="j2" forcerange="-200 200"/>
       <motor joint="j3" forcerange="-100 100"/><motor joint="finger" forcerange="-20 20"/>)";
const char* const kServos =
    R"(<position joint="j1" kp="2000" kv="100"/><position joint="j2" kp="2000" kv="100"/>
       <position joint="j3" kp="1000" kv="50"/><position joint="finger" kp="100"/>)";

std::shared_ptr<WholeBodyController> make(const ModelPtr& model, double dt = 0.002,
                                          bool two_lead = false) {
  Robot robot(model, {"j1", "j2", "j3"});
  robot.set_keyframe("bent");
  auto tip = std::make_unique<PositionTask>(
      "tip", robot, "tip",
      PositionTaskOptions{.axes = (Matrix(2, 3) << 1, 0, 0, 0, 0, 1).finished()});
  auto posture = std::make_unique<PostureTask>("posture", robot);
  WholeBodyControllerOptions options;
  options.dt = dt;
  const Stack reach({*tip, *posture}), rest({*posture});
  std::vector<Channel> channels = {
      {"tip", ChannelKind::Twist, *tip, Vector::Constant(1, 0.5), {"x", "z"}},
      Channel::joint("finger", "finger", 0.1)};
  if (two_lead) {
    channels.push_back({"other", ChannelKind::Twist, *tip, Vector::Constant(1, 0.5), {"x", "z"}});
  }
  auto controller = std::make_shared<WholeBodyController>(
      robot,
      std::vector<NamedStack>{
          {"reach", reach}, {"rest", rest}, {"accelerate", reach, ControlOrder::Acceleration}},
      std::move(channels), options);
  controller->keep(std::move(tip));
  controller->keep(std::move(posture));
  return controller;
}

Simulation simulate(const char* actuators = kMotors, bool physics = true) {
  const ModelPtr model = load_model_text(arm(actuators));
  SimulationOptions options;
  options.record = false;
  options.physics = physics;
  return {model, make(model), options};
}

TEST(WholeBody, StandsStillUnderGravityFromTheFirstTick) {
  for (const char* const actuators : {kMotors, kServos}) {
    Simulation simulation = simulate(actuators);
    const Vector start = simulation.world().configuration();
    for (int i = 0; i < 100; ++i) {
      simulation.step(5);
      // the smallest bandwidth bends by less than a tenth of a milliradian
      EXPECT_LT((simulation.world().configuration() - start).cwiseAbs().maxCoeff(), 1e-4);
    }
  }
}

TEST(WholeBody, LeadsTheTipByACommandAndHoldsItAfterwards) {
  for (const char* const actuators : {kMotors, kServos}) {
    Simulation simulation = simulate(actuators);
    const Frame tip = simulation.world().frame("tip");
    const Vector3 start = simulation.world().position(tip);
    const Vector command = Eigen::Vector3d(-0.1, 0.05, 0.01);
    simulation.step(500, &command);
    simulation.step(1000);
    const Vector3 moved = simulation.world().position(tip) - start;
    EXPECT_NEAR(moved.x(), -0.1, 1e-3);
    EXPECT_NEAR(moved.z(), 0.05, 1e-3);
    EXPECT_NEAR(simulation.plant().qpos()[3], 0.01, 1e-3);  // the finger
    EXPECT_FALSE(simulation.finished());
  }
}

// Whatever the period, the tip does not run ahead of the target by ticks, each of 0.12 or 0.35 mm.
TEST(WholeBody, TheTipIsWhereTheTargetIsAtTheEndOfATick) {
  const ModelPtr model = load_model_text(arm(kMotors));
  for (const double dt : {0.002, 0.006}) {
    SimulationOptions options;
    options.record = false;
    Simulation simulation(model, make(model, dt), options);
    const Frame site = simulation.world().frame("tip");
    const auto& tip = dynamic_cast<const PositionTask&>(*simulation.controller().tasks().front());
    const Vector command = Eigen::Vector3d(-0.05, 0.03, 0.0);
    simulation.step(static_cast<int>(2.0 / dt), &command);
    for (int i = 0; i < 20; ++i) {
      simulation.step(1, &command);
      const Vector3 place = simulation.world().position(site);
      EXPECT_LT((Eigen::Vector2d(place.x(), place.z()) - tip.target()).norm(), 2e-5);
    }
  }
}

TEST(WholeBody, TwoTwistsOfATaskAddUpWithoutALag) {
  const ModelPtr model = load_model_text(arm(kMotors));
  SimulationOptions options;
  options.record = false;
  Simulation one(model, make(model, 0.002), options);
  Simulation two(model, make(model, 0.002, true), options);
  const Vector whole = Eigen::Vector3d(-0.05, 0.03, 0.0);
  Vector shared(5);
  shared << -0.08, 0.0, 0.0, 0.03, 0.03;
  one.step(500, &whole);
  two.step(500, &shared);
  const Frame tip = one.world().frame("tip");
  EXPECT_LT((one.world().position(tip) - two.world().position(tip)).norm(), 1e-9);
}

TEST(WholeBody, HoldsAJointWithoutACoordinateWithinItsRange) {
  Simulation simulation = simulate();
  const Vector command = Eigen::Vector3d(0.0, 0.0, 0.1);
  simulation.step(1000, &command);  // 0.2 m are asked for, 0.05 are there
  EXPECT_NEAR(simulation.plant().qpos()[3], 0.05, 2e-3);
}

TEST(WholeBody, KeepsJointLimitsThatNobodyAskedFor) {
  Simulation simulation = simulate();
  const Vector command = Eigen::Vector3d(0.5, -0.5, 0.0);
  for (int i = 0; i < 200; ++i) {
    simulation.step(20, &command);
    EXPECT_EQ(simulation.limits().commanded().position, 0.0);
    EXPECT_LT(simulation.limits().measured().position, 5e-3);
  }
}

// what a hand-over does to a loaded arm: largest error of a joint [rad], largest jump of qdot*
struct HandOver {
  double drop = 0.0, jump = 0.0;
};

HandOver watch(Simulation& simulation, int ticks, const Vector* command) {
  HandOver worst;
  Vector last = simulation.controller().qd_des();
  for (int i = 0; i < ticks; ++i) {
    simulation.step(1, command);
    const Vector& now = simulation.controller().qd_des();
    worst.jump = std::max(worst.jump, (now - last).cwiseAbs().maxCoeff());
    worst.drop = std::max(worst.drop, simulation.telemetry().joint_error.cwiseAbs().maxCoeff());
    last = now;
  }
  return worst;
}

constexpr double kMostChange =
    20.0 * 0.002 * (1.0 + 1e-9);  // [rad/s] the acceleration limit, a tick
const char* const kStacks[] = {"rest", "accelerate", "reach", "accelerate", "rest", "reach"};

TEST(WholeBody, GoesFromStackToStackAndLawToLawInMotionWithoutAJump) {
  Simulation simulation = simulate();
  const Vector command = Eigen::Vector3d(-0.2, 0.1, 0.0);
  simulation.step(250, &command);
  for (const char* const stack : kStacks) {
    simulation.controller().use(stack);
    EXPECT_LE(watch(simulation, 200, &command).jump, kMostChange) << stack;
  }
}

TEST(WholeBody, HandsALoadedArmOverWithoutADrop) {
  Simulation simulation = simulate();
  // a load that the model of the controller does not know
  simulation.plant().data()->xfrc_applied[6 * 3 + 2] = -40.0;
  simulation.step(2000);
  simulation.controller().hold_targets();
  for (const char* const stack : kStacks) {
    simulation.controller().use(stack);
    const HandOver worst = watch(simulation, 300, nullptr);
    EXPECT_LT(worst.drop, 1e-3) << stack;
    EXPECT_LE(worst.jump, kMostChange) << stack;
  }
}

TEST(WholeBody, TakesOverFromJointsThatWereMovedByThemselves) {
  Simulation simulation = simulate();
  simulation.step(200);
  const double start = simulation.controller().servo().position()[1];
  for (int i = 0; i < 250; ++i) {
    const double u = 0.002 * (i + 1) / 0.5;  // 0.2 rad in 0.5 s, smoothly
    simulation.controller().move("j2", start + 0.2 * u * u * (3.0 - 2.0 * u),
                                 0.2 * 6.0 * u * (1.0 - u) / 0.5);
    simulation.step(1);
  }
  simulation.controller().use("reach");
  const HandOver worst = watch(simulation, 500, nullptr);
  EXPECT_LT(worst.drop, 1e-3);
  EXPECT_LE(worst.jump, kMostChange);
  EXPECT_NEAR(simulation.world().configuration()[1], start + 0.2, 1e-3);
}

TEST(WholeBody, GoesOnFromASnapshotBitForBitInAnotherCopyToo) {
  Simulation simulation = simulate();
  const Vector command = Eigen::Vector3d(-0.2, 0.1, 0.02);
  simulation.step(100, &command);
  simulation.controller().use("accelerate");
  simulation.step(50, &command);
  const std::vector<double> state = simulation.state();
  const std::unique_ptr<Simulation> copy = simulation.clone();
  EXPECT_TRUE(same_bits(copy->state(), state));
  simulation.step(200, &command);
  const std::vector<double> later = simulation.state();
  copy->step(200, &command);
  EXPECT_TRUE(same_bits(copy->state(), later));
  simulation.restore(state);
  simulation.step(200, &command);
  EXPECT_TRUE(same_bits(simulation.state(), later));
}

TEST(WholeBody, ASnapshotHasOneLengthAndNoNotANumber) {
  Simulation simulation = simulate();
  const std::size_t length = simulation.state().size();
  for (int i = 0; i < 40; ++i) {
    const Vector command = Eigen::Vector3d(std::sin(i), std::cos(2.0 * i), 0.02);
    simulation.step(20, &command);
    if (i == 20) simulation.controller().use("accelerate");
    const std::vector<double> state = simulation.state();
    EXPECT_EQ(state.size(), length);
    for (const double value : state) EXPECT_FALSE(std::isnan(value));
  }
  std::vector<double> state = simulation.state();
  state[0] += 1.0;
  EXPECT_TRUE(contains(error_text([&] { simulation.restore(state); }), "another version"));
  state = simulation.state();
  state.push_back(0.0);
  EXPECT_TRUE(contains(error_text([&] { simulation.restore(state); }), "another model"));
}

TEST(WholeBody, WithoutPhysicsIsWhereItIsCommandedToBe) {
  Simulation real = simulate(), ideal = simulate(kMotors, false);
  const Frame tip = ideal.world().frame("tip");
  const Vector3 start = ideal.world().position(tip);
  const Vector command = Eigen::Vector3d(-0.1, 0.05, 0.01);
  for (Simulation* one : {&real, &ideal}) {
    one->step(500, &command);
    one->step(1000);
  }
  const Vector3 moved = ideal.world().position(tip) - start;
  EXPECT_NEAR(moved.x(), -0.1, 1e-6);
  EXPECT_NEAR(moved.z(), 0.05, 1e-6);
  EXPECT_NEAR(ideal.plant().qpos()[3], 0.01, 1e-9);  // the finger
  EXPECT_LT((ideal.world().configuration() - ideal.controller().q_des()).cwiseAbs().maxCoeff(),
            1e-15);
  EXPECT_LT((real.world().position(tip) - ideal.world().position(tip)).norm(), 1e-3);
  EXPECT_EQ(ideal.limits().measured().position, 0.0);
}

TEST(WholeBody, StartsWhereItIsTold) {
  Simulation simulation = simulate();
  const Vector start = Eigen::Vector4d(-0.2, 1.1, 0.4, 0.02);
  simulation.reset(0, &start);
  EXPECT_EQ(Vector(simulation.plant().qpos()), start);
  simulation.step(200);
  EXPECT_LT((simulation.plant().qpos() - start).cwiseAbs().maxCoeff(), 1e-3);
  simulation.reset(0);
  EXPECT_EQ(simulation.plant().qpos()[0], 0.3);
  const Vector bad = Vector::Zero(2);
  EXPECT_TRUE(contains(error_text([&] { simulation.reset(0, &bad); }), "wants 4 numbers, 2 came"));
}

TEST(Quantities, AreReadByNameFromACopyToo) {
  const Simulation original = simulate();
  const Quantities quantities(
      original, {"position/tip", "velocity/tip", "rotation/tip", "value/tip", "joint/j2",
                 "joint_velocity/finger", "q", "q/j3", "monitor/power_W", "excess/position",
                 "self_contacts", "finished", "time"});
  EXPECT_EQ(quantities.sizes(), (std::vector<Index>{3, 3, 3, 2, 1, 1, 3, 1, 1, 1, 1, 1, 1}));
  const std::unique_ptr<Simulation> copy = original.clone();
  const Vector command = Eigen::Vector3d(-0.1, 0.05, 0.01);
  copy->step(300, &command);
  Vector values(quantities.size());
  quantities.read(*copy, values);
  const Frame tip = copy->world().frame("tip");
  EXPECT_EQ(Vector3(values.head<3>()), copy->world().position(tip));
  EXPECT_NEAR(values[3], -0.1, 0.02);  // the tip's velocity
  EXPECT_EQ(values[9], values[0]);     // the task's value: x and z of the tip
  EXPECT_EQ(values[10], values[2]);
  EXPECT_EQ(values[11], copy->plant().qpos()[1]);
  EXPECT_EQ(values[12], copy->plant().qvel()[3]);
  EXPECT_EQ(values[15], values[16]);  // the third coordinate, alone
  EXPECT_EQ(values[18], copy->limits().measured().position);
  EXPECT_EQ(values[20], 0.0);
  EXPECT_EQ(values[21], copy->time());
  EXPECT_TRUE(contains(error_text([&] { Quantities(original, {"speed"}); }), "there are: "));
  EXPECT_TRUE(contains(error_text([&] { Quantities(original, {"position/nose"}); }), "nose"));
}

TEST(Quantities, OfAnotherRobotAreRefused) {
  const Simulation original = simulate();
  const Quantities quantities(original, {"position/tip", "q"});
  std::string text = arm(kMotors);
  text.replace(text.find("name=\"tip\""), 10, "name=\"end\"");
  const ModelPtr model = load_model_text(text);
  const Robot robot(model, {"j1", "j2", "j3"});
  PostureTask posture("posture", robot);
  WholeBodyControllerOptions options;
  options.dt = 0.002;
  const std::vector<NamedStack> stacks = {{"rest", Stack({posture})}};
  const Simulation other(
      model, std::make_shared<WholeBodyController>(robot, stacks, std::vector<Channel>{}, options));
  Vector values(quantities.size());
  EXPECT_TRUE(contains(error_text([&] { quantities.read(other, values); }), "another robot"));
}

TEST(SimulationBatch, HasTheBitsOfEachAloneOnOneThreadAndOnTwo) {
  const Simulation original = simulate();
  SimulationBatch one(original, 5, 1), two(original, 5, 2);
  const Quantities quantities(original, {"value/tip", "q", "excess/velocity"});
  Matrix read(5, quantities.size()), at_once(5, quantities.size());
  Matrix commands(5, 3);
  for (int i = 0; i < 5; ++i) commands.row(i) << -0.05 * i, 0.03 * i, 0.0;
  std::vector<std::unique_ptr<Simulation>> alone;
  for (int i = 0; i < 5; ++i) alone.push_back(original.clone());
  for (int k = 0; k < 10; ++k) {
    one.step(20, &commands);
    one.read(quantities, read);
    two.step_and_read(20, &commands, nullptr, quantities, at_once);
    EXPECT_EQ(read, at_once);
    for (std::size_t i = 0; i < 5; ++i) {
      const Vector command = commands.row(static_cast<Index>(i)).transpose();
      alone[i]->step(20, &command);
    }
  }
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(same_bits(one[i].state(), alone[i]->state())) << i;
    EXPECT_TRUE(same_bits(two[i].state(), alone[i]->state())) << i;
  }
  EXPECT_FALSE(same_bits(one[1].state(), one[2].state()));
  const std::vector<bool> mask = {true, false, false, false, false};  // all are read
  one.step_and_read(20, &commands, &mask, quantities, read);
  EXPECT_NE(read.row(0), at_once.row(0));
  EXPECT_EQ(read.bottomRows(4), at_once.bottomRows(4));
  Matrix small(5, 1);
  EXPECT_TRUE(contains(
      error_text([&] { one.step_and_read(1, nullptr, nullptr, quantities, small); }), "room"));
}

TEST(SimulationBatch, TakesModelsOfItsOwn) {
  const Simulation original = simulate();
  std::vector<ModelPtr> models;
  for (int i = 0; i < 3; ++i) {
    mjModel* const m = mj_copyModel(nullptr, original.plant().model());
    for (int b = 1; b < m->nbody; ++b) m->body_mass[b] *= 1.0 + 0.2 * i;
    models.emplace_back(m, [](const mjModel* p) { mj_deleteModel(const_cast<mjModel*>(p)); });
  }
  SimulationBatch batch(original, 3, 2, models);
  const Matrix commands = Matrix::Constant(3, 3, 0.05);
  batch.step(100, &commands);
  EXPECT_FALSE(same_bits(batch[0].state(), batch[2].state()));
  EXPECT_NE(error_text([&] { SimulationBatch(original, 2, 1, models); }), "");
  EXPECT_NE(error_text([&] { batch.step(1, nullptr, nullptr), batch.step(-1); }), "");
}

TEST(WholeBody, ATickAllocatesNothing) {
  Simulation simulation = simulate();
  const Vector command = Eigen::Vector3d(-0.2, 0.1, 0.02);
  simulation.step(300, &command);
  const NoAllocation guard;
  simulation.step(300, &command);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(WholeBody, TicksOfALoopOfOnesOwnHaveTheBitsOfASimulationAndAllocateNothing) {
  for (const char* const stack : {"reach", "accelerate"}) {
    Simulation simulation = simulate();
    const ModelPtr model = load_model_text(arm(kMotors));
    const auto controller = make(model);
    simulation.controller().use(stack);
    controller->use(stack);
    const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
    const Eigen::Map<Vector> qpos(data->qpos, model->nq), qvel(data->qvel, model->nv);
    Eigen::Map<Vector>(data->qpos, model->nq) = controller->plan().qpos();
    Vector ctrl = Vector::Zero(model->nu);
    const Vector command = Eigen::Vector3d(-0.2, 0.1, 0.02);
    std::size_t allocated = 0;
    for (int tick = 0; tick < 200; ++tick) {
      const NoAllocation guard;
      controller->tick(qpos, qvel, &command, tick == 0, ctrl);
      allocated += guard.count();
      std::copy(ctrl.begin(), ctrl.end(), data->ctrl);
      mj_step(model.get(), data.get());
    }
    simulation.step(200, &command);
    EXPECT_EQ(qpos, simulation.plant().qpos()) << stack;
    EXPECT_EQ(allocated, 0U) << stack;
  }
}

TEST(WholeBody, RefusesDataOfAnotherModelAndEventsOfNoSimulation) {
  const ModelPtr model = load_model_text(arm(kMotors));
  const ModelPtr other = load_model_text("<mujoco/>");
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(other.get()), mj_deleteData);
  EXPECT_TRUE(contains(
      error_text([&] { const Simulation refused(model, make(model), {}, nullptr, data.get()); }),
      "mjData of its model, that of another one came"));
  const Simulation simulation = simulate();
  for (const EventKind kind : {EventKind::PhaseStarted, EventKind::LimitMet, EventKind::AlarmFell})
    EXPECT_TRUE(contains(error_text([&] { (void)simulation.text({0.0, kind, 999}); }), "999"));
}

TEST(WholeBody, SeesABallComeAndAllocatesNothing) {
  std::string text = arm(kMotors);
  text.replace(
      text.find("</worldbody>"), 0,
      R"(<body name="held" mocap="true" pos="0.9 0.5 0.6"><geom fromto="0 0 0 0 0 0.1"/></body>
                  <body name="ball" pos="0.9 -0.9 0.6"><freejoint/>
                    <geom fromto="0 0 0 0 0 0.1"/></body>)");
  text.replace(text.find(R"(<option )"), 8, R"(<option gravity="0 0 0" )");
  const ModelPtr model = load_model_text(text);
  Robot robot(model, {"j1", "j2", "j3"});
  robot.set_configuration(Vector3(0.3, 0.8, -0.6));
  DistanceTask clear = obstacles(robot, {"held", "ball"}, {.most = 0.3});
  PositionTask tip("tip", robot, "tip", {});
  const auto controller = std::make_shared<WholeBodyController>(
      robot, std::vector<NamedStack>{{"reach", Stack({clear, tip})}}, std::vector<Channel>{},
      WholeBodyControllerOptions{.dt = 0.002});
  SimulationOptions options;
  options.record = false;
  Simulation simulation(model, controller, options);
  mjData* const data = simulation.plant().data();
  const int ball = robot.frame("ball").id, held = robot.frame("held").id;
  const int dof = model->body_dofadr[ball];
  data->qvel[dof + 1] = 0.2;
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      data->mocap_pos[1] -= 0.2 * 0.002;
      simulation.step(1);
    }
  };
  run(100);
  const NoAllocation guard;
  run(100);
  EXPECT_EQ(guard.count(), 0U);
  const BodyMotion free = clear.obstacle(ball).value(), moved = clear.obstacle(held).value();
  EXPECT_NEAR(free.linear.y(), 0.2, 1e-3);
  EXPECT_NEAR(free.pose.p.y(), -0.9 + 0.2 * 0.4, 1e-3);
  EXPECT_NEAR(moved.linear.y(), -0.2, 1e-3);
  EXPECT_NEAR(moved.pose.p.y(), 0.5 - 0.2 * 0.4, 1e-9);
}

// a camera that loses what it looks at
TEST(WholeBody, EndsWithAReasonWhereATaskMeasuresNoNumber) {
  const ModelPtr model = load_model_text(arm(kMotors));
  Robot robot(model, {"j1", "j2", "j3"});
  for (const ControlOrder order :
       {ControlOrder::Velocity, ControlOrder::Acceleration, ControlOrder::Torque}) {
    double lost = 0.0;
    CustomTask seen("seen", robot, 1,
                    [&lost](const Robot& at, VectorRef value, MatrixRef J, VectorRef /*drift*/) {
                      value[0] = at.configuration()[0] + lost;
                      J(0, 0) = 1.0;
                    });
    PostureTask posture("posture", robot);
    WholeBodyControllerOptions options;
    options.dt = 0.002;
    const auto controller = std::make_shared<WholeBodyController>(
        robot, std::vector<NamedStack>{{"look", Stack({seen, posture}), order}},
        std::vector<Channel>{}, options);
    Simulation simulation(model, controller);
    simulation.step(20);
    lost = std::nan("");
    simulation.step(20);
    EXPECT_EQ(simulation.ending(), Ending::SolverFailed);
    std::string invalid;
    for (const LevelDiagnostics& level : controller->law().diagnostics(controller->plan()))
      for (const Shortfall& shortfall : level.shortfalls)
        if (shortfall.invalid) invalid += shortfall.task;
    EXPECT_EQ(invalid, "seen");
    EXPECT_TRUE(simulation.clone()->finished());
  }
}

class NoCloneOfItsOwn : public PostureTask {
 public:
  using PostureTask::PostureTask;
};

TEST(WholeBody, RefusesWhatCannotBe) {
  const ModelPtr model = load_model_text(arm(kMotors));
  EXPECT_TRUE(contains(error_text([&] { Simulation(model, make(model, 0.003)); }), "whole number"));
  const auto controller = make(model);
  EXPECT_TRUE(contains(error_text([&] { controller->use("walk"); }), "there are: reach, rest"));
  EXPECT_TRUE(contains(error_text([&] { controller->move("j9", 0.0, 0.0); }), "j9"));
  EXPECT_TRUE(
      contains(error_text([&] { (void)Robot(model, {"j1", "jx"}); }), "'jx' does not exist"));
  EXPECT_EQ(error_text([&] { controller->move("j1", std::nan(""), 0.0); }),
            "move wants a finite position and velocity of joint 'j1', nan and 0 came");
  EXPECT_TRUE(contains(error_text([&] { Simulation(nullptr, controller); }), "wants a model"));
  EXPECT_TRUE(contains(error_text([&] { Simulation(model, controller, {.max_seconds = NAN}); }),
                       "max_seconds wants a time above 0 [s], nan came"));
  const ModelPtr other = load_model_text("<mujoco/>");
  EXPECT_TRUE(contains(error_text([&] { Simulation(other, controller); }), "another model"));
  const std::string first = R"(<motor joint="j1" forcerange="-200 200"/>)";
  std::string turned = arm(kMotors);
  turned.replace(turned.find(first), first.size(), "");
  turned.insert(turned.find("</actuator>"), first);
  const ModelPtr swapped = load_model_text(turned);
  EXPECT_TRUE(contains(error_text([&] { Simulation(swapped, controller); }), "in name or order"));
  const Simulation simulation(model, controller);
  EXPECT_TRUE(contains(error_text([&] { (void)simulation.measured_task(99); }), "no number 99"));
  EXPECT_TRUE(contains(error_text([&] { (void)controller->law(99); }), "no number 99"));
  Robot robot(model, {"j1", "j2", "j3"});
  PostureTask posture("posture", robot), stranger("stranger", robot);
  EXPECT_TRUE(contains(error_text([&] {
                         WholeBodyController(
                             robot, {{"a", Stack({posture})}},
                             {{"s", ChannelKind::Twist, stranger, Vector::Constant(1, 1.0)}});
                       }),
                       "which is in no stack"));
  NoCloneOfItsOwn derived("derived", robot);
  EXPECT_TRUE(contains(error_text([&] { WholeBodyController(robot, {{"a", Stack({derived})}}); }),
                       "'derived' is of another class"));
  for (const ChannelKind kind : {ChannelKind::Joint, ChannelKind::Joints, ChannelKind::Drive}) {
    EXPECT_TRUE(contains(error_text([&] { Channel("p", kind, posture, Vector::Constant(1, 1.0)); }),
                         "of a kind that leads no task, 'posture' came"));
  }
}

}  // namespace

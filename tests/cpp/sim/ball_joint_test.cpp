// Strategy: an arm with a ball joint in shoulder and wrist in the physics, by velocities, accelerations and
// torques, with motors and with position servos: it arrives and rests, in 6-D, keeps the ranges of its
// ball joints, bits and memory. The rows of these ranges against differences.
#include <string>
#include <utility>

#include "hurcules/base/pose.hpp"
#include "hurcules/sim/simulation.hpp"
#include "hurcules/tasks/joint_ranges.hpp"
#include "hurcules/tasks/pose_task.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"
#include "support/tip_simulation.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

struct Case {
  std::string name;
  ControlOrder order;
  bool servos = false;  // positions in place of motors
  bool physics = true;
};

ModelPtr model_of(const Case& one) {
  std::string text = kBallArm;
  const std::string motor = "<motor joint";
  const std::string servo = "<position kp=\"40\" kv=\"3\" forcerange=\"-60 60\" joint";
  for (std::size_t at = 0; one.servos && (at = text.find(motor, at)) != std::string::npos;)
    text.replace(at, motor.size(), servo);
  return load_model_text(text);
}

// `tip < posture` from the posture "bent"; the channel "tip" takes velocities of up to 0.5 [m/s], [rad/s]
Simulation simulate(const Case& one, const std::vector<std::string>& joints = {},
                    std::vector<ServoGains> servo = {}) {
  const ModelPtr model = model_of(one);
  Robot robot(model, joints);
  robot.set_keyframe("bent");
  auto tip = std::make_unique<PoseTask>("tip", robot, "tip");
  auto posture = std::make_unique<PostureTask>("posture", robot);
  WholeBodyControllerOptions options;
  options.dt = model->opt.timestep;
  options.servo = std::move(servo);
  std::vector<Channel> channels = {{"tip", ChannelKind::Twist, *tip, Vector::Constant(1, 0.5)}};
  auto controller = std::make_shared<WholeBodyController>(
      robot, std::vector<NamedStack>{{"lead", *tip < *posture, one.order}}, std::move(channels),
      std::move(options));
  controller->keep(std::move(tip));
  controller->keep(std::move(posture));
  SimulationOptions quiet;
  quiet.record = false;
  quiet.physics = one.physics;
  return {model, std::move(controller), quiet};
}

Vector twist(double vx, double vy, double vz, double wx = 0.0, double wy = 0.0, double wz = 0.0) {
  return (Vector(6) << vx, vy, vz, wx, wy, wz).finished();
}

// [rad] that a ball joint of the plan has turned
double angle(const Simulation& simulation, std::size_t ball) {
  const Robot& plan = simulation.controller().plan();
  return plan.configuration().segment<3>(plan.rotations()[ball].first).norm();
}

class BallJointInTheLoop : public testing::TestWithParam<Case> {};

TEST_P(BallJointInTheLoop, Arrives) {
  Simulation simulation = simulate(GetParam());
  Robot robot(model_of(GetParam()));
  Vector q(robot.size());
  q << -0.2, -0.5, 0.4, 0.6, -0.7, -0.6, 0.2, 0.9;
  robot.set_configuration(q);
  const Skeleton::Pose wanted = robot.pose(robot.frame("tip"));
  dynamic_cast<PoseTask&>(simulation.controller().task("tip")).set_target(wanted.p, wanted.R);
  simulation.step(6000);
  const Skeleton::Pose is = simulation.world().pose(simulation.world().frame("tip"));
  EXPECT_LT((is.p - wanted.p).norm(), 1e-5);
  EXPECT_LT(rotation_log(is.R * wanted.R.transpose()).norm(), 1e-5);
  EXPECT_LT(simulation.plant().qvel().cwiseAbs().maxCoeff(), 1e-4);
}

// no tick ahead of it or behind: 0.1 mm and 0.3 mrad each
TEST_P(BallJointInTheLoop, TheTipIsWhereTheTargetIs) {
  Simulation simulation = simulate(GetParam());
  const Vector command = twist(0.1, 0.0, 0.0, 0.0, 0.2, 0.2);
  simulation.step(1000, &command);
  const auto task = simulation.controller().task("tip").clone();
  task->update(simulation.world());
  EXPECT_LT(task->error().head<3>().norm(), 2e-5);
  EXPECT_LT(task->error().tail<3>().norm(), 6e-5);
}

TEST_P(BallJointInTheLoop, KeepsItsRange) {
  Simulation simulation = simulate(GetParam());
  const Vector command = twist(0.2, 0.5, 0.3);
  const bool torque = GetParam().order == ControlOrder::Torque;
  for (int i = 0; i < 3000; ++i) {
    simulation.step(1, &command);
    // but for the rounding of a quaternion that is read back
    EXPECT_LT(angle(simulation, 0), 1.2 + (torque ? 2e-3 : 1e-14)) << i;
    EXPECT_LT(angle(simulation, 1), 1.6 + (torque ? 2e-3 : 1e-14)) << i;
  }
  EXPECT_GT(std::max(angle(simulation, 0) / 1.2, angle(simulation, 1) / 1.6), 0.98);
}

TEST_P(BallJointInTheLoop, GoesOnFromASnapshotAndInACopyByTheSameBits) {
  Simulation simulation = simulate(GetParam());
  const Vector command = twist(0.1, 0.1, -0.1, 0.1, 0.2, 0.3);
  const GoneOn gone = expect_same_bits(simulation, command);
  Simulation another = simulate(GetParam());
  another.restore(gone.state);
  another.step(200, &command);
  EXPECT_EQ(another.state(), gone.later);
}

TEST_P(BallJointInTheLoop, AllocatesNothing) {
  Simulation simulation = simulate(GetParam());
  const Vector command = twist(0.1, 0.1, -0.1, 0.1, 0.2, 0.3);
  simulation.step(50, &command);
  const NoAllocation guard;
  simulation.step(200, &command);
  EXPECT_EQ(guard.count(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Orders, BallJointInTheLoop,
                         testing::Values(Case{"Velocity", ControlOrder::Velocity},
                                         Case{"Acceleration", ControlOrder::Acceleration},
                                         Case{"Torque", ControlOrder::Torque},
                                         Case{"ByServos", ControlOrder::Velocity, true},
                                         Case{"WithoutPhysics", ControlOrder::Velocity, false,
                                              false}),
                         [](const auto& test) { return test.param.name; });

TEST(BallJointRange, IsARowThatMovesAsTheAngleDoesAtTheLimit) {
  Robot robot(load_model_text(kBallArm));
  JointRanges ranges("ranges", robot);
  ASSERT_EQ(ranges.rows(), 2);
  EXPECT_EQ(ranges.row_name(robot, 0), "shoulder");
  EXPECT_EQ(ranges.upper()[1], 0.8);
  const double h = 1e-5;
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomMotion random(seed);
    const Vector q = random.configuration(robot), v = random.vector(robot.size(), 1.0);
    robot.set_velocity(v);
    const auto at = [&](double time) {
      Vector moved = q;
      add_step(robot.rotations(), time * v, moved);
      robot.set_configuration(moved);
      ranges.update(robot);
      return Vector(ranges.error());
    };
    const Vector ahead = at(h), behind = at(-h), now = at(0.0);
    EXPECT_TRUE(near(ranges.jacobian() * v, (ahead - behind) / (2.0 * h), 1e-8)) << seed;
    EXPECT_TRUE(near(ranges.drift(), (ahead - 2.0 * now + behind) / (h * h), 1e-4)) << seed;
  }
  Vector q = Vector::Zero(robot.size());
  q.segment<3>(1) = 1.2 * Vector3(1, 2, -2) / 3.0;
  robot.set_configuration(q);
  ranges.update(robot);
  EXPECT_NEAR(ranges.error()[0], ranges.upper()[0], 1e-12);
  EXPECT_NEAR(ranges.jacobian().row(0).norm(), 1.0, 1e-12);
  q.setZero();
  robot.set_configuration(q);
  robot.set_velocity(Vector::Ones(robot.size()));
  ranges.update(robot);
  EXPECT_TRUE(ranges.drift().allFinite());
}

TEST(BallJointOfNoCoordinate, HoldsItsPlace) {
  const std::vector<ServoGains> gains = {{"lift", 0.2, 20.0},        {"shoulder_rx", 0.2, 20.0},
                                         {"shoulder_ry", 0.1, 20.0}, {"shoulder_rz", 0.1, 20.0},
                                         {"elbow", 0.1, 20.0},       {"wrist_rx", 0.005, 20.0},
                                         {"wrist_ry", 0.005, 20.0},  {"wrist_rz", 0.005, 20.0}};
  Simulation simulation = simulate({"", ControlOrder::Velocity}, {"lift", "elbow"}, gains);
  ASSERT_EQ(simulation.world().size(), 2);
  const Vector start = simulation.plant().qpos();
  simulation.step(3000);
  EXPECT_TRUE(near(simulation.plant().qpos(), start, 1e-3));
}

}  // namespace

// Strategy: a cart with two driven wheels as one coordinate, a boom, and a winch that no coordinate
// drives: who gets which torque, what a motor without a coordinate holds, what is refused.
#include "hurcules/control/joint_servo.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

std::string cart(const std::string& winch = R"(<motor joint="winch"/>)") {
  return R"(<mujoco><option gravity="0 0 0"/>
  <default><joint armature="0.5"/></default><worldbody>
    <body><joint name="left" axis="0 1 0"/><geom size="0.1" mass="1"/></body>
    <body pos="0 1 0"><joint name="right" axis="0 -1 0"/><geom size="0.1" mass="1"/></body>
    <body pos="0 2 0"><joint name="boom" axis="0 1 0"/><geom size="0.1" mass="1" pos="0.3 0 0"/></body>
    <body pos="0 3 0"><joint name="winch" axis="0 1 0"/><geom size="0.1" mass="1"/></body>
  </worldbody>
  <actuator><motor joint="boom" gear="4" forcerange="-5 5"/><motor joint="left"/>
    <motor joint="right"/>)" +
         winch + R"(</actuator>
  <custom><tuple name="coordinate_wheels"><element objtype="joint" objname="left" prm="1"/>
      <element objtype="joint" objname="right" prm="-2"/></tuple>
    <tuple name="coordinate_boom"><element objtype="joint" objname="boom" prm="1"/></tuple></custom>
  </mujoco>)";
}

const std::vector<ServoGains> kTable = {
    {"left", 0.5, 10.0}, {"right", 0.5, 10.0}, {"boom", 1.0, 10.0}, {"winch", 0.2, 10.0}};

class JointServoTest : public testing::Test {
 protected:
  void act(double wheels, double boom) { follow(Eigen::Vector2d(wheels, boom), Vector::Zero(2)); }
  void follow(const Vector& q, const Vector& qd) {
    const mjModel* const m = robot_.model().get();
    const Vector qpos = Eigen::Map<const Vector>(data_->qpos, m->nq);
    const Vector qvel = Eigen::Map<const Vector>(data_->qvel, m->nv);
    for (std::size_t i = 0; i < status_.size(); ++i) {
      status_[i].range = servo_.actuator(servo_.find(joint_of(i))).limits.at(0.0);
    }
    servo_.follow(q, qd);
    servo_.compute({qpos, qvel, status_}, Eigen::Map<Vector>(data_->ctrl, m->nu));
  }
  [[nodiscard]] std::string joint_of(std::size_t actuator) const {
    const mjModel* const m = robot_.model().get();
    return mj_id2name(m, mjOBJ_JOINT, m->actuator_trnid[2 * actuator]);
  }
  Robot robot_{load_model_text(cart())};
  std::unique_ptr<mjData, void (*)(mjData*)> data_{mj_makeData(robot_.model().get()),
                                                   mj_deleteData};
  JointServo servo_{robot_, kTable, 1e-3};
  std::vector<ActuatorStatus> status_ = std::vector<ActuatorStatus>(4);
};

TEST_F(JointServoTest, DrivesJointsOfACoordinateEachOnItsOwn) {
  EXPECT_EQ(servo_.names(), (std::vector<std::string>{"left", "right", "boom", "winch"}));
  EXPECT_EQ(servo_.coordinate_joints(), 3);
  act(0.1, 0.0);
  EXPECT_NEAR(servo_.error().position[0], 0.1, 1e-15);
  EXPECT_NEAR(servo_.error().position[1], -0.2, 1e-15);
  EXPECT_NEAR(servo_.torque()[1], -2.0 * servo_.torque()[0], 1e-12);
}

TEST_F(JointServoTest, DividesByTheGearAndSaturatesAtTheJoint) {
  act(0.0, 1.0);  // actuator 0 is the boom: 4 x 5 N m at the joint
  EXPECT_EQ(servo_.torque()[2], 20.0);
  EXPECT_EQ(data_->ctrl[0], 5.0);
  EXPECT_GT(servo_.demand()[2], 20.0);
}

TEST_F(JointServoTest, TellsWhichVelocityOfTheReferenceAsksForThePeakAndNoMore) {
  Vector q(2), qd(2);
  const Vector qpos = Vector::Zero(robot_.model()->nq), qvel = qpos;
  q << 0.1, 0.2;
  for (int i = 0; i < 5; ++i) act(0.1, 0.02);  // an integral, not yet saturated
  const VelocityBounds window = servo_.velocity_bounds(
      q, Vector::Zero(2), {qpos, qvel, status_}, std::numeric_limits<double>::infinity(), nullptr);
  EXPECT_EQ(window.upper[0], std::numeric_limits<double>::infinity());  // motors without limits
  const JointServo before = servo_;
  using Case = std::pair<double, double>;
  for (const auto& [rate, torque] : {Case(window.lower[1], -20.0), Case(window.upper[1], 20.0)}) {
    servo_ = before;
    qd << 0.0, rate;
    follow(q + 1e-3 * qd, qd);
    EXPECT_NEAR(servo_.demand()[2], torque, 1e-9);
    EXPECT_LE(std::abs(servo_.demand()[2]), 20.0);
  }
}

TEST_F(JointServoTest, LeadsAReferenceAwayOnlyAsFastAsItsJointIsSeenToGo) {
  constexpr double kMost = 0.02;  // [rad/s]
  const JointActuator& joint = servo_.actuator(2);
  const Vector q = Vector::Zero(2), rest = Vector::Zero(2);
  const auto least = [&](double place, double speed) {  // of the reference, [rad/s]
    Vector qpos = Vector::Zero(robot_.model()->nq), qvel = Vector::Zero(robot_.model()->nv);
    qpos[joint.qpos] = place;
    qvel[joint.dof] = speed;
    return servo_.velocity_bounds(q, rest, {qpos, qvel, status_}, kMost, nullptr).lower[1];
  };
  EXPECT_LT(least(0.0, 0.0), 0.0);     // it may stand
  EXPECT_EQ(least(0.0, 50.0), kMost);  // one wrong speed
  EXPECT_LE(least(0.02, 0.0), kMost);  // one wrong place
  servo_.reset(Vector::Zero(robot_.model()->nq));
  EXPECT_EQ(least(0.02, 50.0), 20.0 + kMost);  // a push
}

TEST_F(JointServoTest, HoldsWhatNoCoordinateDrivesWhereItStood) {
  const mjModel* const m = robot_.model().get();
  const int winch = m->jnt_qposadr[mj_name2id(m, mjOBJ_JOINT, "winch")];
  data_->qpos[winch] = 0.7;
  servo_.reset(Eigen::Map<const Vector>(data_->qpos, m->nq));
  act(0.0, 0.0);
  EXPECT_EQ(servo_.torque()[3], 0.0);
  data_->qpos[winch] = 0.8;
  act(0.0, 0.0);
  EXPECT_LT(servo_.torque()[3], 0.0);
}

TEST_F(JointServoTest, BringsTheJointsToTheirReference) {
  for (int i = 0; i < 3000; ++i) {
    act(0.5, 0.3);
    mj_step(robot_.model().get(), data_.get());
  }
  robot_.set_qpos(Eigen::Map<const Vector>(data_->qpos, robot_.model()->nq));
  EXPECT_TRUE(near(robot_.configuration(), Eigen::Vector2d(0.5, 0.3), 1e-4));
}

TEST_F(JointServoTest, MakesAPositionServoGiveTheTorqueOfAMotor) {
  const std::string gains = R"(<position joint="winch" kp="50" kv="3"/>)";
  Robot other(load_model_text(cart(gains)));
  const JointServo servo(other, kTable, 1e-3);
  const JointActuator& winch = servo.actuator(servo.find("winch"));
  const mjModel* const m = other.model().get();
  data_.reset(mj_makeData(m));
  data_->qpos[winch.qpos] = 0.3;
  data_->qvel[winch.dof] = -0.2;
  data_->ctrl[winch.actuator] = winch.control(1.7, 0.3, -0.2);
  mj_forward(m, data_.get());
  EXPECT_NEAR(data_->qfrc_actuator[winch.dof], 1.7, 1e-12);
}

TEST_F(JointServoTest, GoesOnWhereAJointWasMovedByItself) {
  servo_.move(servo_.find("left"), 0.4, 0.1);
  servo_.move(servo_.find("right"), -0.5, -0.3);  // factor -2: 0.3 from its coordinate
  Vector q = Vector::Zero(2), qd = q;
  servo_.release(q, qd);
  EXPECT_EQ(q[0], 0.4);
  EXPECT_EQ(qd[0], 0.1);
  servo_.follow(q, Vector::Zero(2));
  EXPECT_NEAR(servo_.position()[1], -0.5, 1e-15);
  servo_.follow(q + Eigen::Vector2d(0.1, 0.0), Vector::Zero(2));
  EXPECT_NEAR(servo_.position()[1], -0.7, 1e-15);
}

TEST_F(JointServoTest, SharesOutWhatAModelTells) {
  servo_.feed_forward(Eigen::Vector2d(5.0, 3.0), false);
  act(0.0, 0.0);
  // the wheels' factors are 1 and -2: 1 * 1 N m + (-2) * (-2 N m) = 5 N m
  EXPECT_TRUE(near(servo_.torque(), (Vector(4) << 1.0, -2.0, 3.0, 0.0).finished(), 1e-12));
}

TEST_F(JointServoTest, GivesWhatDryFrictionTakesTowardsWhereItsReferenceGoes) {
  std::string text = cart();
  const std::string boom = R"("boom" axis="0 1 0")";
  text.replace(text.find(boom), boom.size(), boom + R"( frictionloss="3")");
  const Robot dry(load_model_text(text));
  servo_ = JointServo(dry, kTable, 1e-3);
  const double slides = dry.dry_friction(1).front().slides;
  EXPECT_EQ(dry.dry_friction(1).front().most, 3.0);
  for (const double speed : {0.5, 0.5 * slides, 0.0, -0.1 * slides, -0.5}) {
    servo_.reset(Vector::Zero(4));
    data_->qvel[2] = speed;
    for (const bool told : {true, false}) {
      servo_.feed_forward(Vector::Zero(2), told);
      // it goes as its reference does, which is at the end of the period here
      follow(Eigen::Vector2d(0.0, 1e-3 * speed), Eigen::Vector2d(0.0, speed));
      EXPECT_NEAR(servo_.torque()[2], told ? 3.0 * std::clamp(speed / slides, -1.0, 1.0) : 0.0,
                  1e-12);
    }
  }
  // no more than the motor has left: a window does not count it
  data_->qvel[2] = 0.0;
  servo_.reset(Vector::Zero(4));
  servo_.feed_forward(Eigen::Vector2d(0.0, 19.0), true);
  follow(Eigen::Vector2d(0.0, 1e-5), Eigen::Vector2d(0.0, 1e-2));  // 0.3 N m of its own
  EXPECT_GT(servo_.demand()[2], 19.9);
  EXPECT_LE(servo_.demand()[2], 20.0);
}

TEST(DefaultServoGains, CoverTheInertiasOfTheRanges) {
  const Robot arm(load_model_text(kArm));
  for (const double dt : {1e-3, 5e-3}) {
    for (const ServoGains& row : default_servo_gains(arm, dt)) {
      EXPECT_GT(row.inertia, 0.0) << row.joint;
      EXPECT_LE(row.bandwidth, 30.0) << row.joint;
      EXPECT_GT(row.bandwidth, 1.0) << row.joint;
    }
  }
}

TEST_F(JointServoTest, RefusesJointsWithoutARowAndMuscles) {
  const std::vector<ServoGains> few(kTable.begin(), kTable.end() - 1);
  const std::string text = error_text([&] { JointServo(robot_, few, 1e-3); });
  EXPECT_TRUE(contains(text, "'winch' does not exist; there are: left, right, boom")) << text;
  const Robot other(load_model_text(cart(R"(<muscle joint="winch" lengthrange="0 1"/>)")));
  EXPECT_TRUE(
      contains(error_text([&] { JointServo(other, kTable, 1e-3); }), "wants to be a motor"));
}

}  // namespace

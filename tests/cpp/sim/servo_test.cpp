// Strategy: a cart with two driven wheels as one coordinate, a boom, and a winch that no coordinate
// drives: who gets which torque, what a motor without a coordinate holds, what is refused.
#include "hurcules/sim/servo.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "support/expect.hpp"

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

const std::vector<ServoRow> kTable = {
    {"left", 0.5, 10.0}, {"right", 0.5, 10.0}, {"boom", 1.0, 10.0}, {"winch", 0.2, 10.0}};

class ServoTest : public testing::Test {
 protected:
  void act(double wheels, double boom) {
    Vector q(2), qd = Vector::Zero(2);
    q << wheels, boom;
    servo_.act({q, qd}, data_.get());
  }
  Robot robot_{load_model_text(cart())};
  std::unique_ptr<mjData, void (*)(mjData*)> data_{mj_makeData(robot_.model().get()),
                                                   mj_deleteData};
  Servo servo_{robot_, kTable, 1e-3};
};

TEST_F(ServoTest, DrivesJointsOfACoordinateEachOnItsOwn) {
  EXPECT_EQ(servo_.names(), (std::vector<std::string>{"left", "right", "boom", "winch"}));
  EXPECT_EQ(servo_.coordinate_joints(), 3U);
  act(0.1, 0.0);
  EXPECT_NEAR(servo_.error().position[0], 0.1, 1e-15);
  EXPECT_NEAR(servo_.error().position[1], -0.2, 1e-15);
  EXPECT_NEAR(servo_.torque()[1], -2.0 * servo_.torque()[0], 1e-12);
}

TEST_F(ServoTest, DividesByTheGearAndSaturatesAtTheJoint) {
  act(0.0, 1.0);  // actuator 0 is the boom: 4 x 5 N m at the joint
  EXPECT_EQ(servo_.torque()[2], 20.0);
  EXPECT_EQ(data_->ctrl[0], 5.0);
  EXPECT_GT(servo_.demand()[2], 20.0);
}

TEST_F(ServoTest, TellsWhichVelocityOfTheReferenceAsksForThePeakAndNoMore) {
  Vector q(2), qd(2);
  const Vector qpos = Vector::Zero(robot_.model()->nq), qvel = qpos;
  q << 0.1, 0.2;
  for (int i = 0; i < 5; ++i) act(0.1, 0.02);  // an integral, not yet saturated
  const RateWindow window = servo_.find_window(q, {qpos, qvel});
  EXPECT_EQ(window.upper[0], std::numeric_limits<double>::infinity());  // motors without limits
  const Servo before = servo_;
  using Case = std::pair<double, double>;
  for (const auto& [rate, torque] : {Case(window.lower[1], -20.0), Case(window.upper[1], 20.0)}) {
    servo_ = before;
    qd << 0.0, rate;
    servo_.act({q + 1e-3 * qd, qd}, {qpos, qvel}, data_.get());
    EXPECT_NEAR(servo_.demand()[2], torque, 1e-9);
    EXPECT_LE(std::abs(servo_.demand()[2]), 20.0);
  }
}

TEST_F(ServoTest, HoldsWhatNoCoordinateDrivesWhereItStood) {
  const mjModel* const m = robot_.model().get();
  const int winch = m->jnt_qposadr[mj_name2id(m, mjOBJ_JOINT, "winch")];
  data_->qpos[winch] = 0.7;
  servo_.reset(data_.get());
  act(0.0, 0.0);
  EXPECT_EQ(servo_.torque()[3], 0.0);
  data_->qpos[winch] = 0.8;
  act(0.0, 0.0);
  EXPECT_LT(servo_.torque()[3], 0.0);
}

TEST_F(ServoTest, BringsTheJointsToTheirReference) {
  for (int i = 0; i < 3000; ++i) {
    act(0.5, 0.3);
    mj_step(robot_.model().get(), data_.get());
  }
  robot_.set_qpos(Eigen::Map<const Vector>(data_->qpos, robot_.model()->nq));
  EXPECT_TRUE(near(robot_.configuration(), Eigen::Vector2d(0.5, 0.3), 1e-4));
}

TEST_F(ServoTest, RefusesJointsWithoutARowAndActuatorsWithGains) {
  const std::vector<ServoRow> few(kTable.begin(), kTable.end() - 1);
  const std::string text = error_text([&] { Servo(robot_, few, 1e-3); });
  EXPECT_TRUE(contains(text, "'winch' does not exist; there are: left, right, boom")) << text;
  const Robot other(load_model_text(cart(R"(<position joint="winch" kp="10"/>)")));
  EXPECT_TRUE(contains(error_text([&] { Servo(other, kTable, 1e-3); }), "wants to be a motor"));
}

}  // namespace

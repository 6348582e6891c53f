// Strategy: the three ways to find coordinates on three tiny robots, limits computed by hand, and
// every wrong tuple as an Error that names it.
#include <limits>

#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"
#include "support/models.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Names = std::vector<std::string>;

// the pendulum with this in its custom section
std::string pendulum_with(const std::string& custom) {
  const std::string text = kPendulum;
  return text.substr(0, text.rfind("</mujoco>")) + "<custom>" + custom + "</custom></mujoco>";
}

std::string tuple(const std::string& name, const std::string& joint, const std::string& factor) {
  return "<tuple name='" + name + "'><element objtype='joint' objname='" + joint + "' prm='" +
         factor + "'/></tuple>";
}

std::string error_of(const std::string& custom) {
  return error_text([&] { Robot robot(load_model_text(pendulum_with(custom))); });
}

TEST(Coordinates, TuplesNameThemInTheirOrder) {
  const Robot robot(load_model_text(kTwin));
  EXPECT_EQ(robot.coordinate_names(), (Names{"HIP", "KN", "WST", "NKY", "NKP", "LSP", "LSR", "LSY",
                                             "LEB", "RSP", "RSR", "RSY", "REB"}));
  EXPECT_EQ(robot.coordinate("KN"), 1);
}

TEST(Coordinates, WithoutTuplesDrivenJointsAreCoordinates) {
  const Robot robot(load_model_text(kArm));
  EXPECT_EQ(robot.coordinate_names(), (Names{"j1", "j2", "j3", "j4", "j5", "j6", "j7"}));
}

TEST(Coordinates, WithoutActuatorsEveryHingeAndSlideIsOne) {
  const Robot robot(load_model_text(kPendulum));
  EXPECT_EQ(robot.coordinate_names(), (Names{"slide", "swing"}));
}

TEST(Coordinates, AModelWithoutJointsHasNone) {
  Robot robot(load_model_text("<mujoco><worldbody><site name='here'/></worldbody></mujoco>"));
  EXPECT_EQ(robot.size(), 0);
  Matrix J(3, 0);
  robot.position_jacobian(robot.frame("here"), J);
}

TEST(Coordinates, LimitsOfCoupledJointsMeetInTheUnitsOfTheCoordinate) {
  const Robot robot(load_model_text(kTwin));
  const Coordinate& knee = robot.coordinates()[1];
  // LKN -1 .. 2 with factor 1; RKN -2 .. 3 with factor -2 is -1.5 .. 1
  EXPECT_DOUBLE_EQ(knee.lower, -1.0);
  EXPECT_DOUBLE_EQ(knee.upper, 1.0);
  // 0.6 rad/s against 0.8 / 2
  EXPECT_DOUBLE_EQ(knee.max_velocity, 0.4);
  // 50 N m both ways, and 3 * 10 N m at factor 2
  EXPECT_DOUBLE_EQ(knee.max_effort, 110.0);
}

TEST(Coordinates, WhatTheModelDoesNotLimitIsInfinite) {
  const Robot robot(load_model_text(kTwin));
  const Coordinate& waist = robot.coordinates()[2];
  EXPECT_EQ(waist.lower, -kInfinity);
  EXPECT_EQ(waist.upper, kInfinity);
  EXPECT_EQ(waist.max_velocity, kInfinity);
  EXPECT_EQ(waist.max_effort, kInfinity);
  EXPECT_EQ(Robot(load_model_text(kArm)).coordinates()[0].max_effort, 50.0);
}

TEST(Coordinates, AControlRangeLimitsAPlainMotorAndNoServo) {
  const Robot robot(load_model_text(R"(<mujoco><worldbody><body><joint name="a"/><geom size="0.1"/>
    <body pos="0 0 1"><joint name="b"/><geom size="0.1"/></body></body></worldbody>
    <actuator><motor joint="a" ctrlrange="-2 3" gear="10"/>
      <position joint="b" kp="100" ctrlrange="-1 1"/></actuator></mujoco>)"));
  EXPECT_EQ(robot.coordinates()[0].max_effort, 20.0);
  EXPECT_EQ(robot.coordinates()[1].max_effort, kInfinity);
}

TEST(Coordinates, CoupledJointsMoveTogether) {
  Robot robot(load_model_text(kTwin));
  Vector q = Vector::Zero(13);
  q[1] = 0.3;
  robot.set_configuration(q);
  const Coordinate& knee = robot.coordinates()[1];
  EXPECT_DOUBLE_EQ(robot.qpos()[knee.joints[0].qpos], 0.3);
  EXPECT_DOUBLE_EQ(robot.qpos()[knee.joints[1].qpos], -0.6);
  EXPECT_DOUBLE_EQ(robot.configuration()[1], 0.3);
}

TEST(Coordinates, APrefixOfAttachStaysInFront) {
  const std::string custom =
      tuple("left_coordinate_X", "slide", "2") + "<numeric name='velocity_limit_slide' data='3'/>";
  const Robot robot(load_model_text(pendulum_with(custom)));
  EXPECT_EQ(robot.coordinate_names(), Names{"left_X"});
  EXPECT_DOUBLE_EQ(robot.coordinates()[0].max_velocity, 1.5);
}

TEST(Coordinates, ACoordinateIsItsFirstJointOverTheFactor) {
  Robot robot(load_model_text(pendulum_with(tuple("coordinate_X", "slide", "-2"))));
  robot.set_configuration(Vector::Constant(1, 0.3));
  EXPECT_DOUBLE_EQ(robot.qpos()[0], -0.6);
  EXPECT_DOUBLE_EQ(robot.configuration()[0], 0.3);
  // slide -1 .. 2
  EXPECT_DOUBLE_EQ(robot.coordinates()[0].lower, -1.0);
  EXPECT_DOUBLE_EQ(robot.coordinates()[0].upper, 0.5);
}

TEST(Coordinates, WrongTuplesAreNamed) {
  EXPECT_TRUE(contains(error_of(tuple("coordinate_A", "slide", "0")), "'A' wants a factor"));
  EXPECT_TRUE(
      contains(error_of(tuple("coordinate_A", "slide", "1") + tuple("coordinate_B", "slide", "1")),
               "joint 'slide' belongs to one coordinate only, 'B' names it again"));
  EXPECT_TRUE(contains(error_of("<tuple name='coordinate_A'>"
                                "<element objtype='body' objname='cart' prm='1'/></tuple>"),
                       "'A' wants hinge or slide joints"));
  EXPECT_TRUE(contains(error_of("<numeric name='velocity_limit_swing' data='-1'/>"),
                       "joint 'swing' wants to be above 0"));
}

// a limit that holds for nothing would be none
TEST(Coordinates, LimitsOfSpeedWantAJointAndOneNumber) {
  EXPECT_TRUE(contains(error_of("<numeric name='velocity_limit_swng' data='1'/>"),
                       "numeric 'velocity_limit_swng': joint 'swng' does not exist; there are: "));
  EXPECT_TRUE(contains(error_of("<numeric name='velocity_limit_swing' data='1 2'/>"),
                       "wants one number, 2 came"));
}

TEST(Coordinates, CoupledRangesThatDoNotMeetAreAnError) {
  std::string text = kTwin;
  text.replace(text.find("range=\"-2 3\""), 12, "range=\"-9 -8\"");
  EXPECT_TRUE(contains(error_text([&] { Robot robot(load_model_text(text)); }),
                       "'KN': the ranges of its joints do not meet"));
}

TEST(Coordinates, HurculesForRescueHasThirteen) {
  const std::string path = hurcules_test::models("/robots/rescue.xml");
  const Robot robot(load_model(path));
  EXPECT_EQ(robot.size(), 13);
  EXPECT_EQ(robot.coordinates()[robot.coordinate("KN")].joints.size(), 2U);
}

TEST(Coordinates, HurculesForManipulationHasNineteen) {
  const std::string path = hurcules_test::models("/robots/manipulation.xml");
  EXPECT_EQ(Robot(load_model(path)).size(), 19);
}

}  // namespace

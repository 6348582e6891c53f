// Strategy: joints that equality constraints couple, on a chain whose couplings a hand can reckon: a
// mimic joint with slope and shift, one that mimics a mimic, an actuator on the joint that follows.
// What is held, and which constraints are not kept, by name. Not tested: Jacobians of coordinates
// of several joints (every_task_test.cpp).
#include <mujoco/mujoco.h>

#include "hurcules/robot/left_out.hpp"
#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// joints in a row; `more` goes into the model beside them
std::string chain(const std::string& equality, const std::string& actuators) {
  return R"(<mujoco><compiler angle="radian"/><default><joint axis="0 1 0"/><geom size="0.05"/></default>
    <worldbody><body name="l1"><joint name="a" range="-1 2" limited="true"/><geom/>
    <body name="l2" pos="0.2 0 0"><joint name="b" range="-0.5 0.9" limited="true"/><geom/>
    <body name="l3" pos="0.2 0 0"><joint name="c"/><geom/>
    <body name="l4" pos="0.2 0 0"><joint name="d"/><geom/></body></body></body></body></worldbody>
    <equality>)" +
         equality + "</equality><actuator>" + actuators + "</actuator></mujoco>";
}

TEST(CoupledJoints, AMimicJointMovesWithItsLeader) {
  Robot robot(load_model_text(chain(R"(<joint joint1="b" joint2="a" polycoef="0.1 -0.5 0 0 0"/>
               <joint joint1="c" joint2="b" polycoef="0 2 0 0 0"/>)",
                                    R"(<motor joint="a"/><motor joint="c"/><motor joint="d"/>)")));
  ASSERT_EQ(robot.coordinate_names(), (std::vector<std::string>{"a", "d"}));
  robot.set_configuration(Vector{{0.4, 0.3}});
  EXPECT_TRUE(near(robot.qpos(), Vector{{0.4, 0.1 - 0.2, 2.0 * (0.1 - 0.2), 0.3}}, 1e-15));
  EXPECT_TRUE(near(robot.configuration(), Vector{{0.4, 0.3}}, 1e-15));
  // b within -0.5 .. 0.9: a within -1.6 .. 1.2, and a itself within -1 .. 2
  EXPECT_NEAR(robot.coordinates()[0].lower, -1.0, 1e-15);
  EXPECT_NEAR(robot.coordinates()[0].upper, 1.2, 1e-15);
  EXPECT_EQ(left_out(robot), "");
  // MuJoCo agrees that the constraint is kept
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(robot.model().get()),
                                                        mj_deleteData);
  std::copy(robot.qpos().begin(), robot.qpos().end(), data->qpos);
  mj_forward(robot.model().get(), data.get());
  ASSERT_EQ(data->ne, 2);
  EXPECT_NEAR(data->efc_pos[0], 0.0, 1e-12);
  EXPECT_NEAR(data->efc_pos[1], 0.0, 1e-12);
}

TEST(CoupledJoints, AnActuatorOnTheJointThatFollowsLeads) {
  Robot robot(load_model_text(chain(R"(<joint joint1="b" joint2="a" polycoef="0.1 -0.5 0 0 0"/>)",
                                    R"(<motor joint="b"/>)")));
  ASSERT_EQ(robot.coordinate_names(), std::vector<std::string>{"b"});
  robot.set_configuration(Vector{{-0.3}});
  EXPECT_NEAR(robot.qpos()[0], 0.8, 1e-15);  // b = 0.1 - 0.5 a
}

TEST(CoupledJoints, WhatIsHeldAndWhatIsNotKeptIsNamed) {
  const Robot robot(
      load_model_text(chain(R"(<joint name="curve" joint1="b" joint2="a" polycoef="0 1 0.3 0 0"/>
               <connect name="loop" body1="l4" body2="l1" anchor="0 0 0"/>)",
                            R"(<motor joint="a"/><motor joint="b"/>)")));
  const std::string text = left_out(robot);
  EXPECT_TRUE(contains(text, "1 joints")) << text;  // c follows in the loop
  EXPECT_TRUE(contains(text, "coordinate: d;")) << text;
  EXPECT_TRUE(contains(text, "not keep: curve")) << text;
  EXPECT_FALSE(contains(text, "loop")) << text;
  EXPECT_TRUE(contains(text, "joints=[...]")) << text;
}

}  // namespace

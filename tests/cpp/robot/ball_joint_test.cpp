// Strategy: an arm with two ball joints and one whose ball joints nothing drives: which coordinates there
// are, in whatever words they are asked for, limits by hand, numbers that are read and written, a turn
// beyond pi, actuators, and what is refused. Motion and dynamics: floating_test.cpp.
#include <limits>
#include <numbers>

#include "hurcules/robot/joint_actuators.hpp"
#include "hurcules/robot/left_out.hpp"
#include "hurcules/robot/plausibility.hpp"
#include "support/expect.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

using Names = std::vector<std::string>;
const Names kAll = {"lift",  "shoulder_rx", "shoulder_ry", "shoulder_rz",
                    "elbow", "wrist_rx",    "wrist_ry",    "wrist_rz"};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string error_of(const Names& joints) {
  return error_text([&] { Robot(load_model_text(kBallArm), joints); });
}

class BallJoint : public testing::Test {
 protected:
  ModelPtr model_ = load_model_text(kBallArm);
  Robot robot_{model_};
};

TEST_F(BallJoint, IsThreeCoordinates) {
  EXPECT_EQ(robot_.coordinate_names(), kAll);
  EXPECT_EQ(left_out(robot_), "");
  EXPECT_FALSE(robot_.floating());
  EXPECT_EQ(Robot(model_, kAll).coordinate_names(), kAll);
  EXPECT_EQ(Robot(model_, {"wrist", "lift"}).coordinate_names(),
            (Names{"wrist_rx", "wrist_ry", "wrist_rz", "lift"}));
  const std::string idle = replaced(kBallArm, "<actuator>", "<custom/><!--");
  EXPECT_EQ(Robot(load_model_text(replaced(idle, "</actuator>", "-->"))).coordinate_names(), kAll);
}

TEST_F(BallJoint, HasOneRangeAndAnEffortAboutEachAxis) {
  const Coordinate& y = robot_.coordinates()[2];
  EXPECT_EQ(y.lower, -1.2);
  EXPECT_EQ(y.upper, 1.2);
  EXPECT_EQ(y.max_effort, 120.0);  // by its gear
  EXPECT_EQ(y.joints[0].actuator, 2);
  EXPECT_EQ(robot_.coordinates()[5].joints[0].actuator, 6);  // the wrist's about x
  ASSERT_EQ(robot_.rotations().size(), 2U);
  EXPECT_EQ(robot_.rotations()[1].first, 5);
  EXPECT_EQ(robot_.rotations()[1].range, 1.6);
}

TEST_F(BallJoint, ReadsAndWritesItsRotationVector) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Vector q = RandomMotion(seed).configuration(robot_);
    robot_.set_configuration(q);
    EXPECT_TRUE(near(robot_.configuration(), q, 1e-12));
    EXPECT_NEAR(robot_.qpos().segment<4>(1).norm(), 1.0, 1e-12);
    EXPECT_NEAR(robot_.qpos()[1], std::cos(0.5 * q.segment<3>(1).norm()), 1e-12);
    EXPECT_EQ(robot_.qpos()[5], q[4]);
  }
}

TEST_F(BallJoint, TurnsOnBeyondPi) {
  Vector q = Vector::Zero(robot_.size()), step = q;
  step[5] = 0.1;
  for (int i = 0; i < 40; ++i) add_step(robot_.rotations(), step, q);
  EXPECT_NEAR(q[5], 4.0 - 2.0 * std::numbers::pi, 1e-12);
  const Vector rest = q;
  add_step(robot_.rotations(), Vector::Zero(robot_.size()), q);
  EXPECT_EQ(q, rest);
}

TEST_F(BallJoint, HasAnActuatorAboutEachAxis) {
  const std::vector<JointActuator> actuators = joint_actuators(robot_);
  ASSERT_EQ(actuators.size(), 8U);
  EXPECT_EQ(actuators[5].joint, "wrist_rz");
  EXPECT_EQ(actuators[5].dof, 7);
  EXPECT_EQ(actuators[3].gear, -1.0);
  EXPECT_EQ(actuators[2].limits.peak, 120.0);
  robot_.set_keyframe("bent");
  EXPECT_EQ(actuators[2].position(robot_.qpos()), robot_.configuration()[2]);
}

TEST_F(BallJoint, IsWarnedOfByItsAngle) {
  Vector q = Vector::Zero(robot_.size());
  q.segment<3>(1) = Vector3(0.6, 0.6, 0.6);
  robot_.set_configuration(q);
  EXPECT_EQ(outside_limits(robot_), "");
  q.segment<3>(1) = Vector3(0.8, 0.8, 0.8);
  robot_.set_configuration(q);
  EXPECT_TRUE(contains(outside_limits(robot_), "'shoulder' turned by 1.386, limit 1.2"));
}

TEST_F(BallJoint, IsTakenWholeAndWithAllItsActuators) {
  const std::string whole = "wanted together and in their order, as 'wrist'";
  EXPECT_TRUE(contains(error_of({"lift", "wrist_rx"}), whole));
  EXPECT_TRUE(contains(error_of({"wrist_ry"}), whole));
  EXPECT_TRUE(contains(error_of({"wrist_ry", "wrist_rx", "wrist_rz"}), whole));
  EXPECT_TRUE(contains(error_of({"wrist", "wrist"}), "two coordinates are called 'wrist_rx'"));
  const auto refused = [](const std::string& from, const std::string& to) {
    const Robot robot(load_model_text(replaced(kBallArm, from, to)));
    return error_text([&] { (void)joint_actuators(robot); });
  };
  const std::string axis = "<motor joint=\"shoulder\" gear=\"0 2 0\"/>";
  EXPECT_TRUE(contains(refused(axis, ""), "for 'shoulder_ry' it has 0"));
  EXPECT_TRUE(contains(refused("gear=\"0 2 0\"", "gear=\"1 0 0\""), "for 'shoulder_rx' it has 2"));
  EXPECT_TRUE(contains(refused("gear=\"0 2 0\"", "gear=\"1 2 0\""), "about one axis of its body"));
  EXPECT_TRUE(contains(refused(axis, "<motor jointinparent=\"shoulder\" gear=\"0 2 0\"/>"),
                       "joint instead of jointinparent"));
}

}  // namespace

// Strategy: values that a hand can compute, for position, centre of mass, posture and angle.
#include "hurcules/tasks/value_task.hpp"

#include <cmath>
#include <numbers>

#include "hurcules/tasks/angle_task.hpp"
#include "hurcules/tasks/center_of_mass_task.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "hurcules/tasks/posture_task.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class ValuesOfTwin : public testing::Test {
 protected:
  void turn(const std::string& coordinate, double angle) {
    Vector q = robot_.configuration();
    q[robot_.coordinate(coordinate)] = angle;
    robot_.set_configuration(q);
  }
  Robot robot_{load_model_text(kTwin)};
};

TEST_F(ValuesOfTwin, HandHangsBelowTheShoulder) {
  PositionTask hand("hand", robot_, "hand_l");
  EXPECT_TRUE(near(hand.value(), Vector3(0, 0.25, 0.5 + 0.2 + 0.3 + 0.4 - 0.9), 1e-14));
}

TEST_F(ValuesOfTwin, HandToHandDoesNotFeelTheBase) {
  PositionTask grip("grip", robot_, "hand_l", {.reference = "hand_r"});
  EXPECT_TRUE(near(grip.value(), Vector3(0, 0.5, 0), 1e-14));
  Vector qpos = robot_.qpos();
  qpos.segment(7, 7) << 3, 4, 5, 0.5, 0.5, 0.5, 0.5;
  robot_.set_qpos(qpos);
  turn("WST", 0.7);
  turn("HIP", -0.4);
  grip.update(robot_);
  EXPECT_TRUE(near(grip.error(), Vector3::Zero(), 1e-14));
  EXPECT_TRUE(near(grip.jacobian().col(robot_.coordinate("WST")), Vector3::Zero(), 1e-14));
}

TEST_F(ValuesOfTwin, ARelaxedTargetGoesItsShareOfTheWayToTheValue) {
  PositionTask hand("hand", robot_, "hand_l");
  const Vector value = hand.value();
  hand.set_target(value + Vector3(0.4, 0, -0.2));
  hand.update(robot_);
  hand.back_calculate(0.25);
  EXPECT_TRUE(near(hand.target(), value + Vector3(0.3, 0, -0.15), 1e-14));
  hand.update(robot_);
  hand.back_calculate(1.0);
  EXPECT_TRUE(near(hand.target(), value, 1e-14));
}

TEST_F(ValuesOfTwin, AxesPickDirections) {
  const Matrix x = Matrix3::Identity().topRows(1);
  PositionTask pelvis("pelvis", robot_, "chest", {.axes = x});
  turn("HIP", std::numbers::pi / 2);  // the trunk of 0.3 m lies forward
  pelvis.update(robot_);
  EXPECT_EQ(pelvis.rows(), 1);
  EXPECT_NEAR(pelvis.error()[0], 0.3, tolerance(1e-14));
  const auto make = [&](const Matrix& axes) {
    return error_text([&] { PositionTask("p", robot_, "chest", {.axes = axes}); });
  };
  EXPECT_TRUE(contains(make(Matrix::Zero(1, 2)), "(1 to 3, 3), 1 x 2 came"));
  EXPECT_TRUE(contains(make(Matrix::Zero(4, 3)), "4 x 3 came"));
  EXPECT_TRUE(contains(make(Matrix::Constant(1, 3, std::nan(""))), "finite"));
  EXPECT_TRUE(contains(make(Matrix::Zero(1, 3)), "length 0 came"));
}

TEST_F(ValuesOfTwin, CenterOfMassOfASymmetricRobotIsInTheMiddle) {
  CenterOfMassTask com("com", robot_, {.reference = "base"});
  EXPECT_NEAR(com.value()[1], 0.0, tolerance(1e-14));
}

TEST_F(ValuesOfTwin, PostureTakesCoordinatesByName) {
  PostureTask posture("posture", robot_, {"WST", "KN"});
  turn("KN", 0.3);
  posture.update(robot_);
  EXPECT_TRUE(near(posture.error(), Eigen::Vector2d(0, 0.3), 1e-15));
  posture.set_target(Eigen::Vector2d(0.1, 0.3));
  posture.update(robot_);
  EXPECT_TRUE(near(posture.error(), Eigen::Vector2d(-0.1, 0), 1e-15));
  EXPECT_EQ(PostureTask("all", robot_).rows(), 13);
  EXPECT_TRUE(contains(error_text([&] { PostureTask("p", robot_, {"WTS"}); }), "'WTS'"));
}

TEST_F(ValuesOfTwin, ElevationOfALoweredArmIsBelowTheHorizontal) {
  const AngleTaskOptions along_arm{.axis = {0, 0, -2}};
  turn("LSP", std::numbers::pi / 2 - 0.4);
  AngleTask pitch("pitch", robot_, "fa_l", along_arm);
  EXPECT_NEAR(pitch.value()[0], -0.4, tolerance(1e-14));
  pitch.set_target(Vector::Constant(1, 0.1));
  pitch.update(robot_);
  EXPECT_NEAR(pitch.error()[0], -0.5, tolerance(1e-14));
  EXPECT_TRUE(contains(error_text([&] {
                         AngleTask("a", robot_, "fa_l", {.axis = {0, 0, 0}});
                       }),
                       "not zero"));
}

TEST_F(ValuesOfTwin, HeadingIsTheTurnOfTheWaistTheShortWayRound) {
  AngleTask heading("heading", robot_, "chest", {.kind = AngleKind::Heading});
  heading.set_target(Vector::Constant(1, 3.0));
  turn("WST", -3.0);
  heading.update(robot_);
  EXPECT_NEAR(heading.value()[0], -3.0, tolerance(1e-14));
  EXPECT_NEAR(heading.error()[0], 2 * std::numbers::pi - 6.0, tolerance(1e-14));
  EXPECT_NEAR(heading.jacobian()(0, robot_.coordinate("WST")), 1.0, tolerance(1e-14));
}

TEST_F(ValuesOfTwin, NearTheVerticalTheElevationLetsGo) {
  AngleTask pitch("pitch", robot_, "fa_l", {.axis = {0, 0, -1}});
  double before = 0;
  for (const double tilt : {0.0, 0.005, 0.01, 0.015}) {  // inside the cone of 0.02
    turn("LSP", tilt);
    pitch.update(robot_);
    const double gain = pitch.jacobian()(0, robot_.coordinate("LSP"));
    EXPECT_NEAR(gain, tilt / 0.02, tolerance(1e-3));
    EXPECT_GE(gain, before);
    before = gain;
  }
}

TEST_F(ValuesOfTwin, ALeashSlowsTheTargetDownButNeverItsWayBack) {
  PositionTask hand("hand", robot_, "hand_l");
  const Vector3 start = hand.value(), speed(0.0, 0.1, 0.0);
  hand.advance(speed, 1e-3);
  EXPECT_TRUE(near(hand.velocity_des(), speed, 0.0));  // no maximum lead: anywhere
  hand.set_max_lead(0.1);
  const auto share = [&](double lead, double sign) {
    hand.set_target(start + Vector3(0.0, lead, 0.0));
    hand.update(robot_);
    const double before = hand.target()[1];
    hand.advance(sign * speed, 1e-3);
    EXPECT_NEAR(hand.target()[1] - before, hand.velocity_des()[1] * 1e-3, 1e-15);
    return sign * hand.velocity_des()[1] / speed[1];
  };
  EXPECT_EQ(share(0.0, 1.0), 1.0);
  EXPECT_NEAR(share(0.02, 1.0), 1.0, 1e-12);  // from a fifth on
  EXPECT_NEAR(share(0.06, 1.0), 0.5, 1e-12);
  EXPECT_NEAR(share(0.1, 1.0), 0.0, 1e-12);
  EXPECT_EQ(share(0.3, 1.0), 0.0);
  EXPECT_EQ(share(0.3, -1.0), 1.0);
  EXPECT_TRUE(contains(error_text([&] { hand.set_max_lead(0.0); }), "positive distance"));
}

TEST_F(ValuesOfTwin, UnknownFramesAreErrors) {
  EXPECT_TRUE(contains(error_text([&] { PositionTask("p", robot_, "hnad"); }), "frame 'hnad'"));
  EXPECT_TRUE(contains(error_text([&] { PositionTask("p", robot_, "hand_l", {.reference = "x"}); }),
                       "frame 'x'"));
}

}  // namespace

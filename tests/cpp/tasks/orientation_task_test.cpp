// Strategy: turns that a hand can compute; half a turn, where the error jumps, stays bounded.
#include "hurcules/tasks/orientation_task.hpp"

#include <cmath>
#include <numbers>

#include "hurcules/base/pose.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

TEST(OrientationTask, ErrorIsTheTurnInTheAxesOfTheWorld) {
  Robot robot(load_model_text(kTwin));
  OrientationTask task("hand", robot, "hand_l");
  Vector q = Vector::Zero(13);
  q[robot.coordinate("WST")] = 0.5;
  robot.set_configuration(q);
  task.update(robot);
  EXPECT_TRUE(near(task.error(), Vector3(0, 0, 0.5), 1e-14));
  task.set_target(rotation_exp(Vector3(0, 0, -0.2)));
  task.update(robot);
  EXPECT_TRUE(near(task.error(), Vector3(0, 0, 0.7), 1e-14));
}

TEST(OrientationTask, HandInHandDoesNotFeelTheWaist) {
  Robot robot(load_model_text(kTwin));
  OrientationTask task("hands", robot, "hand_l", {.reference = "hand_r"});
  Vector q = Vector::Zero(13);
  q[robot.coordinate("WST")] = 0.5;
  robot.set_configuration(q);
  task.update(robot);
  EXPECT_TRUE(near(task.error(), Vector3::Zero(), 1e-14));
}

TEST(OrientationTask, TargetTurnsForHoursAndStaysARotation) {
  Robot robot(load_model_text(kArm));
  OrientationTask task("tip", robot, "tip");
  for (int tick = 0; tick < 1000000; ++tick) task.advance(Vector3(0.3, -0.2, 0.5), 1e-3);
  const Matrix3 R = task.target();
  EXPECT_TRUE(near(R * R.transpose(), Matrix3::Identity(), 1e-12));
}

TEST(OrientationTask, HalfATurnIsBounded) {
  Robot robot(load_model_text(kArm));
  OrientationTask task("tip", robot, "tip");
  const Matrix3 R = task.orientation();
  for (const double less : {0.0, 1e-12, 1e-8, 1e-4}) {
    for (int axis = 0; axis < 3; ++axis) {
      task.set_target(rotation_exp((std::numbers::pi - less) * Vector3::Unit(axis)) * R);
      task.update(robot);
      EXPECT_NEAR(task.error().norm(), std::numbers::pi - less, tolerance(1e-7));
      EXPECT_LE(task.jacobian().cwiseAbs().maxCoeff(), 5.0);
    }
  }
}

TEST(OrientationTask, WhatIsNoRotationIsAnError) {
  Robot robot(load_model_text(kArm));
  OrientationTask task("tip", robot, "tip");
  EXPECT_TRUE(contains(error_text([&] { task.set_target(-Matrix3::Identity()); }), "'tip'"));
}

}  // namespace

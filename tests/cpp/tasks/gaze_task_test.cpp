// Strategy: targets at known yaw and pitch of the twin's head; the operator's command moves the
// target around the camera; targets above, behind and inside the camera stay bounded.
#include "hurcules/tasks/gaze_task.hpp"

#include <cmath>
#include <numbers>

#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class Gaze : public testing::Test {
 protected:
  void look_at(const Vector3& from_camera) {
    task_.set_target(camera_ + from_camera);
    task_.update(robot_);
  }
  Robot robot_{load_model_text(kTwin)};
  const Vector3 camera_ = robot_.position(robot_.frame("eye"));
  GazeTask task_{"gaze", robot_, "eye"};
};

TEST_F(Gaze, StartsWithATargetOneMetreAhead) {
  EXPECT_TRUE(near(task_.target(), camera_ + Vector3(1, 0, 0), 1e-14));
}

TEST_F(Gaze, ATargetToTheLeftMeansTheCameraLooksToTheRightOfIt) {
  look_at(Vector3(1, 1, 0));
  EXPECT_TRUE(near(task_.error(), Eigen::Vector2d(-std::numbers::pi / 4, 0), 1e-14));
  look_at(Vector3(1, 0, -1));
  EXPECT_TRUE(near(task_.error(), Eigen::Vector2d(0, std::numbers::pi / 4), 1e-14));
  // a turn of the neck to the left raises the yaw error
  EXPECT_GT(task_.jacobian()(0, robot_.coordinate("NKY")), 0.5);
}

TEST_F(Gaze, ASiteLooksAlongItsXAxis) {
  GazeTask site("gaze", robot_, "gaze");
  look_at(Vector3(2, 1, 0.5));
  site.set_target(task_.target());
  site.update(robot_);
  EXPECT_TRUE(near(site.error(), task_.error(), 1e-14));
  EXPECT_TRUE(near(site.jacobian(), task_.jacobian(), 1e-14));
}

TEST_F(Gaze, CommandMovesTheTargetAroundTheCamera) {
  look_at(Vector3(3, 0, 0));
  task_.advance(Eigen::Vector2d(0.1, -0.05), 2.0);
  const Vector3 seen = task_.target() - camera_;
  EXPECT_NEAR(seen.norm(), 3.0, tolerance(1e-14));
  EXPECT_NEAR(std::atan2(seen.y(), seen.x()), 0.2, tolerance(1e-14));
  EXPECT_NEAR(std::asin(seen.z() / 3), -0.1, tolerance(1e-14));
}

TEST_F(Gaze, CommandStopsAtTheZenith) {
  look_at(Vector3(1, 0, 10));
  for (int tick = 0; tick < 100; ++tick) task_.advance(Eigen::Vector2d(0, 1), 0.1);
  task_.update(robot_);
  EXPECT_NEAR(task_.error()[1], -std::numbers::pi / 2, tolerance(1e-6));
}

TEST_F(Gaze, HoldKeepsTheDistance) {
  look_at(Vector3(0, 3, 0));
  task_.hold(robot_);
  EXPECT_TRUE(near(task_.target(), camera_ + Vector3(3, 0, 0), 1e-14));
}

TEST_F(Gaze, ARelaxedTargetTurnsItsShareOfTheWayToTheLineOfSight) {
  const auto left = [](double yaw) { return Vector3(3 * std::cos(yaw), 3 * std::sin(yaw), 0); };
  look_at(left(0.4));
  task_.back_calculate(0.25);
  EXPECT_TRUE(near(task_.target(), camera_ + left(0.3), 1e-14));
}

TEST_F(Gaze, OddTargetsStayBounded) {
  robot_.set_velocity(Vector::Ones(13));
  for (const Vector3& target : {Vector3(0, 0, 1), Vector3(0, 0, -1), Vector3(-1, 0, 0),
                                Vector3(0, 0, 0), Vector3(1e-9, 0, 0), Vector3(1e-9, 0, 1)}) {
    look_at(target);
    EXPECT_TRUE(task_.error().allFinite());
    EXPECT_TRUE(task_.drift().allFinite());
    EXPECT_TRUE(task_.jacobian().allFinite());
    EXPECT_LE(task_.jacobian().cwiseAbs().maxCoeff(), 200.0);
  }
  EXPECT_FALSE(error_text([&] { task_.set_target(Vector3(std::nan(""), 0, 0)); }).empty());
}

}  // namespace

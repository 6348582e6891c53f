// Strategy: a forearm that points forward from a bent elbow, swivelled by a known angle about the
// line from shoulder to wrist; the straight arm and the lost reference stay bounded.
#include "hurcules/tasks/swivel_task.hpp"

#include <cmath>
#include <numbers>

#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kPi = std::numbers::pi;

// The arm hangs on a hinge along x through its shoulder; the elbow is below that hinge and the
// wrist on it, so the hinge turns the plane of the arm about the line from shoulder to wrist.
constexpr const char* kBentArm = R"(
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="torso"><joint name="waist" axis="0 0 1"/><geom size="0.1"/>
      <body name="shoulder" pos="0 0 0.5"><joint name="swing" axis="1 0 0"/><geom size="0.1"/>
        <body name="upper" pos="0.3 0 -0.3"><joint name="lift" axis="0 -1 0"/><geom size="0.1"/>
          <site name="elbow"/><site name="wrist" pos="0.3 0 0.3"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>)";

class Swivel : public testing::Test {
 protected:
  void stand(double waist, double swing, double lift) {
    robot_.set_configuration(Vector3(waist, swing, lift));
    task_.update(robot_);
  }
  static SwivelTaskOptions options() { return {"shoulder", "elbow", "wrist", "torso"}; }
  Robot robot_{load_model_text(kBentArm)};
  SwivelTask task_{"swivel", robot_, options()};
};

TEST_F(Swivel, IsTheTurnAboutTheLineFromShoulderToWrist) {
  for (const double angle : {0.0, 0.4, kPi / 2, -2.5, 3.1}) {
    stand(0, angle, 0);
    EXPECT_NEAR(task_.value()[0], angle, tolerance(1e-13));
    EXPECT_NEAR(task_.jacobian()(0, 1), 1.0, tolerance(1e-13));
  }
}

TEST_F(Swivel, DoesNotFeelTheWaist) {
  stand(1.1, 0.4, 0);
  EXPECT_NEAR(task_.value()[0], 0.4, tolerance(1e-13));
  EXPECT_NEAR(task_.jacobian()(0, 0), 0.0, tolerance(1e-13));
}

TEST_F(Swivel, ErrorGoesTheShortWayRound) {
  stand(0, 3.0, 0);
  task_.set_target(Vector::Constant(1, -3.0));
  task_.update(robot_);
  EXPECT_NEAR(task_.error()[0], 6.0 - 2 * kPi, tolerance(1e-13));
}

TEST_F(Swivel, TheStraightArmLetsGo) {
  robot_.set_velocity(Vector3(1, 1, 1));
  // lifting by -pi/2 puts elbow and wrist on one line from the shoulder
  for (const double bend : {0.1, 0.03, 0.01, 1e-3, 1e-6, 1e-12, 0.0}) {
    stand(0, 0.4, -kPi / 2 + bend);
    EXPECT_TRUE(task_.error().allFinite());
    EXPECT_TRUE(task_.drift().allFinite());
    EXPECT_LE(task_.jacobian().cwiseAbs().maxCoeff(), 50.0) << bend;
  }
  EXPECT_LE(task_.jacobian().cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Swivel, AReferenceAlongTheArmLetsGo) {
  SwivelTaskOptions along = options();
  along.direction = Vector3::UnitX();
  SwivelTask task("swivel", robot_, along);
  EXPECT_TRUE(task.error().allFinite());
  EXPECT_LE(task.jacobian().cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Swivel, MissingFramesAndDirectionsAreErrors) {
  SwivelTaskOptions wrong = options();
  wrong.wrist = "";
  EXPECT_TRUE(contains(error_text([&] { SwivelTask("s", robot_, wrong); }), "frame ''"));
  wrong = options();
  wrong.direction.setZero();
  EXPECT_TRUE(contains(error_text([&] { SwivelTask("s", robot_, wrong); }), "not zero"));
}

}  // namespace

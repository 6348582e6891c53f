// Strategy: excess and tilt of made-up states, by hand.
#include "hurcules/sim/watch.hpp"

#include <Eigen/Geometry>
#include <limits>

#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

TEST(LimitWatch, KeepsTheWorstExcessOfEachKind) {
  const Robot robot(load_model_text(kPendulum));  // no velocity limits
  TelemetryNames names;
  names.coordinates = robot.coordinate_names();
  names.joints = {"slide"};
  Telemetry t(names);
  LimitWatch watch(robot, Vector::Constant(1, 5.0));
  t.limit_lower << -1.0, -std::numeric_limits<double>::infinity();
  t.limit_upper << 2.0, std::numeric_limits<double>::infinity();
  t.q << 2.0, 100.0;
  t.torque << -5.0;
  watch.look(t);
  EXPECT_EQ(watch.measured().position, 0.0);
  EXPECT_EQ(watch.measured().torque, 0.0);
  t.q << -1.25, 0.0;
  t.q_des << 2.5, 0.0;
  t.demand << 7.0;
  watch.look(t);
  t.q << 0.0, 0.0;
  watch.look(t);
  EXPECT_DOUBLE_EQ(watch.measured().position, 0.25);
  EXPECT_DOUBLE_EQ(watch.commanded().position, 0.5);
  EXPECT_DOUBLE_EQ(watch.commanded().torque, 2.0);
  EXPECT_EQ(watch.measured().velocity, 0.0);
  watch.reset();
  EXPECT_EQ(watch.commanded().torque, 0.0);
}

TEST(FallWatch, SeesTiltAgainstItsStartButNoTurnOnTheSpot) {
  FallWatch watch({0.2, 0.35});
  const Matrix3 start(Eigen::AngleAxisd(3.0, Vector3::UnitY()));  // a leg lies upside down
  watch.reset(start);
  const Matrix3 turned = Eigen::AngleAxisd(2.0, Vector3::UnitZ()) * start;
  EXPECT_NEAR(watch.tilt(turned), 0.0, 1e-7);
  EXPECT_FALSE(watch.fell(turned, 0.5));
  const Matrix3 tipped = Eigen::AngleAxisd(0.4, Vector3::UnitX()) * turned;
  EXPECT_NEAR(watch.tilt(tipped), 0.4, 1e-9);
  EXPECT_TRUE(watch.fell(tipped, 0.5));
}

TEST(FallWatch, SeesAPelvisThatIsTooLow) {
  FallWatch watch({0.2, 0.35});
  watch.reset(Matrix3::Identity());
  EXPECT_FALSE(watch.fell(Matrix3::Identity(), 0.21));
  EXPECT_TRUE(watch.fell(Matrix3::Identity(), 0.19));
}

}  // namespace

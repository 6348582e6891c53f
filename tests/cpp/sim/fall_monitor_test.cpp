// Strategy: tilts and heights of made-up states, by hand.
#include "hurcules/sim/fall_monitor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace {

using namespace hurcules;

TEST(FallMonitor, SeesTiltAgainstItsStartButNoTurnOnTheSpot) {
  FallMonitor monitor({0.2, 0.35});
  const Matrix3 start(Eigen::AngleAxisd(3.0, Vector3::UnitY()));  // a leg lies upside down
  monitor.reset(start);
  const Matrix3 turned = Eigen::AngleAxisd(2.0, Vector3::UnitZ()) * start;
  EXPECT_NEAR(monitor.tilt(turned), 0.0, 1e-7);
  EXPECT_FALSE(monitor.fell(turned, 0.5));
  const Matrix3 tipped = Eigen::AngleAxisd(0.4, Vector3::UnitX()) * turned;
  EXPECT_NEAR(monitor.tilt(tipped), 0.4, 1e-9);
  EXPECT_TRUE(monitor.fell(tipped, 0.5));
}

TEST(FallMonitor, SeesAPelvisThatIsTooLow) {
  FallMonitor monitor({0.2, 0.35});
  monitor.reset(Matrix3::Identity());
  EXPECT_FALSE(monitor.fell(Matrix3::Identity(), 0.21));
  EXPECT_TRUE(monitor.fell(Matrix3::Identity(), 0.19));
}

TEST(FallMonitor, MeasuresHeightAlongTheSupportOnARamp) {
  FallMonitor monitor({0.2, 0.35});
  const Matrix3 start(Eigen::AngleAxisd(3.0, Vector3::UnitY()));
  monitor.reset(start);
  const Matrix3 ramp(Eigen::AngleAxisd(-0.3, Vector3::UnitY()));
  const Vector3 seat(-0.5, 0.0, 0.28);
  EXPECT_NEAR(monitor.height(start, seat), 0.28, 1e-12);
  EXPECT_NEAR(monitor.height(ramp * start, ramp * seat), 0.28, 1e-12);
}

TEST(FallMonitor, SaysWhichBoundWasPassed) {
  FallMonitor monitor({0.2, 0.35});
  monitor.reset(Matrix3::Identity());
  EXPECT_EQ(monitor.text(Matrix3::Identity(), 0.125), "0.125 m high, at least 0.2");
  const Matrix3 tipped(Eigen::AngleAxisd(0.5, Vector3::UnitX()));
  EXPECT_EQ(monitor.text(tipped, 0.5), "tilted by 0.500 rad, at most 0.35");
}

}  // namespace

// Strategy: boundss and velocities by hand.
#include "hurcules/control/torque_scaling.hpp"

#include <limits>

#include "support/expect.hpp"

namespace {

using namespace hurcules;

constexpr double kNone = std::numeric_limits<double>::infinity();

Vector three(double a, double b, double c) {
  return (Vector(3) << a, b, c).finished();
}

TEST(TorqueScaling, LeavesAVelocityWithinAsItIs) {
  const VelocityBounds bounds = {three(-1.0, -kNone, -0.3), three(1.0, kNone, 0.3)};
  Vector velocity = three(1.0, 1e9, -0.3);
  EXPECT_FALSE(scale_velocity(bounds, velocity));
  EXPECT_EQ(velocity, three(1.0, 1e9, -0.3));
}

TEST(TorqueScaling, SlowsAllDownTogetherKeepingTheDirection) {
  const VelocityBounds bounds = {three(-1.0, -kNone, -0.3), three(1.0, kNone, 0.1)};
  Vector velocity = three(0.5, 2.0, 0.4);
  EXPECT_TRUE(scale_velocity(bounds, velocity));
  EXPECT_TRUE(velocity.isApprox(three(0.125, 0.5, 0.1), 1e-15));
}

TEST(TorqueScaling, StandsAndFollowsThePushWhereItIsPushedHarder) {
  const VelocityBounds bounds = {three(-1.0, -kNone, -3.0), three(1.0, kNone, -0.2)};
  Vector velocity = three(0.5, 2.0, 0.4);
  EXPECT_TRUE(scale_velocity(bounds, velocity));
  EXPECT_EQ(velocity, three(0.0, 0.0, -0.2));
}

TEST(TorqueScaling, NeverHoldsAMotionThatLeadsBackFastEnough) {
  const VelocityBounds bounds = {three(-1.0, -kNone, -3.0), three(1.0, kNone, -0.2)};
  Vector velocity = three(0.5, 2.0, -0.25);
  EXPECT_FALSE(scale_velocity(bounds, velocity));
  EXPECT_EQ(velocity, three(0.5, 2.0, -0.25));
}

}  // namespace

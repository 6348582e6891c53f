// Strategy: bounds, rows and velocities by hand.
#include "hurcules/control/torque_scaling.hpp"

#include <limits>

#include "support/expect.hpp"

namespace {

using namespace hurcules;

constexpr double kNone = std::numeric_limits<double>::infinity();

Vector three(double a, double b, double c) {
  return (Vector(3) << a, b, c).finished();
}

// one row that holds the coordinates of these factors together
Level row(const Vector& factors, double lower, double upper) {
  Level level;
  level.A = factors.transpose();
  level.lower = Vector::Constant(1, lower);
  level.upper = Vector::Constant(1, upper);
  return level;
}

bool scale_velocity(const VelocityBounds& bounds, VectorRef velocity) {
  TorqueScaling scaling(3);
  return scaling.apply(bounds, {row(three(1.0, 1.0, 1.0), 0.0, 0.0)}, three(0.0, 0.0, 0.0),
                       velocity);
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

TEST(TorqueScaling, HoldsUpNoneThatNoTaskTies) {
  const VelocityBounds bounds = {three(-kNone, -kNone, -0.5), three(kNone, kNone, 0.0)};
  const Hierarchy hand_and_finger = {row(three(2.0, 1.0, 0.0), 0.7, 0.7),
                                     row(three(0.0, 0.0, 1.0), 0.1, 0.1)};
  const Vector x = three(0.3, 0.1, 0.1);
  TorqueScaling scaling(3);
  Vector velocity = x;
  EXPECT_TRUE(scaling.apply(bounds, hand_and_finger, x, velocity));
  EXPECT_EQ(velocity, three(0.3, 0.1, 0.0));
}

TEST(TorqueScaling, HoldsUpWhatAnActiveLimitTies) {
  const VelocityBounds bounds = {three(-kNone, -kNone, -0.5), three(kNone, kNone, 0.05)};
  const Vector x = three(0.3, 0.1, 0.1);
  for (const bool active : {false, true}) {  // x_1 + x_3 = 0.4
    const Hierarchy limit = {row(three(1.0, 0.0, 1.0), -1.0, active ? 0.4 : 0.41)};
    TorqueScaling scaling(3);
    Vector velocity = x;
    EXPECT_TRUE(scaling.apply(bounds, limit, x, velocity));
    EXPECT_EQ(velocity, active ? three(0.15, 0.1, 0.05) : three(0.3, 0.1, 0.05));
  }
}

}  // namespace

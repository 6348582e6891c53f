// Strategy: windows and velocities by hand.
#include "hurcules/control/yielding.hpp"

#include <limits>

#include "support/expect.hpp"

namespace {

using namespace hurcules;

constexpr double kNone = std::numeric_limits<double>::infinity();

Vector three(double a, double b, double c) {
  return (Vector(3) << a, b, c).finished();
}

TEST(Yielding, LeavesAVelocityWithinAsItIs) {
  const RateWindow window = {three(-1.0, -kNone, -0.3), three(1.0, kNone, 0.3)};
  Vector velocity = three(1.0, 1e9, -0.3);
  EXPECT_FALSE(give_way(window, velocity));
  EXPECT_EQ(velocity, three(1.0, 1e9, -0.3));
}

TEST(Yielding, SlowsAllDownTogetherKeepingTheDirection) {
  const RateWindow window = {three(-1.0, -kNone, -0.3), three(1.0, kNone, 0.1)};
  Vector velocity = three(0.5, 2.0, 0.4);
  EXPECT_TRUE(give_way(window, velocity));
  EXPECT_TRUE(velocity.isApprox(three(0.125, 0.5, 0.1), 1e-15));
}

TEST(Yielding, StandsAndFollowsThePushWhereItIsPushedHarder) {
  const RateWindow window = {three(-1.0, -kNone, -3.0), three(1.0, kNone, -0.2)};
  Vector velocity = three(0.5, 2.0, 0.4);
  EXPECT_TRUE(give_way(window, velocity));
  EXPECT_EQ(velocity, three(0.0, 0.0, -0.2));
}

TEST(Yielding, NeverHoldsAMotionThatLeadsBackFastEnough) {
  const RateWindow window = {three(-1.0, -kNone, -3.0), three(1.0, kNone, -0.2)};
  Vector velocity = three(0.5, 2.0, -0.25);
  EXPECT_FALSE(give_way(window, velocity));
  EXPECT_EQ(velocity, three(0.5, 2.0, -0.25));
}

}  // namespace

// Strategy: the generator against published numbers and simple statistics; the variation against
// its bounds.
#include "hurcules/mission/variation.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

TEST(Random, GivesTheSameNumbersForASeedAndOthersForAnother) {
  Random a(5), b(5), c(6);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t value = a.next();
    EXPECT_EQ(value, b.next());
    EXPECT_NE(value, c.next());
  }
}

TEST(Random, IsUniformOverItsInterval) {
  Random random(1);
  double sum = 0.0, square = 0.0;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double x = random.symmetric();
    ASSERT_GE(x, -1.0);
    ASSERT_LT(x, 1.0);
    sum += x;
    square += x * x;
  }
  EXPECT_NEAR(sum / n, 0.0, 0.01);
  EXPECT_NEAR(square / n, 1.0 / 3.0, 0.01);
}

TEST(Variation, MovesACasualtyWithinThreeCentimetresAndTurnsItAboutTheVertical) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    Vector pose(7);
    pose << 1.0, 2.0, 0.3, 0.5, -0.5, -0.5, -0.5;
    const Eigen::Quaterniond before(0.5, -0.5, -0.5, -0.5);
    vary_place({}, random, pose);
    EXPECT_LE(std::abs(pose[0] - 1.0), 0.03);
    EXPECT_LE(std::abs(pose[1] - 2.0), 0.03);
    EXPECT_EQ(pose[2], 0.3);
    const Eigen::Quaterniond after(pose[3], pose[4], pose[5], pose[6]);
    const Eigen::AngleAxisd turn(after * before.inverse());
    EXPECT_LE(turn.angle(), 0.05 + 1e-9);
    // the turn has no part about a horizontal axis
    EXPECT_NEAR(turn.angle() * turn.axis().head<2>().norm(), 0.0, 1e-9);
  }
}

TEST(Variation, OfScaleZeroChangesNothing) {
  Random random(3);
  Variation none;
  none.scale = 0.0;
  Vector q = Vector::Constant(4, 0.5);
  const Vector lower = Vector::Zero(4), upper = Vector::Ones(4);
  vary_posture(none, random, {lower, upper}, q);
  EXPECT_EQ(q, Vector::Constant(4, 0.5));
}

TEST(Variation, KeepsThePostureWithinItsLimits) {
  Random random(4);
  const Vector lower = Vector::Zero(3), upper = Vector::Ones(3);
  for (int i = 0; i < 1000; ++i) {
    Vector q(3);
    q << 0.0, 1.0, 0.5;
    vary_posture({}, random, {lower, upper}, q);
    EXPECT_GE(q.minCoeff(), 0.0);
    EXPECT_LE(q.maxCoeff(), 1.0);
    EXPECT_LE(std::abs(q[2] - 0.5), 0.002);
  }
}

}  // namespace

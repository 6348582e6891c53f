// Strategy: targets drawn at random moments; the samples themselves tell acceleration and jerk.
#include "hurcules/control/speed_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "support/random_motion.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kDt = 1e-3;
constexpr SpeedLimits kLimits{2.0, 8.0};

TEST(SpeedProfile, KeepsItsLimitsWhateverTheTargetDoes) {
  SpeedProfile profile(kLimits, kDt);
  RandomMotion random(3);
  double target = 0.0, before = 0.0, acceleration_before = 0.0;
  for (int i = 0; i < 50000; ++i) {
    if (i % 700 == 0) target = random.uniform(-5.0, 5.0);
    const double speed = profile.advance(target);
    const double acceleration = (speed - before) / kDt;
    ASSERT_LE(std::abs(acceleration), kLimits.acceleration + 1e-9) << i;
    // arriving, the last step may be shorter than the jerk asks for: one step of it more
    ASSERT_LE(std::abs(acceleration - acceleration_before), 2.0 * kLimits.jerk * kDt + 1e-9) << i;
    before = speed;
    acceleration_before = acceleration;
  }
}

TEST(SpeedProfile, ArrivesWithoutOvershootInTheTimeOfTheory) {
  SpeedProfile profile(kLimits, kDt);
  double most = 0.0;
  int samples = 0;
  while (!(profile.speed() == 5.0 && profile.acceleration() == 0.0) && samples < 10000) {
    most = std::max(most, profile.advance(5.0));
    ++samples;
  }
  EXPECT_EQ(most, 5.0);
  // v / a + a / j
  EXPECT_NEAR(samples * kDt, 5.0 / 2.0 + 2.0 / 8.0, 0.02);
}

TEST(SpeedProfile, SmallStepsNeverReachFullAcceleration) {
  SpeedProfile profile(kLimits, kDt);
  double most = 0.0;
  int samples = 0;
  while (profile.speed() != 0.02) {
    profile.advance(0.02);
    most = std::max(most, profile.acceleration());
    ASSERT_LT(++samples, 1000);
  }
  // half way up, half way down: a^2 / j = step
  EXPECT_NEAR(most, std::sqrt(0.02 * kLimits.jerk), 0.03);
  EXPECT_TRUE(std::abs(samples * kDt - 2.0 * std::sqrt(0.02 / kLimits.jerk)) < 0.02);
}

TEST(SpeedProfile, RefusesNumbersThatAreNotAboveZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SpeedProfile({0.0, 1.0}, kDt), Error);
  EXPECT_THROW(SpeedProfile({1.0, nan}, kDt), Error);
  EXPECT_THROW(SpeedProfile({1.0, 1.0}, -kDt), Error);
}

}  // namespace

// Strategy: one coordinate alone, driven against its limits as hard as the interval allows, from
// seeded random states: never over a limit, never over velocity or acceleration where a state could
// brake in time, never an empty interval. Not tested here: what a solver does with it.
#include "hurcules/control/rate_interval.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "support/expect.hpp"
#include "support/usual_limits.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kInf = std::numeric_limits<double>::infinity();

RateInterval at(double q, double velocity, const RateLimits& limits) {
  return rate_interval({-1.0 - q, 1.0 - q, velocity}, limits);
}

TEST(RateInterval, NearALimitIsDistanceOverHorizon) {
  const RateInterval interval = at(0.99, 0.2, usual());
  EXPECT_NEAR(interval.upper, 0.01 / 0.05, tolerance(1e-12));
  EXPECT_TRUE(interval.upper_is_limit);
  EXPECT_FALSE(interval.lower_is_limit);
}

TEST(RateInterval, FarFromALimitIsVelocityAndAcceleration) {
  const RateInterval interval = at(0.0, 0.5, usual());
  EXPECT_DOUBLE_EQ(interval.upper, 0.5 + 20.0 * 1e-3);
  EXPECT_DOUBLE_EQ(interval.lower, 0.5 - 20.0 * 1e-3);
  EXPECT_FALSE(interval.upper_is_limit);
  EXPECT_DOUBLE_EQ(at(0.0, 1.99, usual()).upper, 2.0);
}

TEST(RateInterval, WithoutAnyLimitIsUnbounded) {
  RateLimits none = usual();
  none.max_velocity = none.max_acceleration = kInf;
  const RateInterval interval = rate_interval({-kInf, kInf, 0.3}, none);
  EXPECT_EQ(interval.lower, -kInf);
  EXPECT_EQ(interval.upper, kInf);
}

TEST(RateInterval, DrivesBackFromOutsideAtABoundedSpeed) {
  const RateInterval far = at(1.5, 0.0, usual());
  EXPECT_DOUBLE_EQ(far.upper, -0.2);
  const RateInterval close = at(1.001, 0.0, usual());
  EXPECT_NEAR(close.upper, -0.001 / 0.05, tolerance(1e-12));
  const RateInterval below = at(-1.5, 0.0, usual());
  EXPECT_DOUBLE_EQ(below.lower, 0.2);
}

TEST(RateInterval, BrakesForASpeedLimitThatWasLowered) {
  RateLimits limits = usual();
  limits.max_velocity = 0.1;
  limits.max_acceleration = 20.0;
  for (const double side : {-1.0, 1.0}) {
    const RateInterval interval = rate_interval({-10.0, 10.0, side * 0.99}, limits);
    EXPECT_NEAR(side > 0.0 ? interval.upper : interval.lower, side * 0.97, tolerance(1e-12));
    EXPECT_NEAR(side > 0.0 ? interval.lower : interval.upper, side * 0.97, tolerance(1e-12));
  }
}

TEST(RateInterval, IsNeverEmptyWhateverTheState) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int i = 0; i < 20000; ++i) {
    RateLimits limits = usual();
    limits.max_velocity = i % 3 ? std::abs(any(generator)) : kInf;
    limits.max_acceleration = i % 5 ? 1e-3 + 10.0 * std::abs(any(generator)) : kInf;
    limits.horizon = 1e-3 + std::abs(any(generator));
    const double lower = any(generator), upper = lower + (i % 7 ? std::abs(any(generator)) : 0.0);
    const double q = any(generator);
    const RateState state{lower - q, upper - q, 3.0 * any(generator)};
    const RateInterval interval = rate_interval(state, limits);
    ASSERT_LE(interval.lower, interval.upper) << i;
    // a coordinate that is faster, the limit having been lowered, brakes
    const double fast = std::abs(state.velocity) - limits.max_acceleration * limits.dt;
    const double most = std::max(limits.max_velocity, fast);
    ASSERT_LE(interval.upper, most) << i;
    ASSERT_GE(interval.lower, -most) << i;
    // one step never leaves the range from inside
    if (q >= lower && q <= upper) {
      ASSERT_LE(q + interval.upper * limits.dt, upper + 1e-15) << i;
      ASSERT_GE(q + interval.lower * limits.dt, lower - 1e-15) << i;
    }
  }
}

// accelerates towards the upper limit as hard as it may, turns at random
TEST(RateInterval, BrakesInTimeWithTheAccelerationThatItHas) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 40; ++run) {
    RateLimits limits = usual();
    limits.max_velocity = 0.1 + 5.0 * share(generator);
    limits.max_acceleration = 1.0 + 30.0 * share(generator);
    limits.horizon = 0.002 + 0.2 * share(generator);
    double q = 2.0 * share(generator) - 1.0, velocity = 0.0, side = 1.0;
    for (int tick = 0; tick < 4000; ++tick) {
      if (share(generator) < 0.002) side = -side;
      const RateInterval interval = at(q, velocity, limits);
      const double next = side > 0.0 ? interval.upper : interval.lower;
      ASSERT_LE(std::abs(next - velocity), limits.max_acceleration * limits.dt * (1.0 + 1e-9))
          << "run " << run << " tick " << tick;
      velocity = next;
      q += velocity * limits.dt;
      ASSERT_LE(std::abs(q), 1.0 + 1e-14) << "run " << run << " tick " << tick;
    }
  }
}

}  // namespace

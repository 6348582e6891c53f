// Strategy: one coordinate alone, driven against its limits as hard as the interval allows and with
// turns at random: R26 at every step, with braking in time; never an empty interval; what it does
// from outside its range; the printed bound [T 5.6.52-53] beside it, which cannot be kept. Not
// tested here: what a solver does with it.
#include "hurcules/control/acceleration_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/expect.hpp"
#include "support/usual_limits.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kInf = std::numeric_limits<double>::infinity();

// a coordinate between -1 and 1
struct Coordinate1 {
  double q = 0.0, v = 0.0;
  [[nodiscard]] AccelerationInterval interval(const RateLimits& limits) const {
    return acceleration_interval({-1.0 - q, 1.0 - q, v}, limits);
  }
  void step(double u, double dt) {
    q += v * dt + 0.5 * u * dt * dt;
    v += u * dt;
  }
};

TEST(AccelerationInterval, FarFromLimitsIsAccelerationAndVelocity) {
  const AccelerationInterval free = Coordinate1{0.0, 0.5}.interval(usual());
  EXPECT_EQ(free.lower, -20.0);
  EXPECT_EQ(free.upper, 20.0);
  EXPECT_FALSE(free.upper_is_limit);
  EXPECT_NEAR((Coordinate1{0.0, 1.99}.interval(usual()).upper), 10.0, tolerance(1e-9));
}

TEST(AccelerationInterval, WithoutAnyLimitIsUnbounded) {
  RateLimits none = usual();
  none.max_velocity = none.max_acceleration = kInf;
  const AccelerationInterval free = acceleration_interval({-kInf, kInf, 0.3}, none);
  EXPECT_EQ(free.lower, -kInf);
  EXPECT_EQ(free.upper, kInf);
}

TEST(AccelerationInterval, NearALimitTheSpeedFadesWithTheHorizon) {
  Coordinate1 one{0.98, 0.4};  // at distance / horizon
  for (int i = 0; i < 100; ++i) one.step(one.interval(usual()).upper, 1e-3);
  EXPECT_NEAR(one.q, 1.0 - 0.02 * std::exp(-0.1 / 0.05), 1e-5);
  EXPECT_TRUE(one.interval(usual()).upper_is_limit);
}

TEST(AccelerationInterval, BrakesInTimeWhateverIsAsked) {
  // R26: q + v dt + u dt^2 / 2 inside at every step, |u| and |v| within theirs
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 60; ++run) {
    RateLimits limits = usual();
    limits.max_velocity = 0.1 + 5.0 * share(generator);
    limits.max_acceleration = 1.0 + 30.0 * share(generator);
    limits.horizon = 0.001 + 0.2 * share(generator);
    Coordinate1 one{2.0 * share(generator) - 1.0, 0.0};
    double side = 1.0;
    for (int tick = 0; tick < 4000; ++tick) {
      if (share(generator) < 0.002) side = -side;
      const AccelerationInterval interval = one.interval(limits);
      ASSERT_LE(interval.lower, interval.upper) << "run " << run << " tick " << tick;
      const double u = side > 0.0 ? interval.upper : interval.lower;
      ASSERT_LE(std::abs(u), limits.max_acceleration) << "run " << run << " tick " << tick;
      one.step(u, limits.dt);
      ASSERT_LE(std::abs(one.q), 1.0 + 1e-13) << "run " << run << " tick " << tick;
      ASSERT_LE(std::abs(one.v), limits.max_velocity + 1e-12) << "run " << run << " tick " << tick;
    }
  }
}

TEST(AccelerationInterval, ThePrintedBoundAloneCannotBeKept) {
  // [T 5.6.53]: at 2 rad/s towards the limit it allows the full speed until one step before, then
  // asks for 2000 rad/s^2 and more
  const double dt = 1e-3;
  double q = 0.0, v = 2.0, worst = 0.0;
  for (int i = 0; i < 600; ++i) {
    const double u = std::min(0.0, 2.0 / (dt * dt) * (1.0 - q - v * dt));
    worst = std::min(worst, u);
    q += v * dt + 0.5 * u * dt * dt;
    v += u * dt;
  }
  EXPECT_LT(worst, -1000.0);
}

TEST(AccelerationInterval, IsNeverEmptyNorBeyondTheAccelerationWhateverTheState) {
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
    const AccelerationInterval interval = acceleration_interval(state, limits);
    ASSERT_LE(interval.lower, interval.upper) << i;
    ASSERT_LE(interval.upper, limits.max_acceleration) << i;
    ASSERT_GE(interval.lower, -limits.max_acceleration) << i;
  }
}

TEST(AccelerationInterval, ComesBackFromOutsideAtItsReturnSpeed) {
  Coordinate1 one{1.3, 0.0};
  double fastest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    one.step(one.interval(usual()).upper, 1e-3);
    fastest = std::max(fastest, std::abs(one.v));
  }
  EXPECT_NEAR(fastest, 0.2, 1e-9);
  EXPECT_NEAR(one.q, 1.0, 1e-6);
}

}  // namespace

// Strategy: two joints whose readings the test makes up: one follows coordinate 0 with factor -2,
// the other has no coordinate.
#include "hurcules/sim/sensor_monitor.hpp"

#include <cmath>

#include "support/expect.hpp"

namespace {

using namespace hurcules;
using Trouble = SensorMonitor::Trouble;

constexpr double kPeriod = 0.001;

class SensorMonitorTest : public testing::Test {
 protected:
  // a tick in which the coordinate goes on at `speed`; the encoders say what `said` makes of it
  template <typename Said>
  SensorMonitor::Finding tick(double speed, Said&& said) {
    q_[0] += kPeriod * speed;
    position_ << -2.0 * q_[0], 1.0;
    speed_ << -2.0 * speed, 0.0;
    said(position_, speed_);
    return monitor_.look(position_, speed_, q_);
  }
  template <typename Said>
  int ticks_until_trouble(double speed, Said&& said, int most = 2000) {
    for (int i = 0; i < most; ++i) {
      found_ = tick(speed, said);
      if (found_.trouble != Trouble::None) return i;
    }
    return most;
  }

  SensorMonitor monitor_{{{0, -2.0}, {}}, kPeriod};
  Vector q_ = Vector::Zero(1), position_ = Vector::Zero(2), speed_ = Vector::Zero(2);
  SensorMonitor::Finding found_;
};

TEST_F(SensorMonitorTest, BelievesAJointThatFollowsAndOneThatRests) {
  EXPECT_EQ(ticks_until_trouble(0.3, [](Vector&, Vector&) {}), 2000);
  EXPECT_EQ(ticks_until_trouble(0.0, [](Vector&, Vector&) {}), 2000);
}

TEST_F(SensorMonitorTest, FindsANumberThatIsNone) {
  tick(0.1, [](Vector&, Vector&) {});
  found_ = tick(0.1, [](Vector& p, Vector&) { p[1] = NAN; });
  EXPECT_EQ(found_.trouble, Trouble::NotANumber);
  EXPECT_EQ(found_.entry, 1);
  EXPECT_FALSE(found_.speed);
  found_ = tick(0.1, [](Vector&, Vector& v) { v[0] = INFINITY; });
  EXPECT_EQ(found_.trouble, Trouble::NotANumber);
  EXPECT_TRUE(found_.speed);
}

TEST_F(SensorMonitorTest, FindsAnEncoderThatStandsStillWhileItsReferenceMoves) {
  // 15 mrad at 2 x 0.1 rad/s: 75 ms
  const int ticks = ticks_until_trouble(0.1, [](Vector& p, Vector& v) { p[0] = v[0] = 0.0; });
  EXPECT_EQ(found_.trouble, Trouble::Stuck);
  EXPECT_EQ(found_.entry, 0);
  EXPECT_NEAR(ticks, 75, 2);
}

TEST_F(SensorMonitorTest, FindsASpeedThatDisagreesWithThePosition) {
  // 20 mrad in the window of 100 ms, of which 15 are allowed
  ticks_until_trouble(0.1, [](Vector&, Vector& v) { v[0] = 0.0; });
  EXPECT_EQ(found_.trouble, Trouble::Disagrees);
  // half as much is less than that
  monitor_.reset();
  EXPECT_EQ(ticks_until_trouble(0.05, [](Vector&, Vector& v) { v[0] = 0.0; }), 2000);
}

TEST_F(SensorMonitorTest, GoesOnTheSameAfterARestore) {
  const auto dead = [](Vector& p, Vector& v) { p[0] = v[0] = 0.0; };
  for (int i = 0; i < 40; ++i) tick(0.1, dead);
  std::vector<double> state;
  StateWriter writer(state);
  monitor_.save(writer);
  SensorMonitor other({{0, -2.0}, {}}, kPeriod);
  StateReader reader(state);
  other.restore(reader);
  EXPECT_TRUE(reader.at_end());
  monitor_ = other;
  EXPECT_NEAR(ticks_until_trouble(0.1, dead), 35, 2);
}

}  // namespace

// Strategy: the equations of the header as balances, the ends (empty, full, more than there is),
// and a snapshot. What a mission needs is in drive_power_test.cpp.
#include "hurcules/sim/battery.hpp"

#include <cmath>

#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

const BatteryOptions kSmall = {.capacity = 1e4, .voltage = 50.0, .resistance = 0.1};

TEST(Battery, GivesTheCurrentAtWhichTheLoadGetsItsPower) {
  const Battery battery(kSmall);
  for (const double power : {-2000.0, 0.0, 1e-6, 500.0, 6000.0}) {
    const double I = battery.current(power);
    EXPECT_NEAR(I * 50.0 - I * I * 0.1, power, 1e-9 * std::abs(power));
    EXPECT_LE(I, 50.0 / (2.0 * 0.1));  // the smaller root
  }
  EXPECT_NEAR(battery.current(6250.0), 250.0, 1e-9);  // U^2 / (4 R)
  EXPECT_EQ(battery.current(1e6), battery.current(battery.max_power()));
}

TEST(Battery, LosesWhatTheLoadGetsAndWhatItsResistanceBurns) {
  Battery battery(kSmall);
  for (int i = 0; i < 3000; ++i) battery.draw(1000.0 * std::sin(0.01 * i), 1e-3);
  EXPECT_NEAR(kSmall.capacity - battery.energy(), battery.delivered() + battery.lost(), 1e-9);
  double delivered = 0.0;
  for (int i = 0; i < 3000; ++i) delivered += std::sin(0.01 * i);
  EXPECT_NEAR(battery.delivered(), delivered, 1e-9);  // it was never full nor empty
  EXPECT_GT(battery.lost(), 0.0);
}

TEST(Battery, IsEmptyWhenItsEnergyIsGoneAndGivesNoMore) {
  Battery battery({.capacity = 1e4, .voltage = 50.0, .resistance = 0.0});
  int ticks = 0;
  for (; !battery.empty() && ticks < 100000; ++ticks) battery.draw(400.0, 1e-3);
  EXPECT_NEAR(1e-3 * ticks, 25.0, 2e-3);  // 10 kJ at 400 W
  battery.draw(400.0, 1.0);
  EXPECT_EQ(battery.energy(), 0.0);
  EXPECT_NEAR(battery.delivered(), 1e4, 1e-9);
}

TEST(Battery, IsNeverFullerThanFull) {
  Battery battery(kSmall);
  battery.draw(-500.0, 1.0);
  EXPECT_EQ(battery.charge(), 1.0);
  battery.draw(500.0, 1.0);
  battery.draw(-400.0, 1.0);
  EXPECT_LT(battery.charge(), 1.0);
}

TEST(Battery, GoesOnFromASnapshot) {
  Battery battery(kSmall), other(kSmall);
  battery.draw(700.0, 2.0);
  std::vector<double> values;
  StateWriter writer(values);
  battery.save(writer);
  StateReader reader(values);
  other.restore(reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(other.energy(), battery.energy());
  EXPECT_EQ(other.delivered(), battery.delivered());
  EXPECT_EQ(other.lost(), battery.lost());
}

TEST(Battery, RefusesNumbersThatMakeNoBattery) {
  EXPECT_TRUE(contains(error_text([] { Battery({.capacity = 0.0}); }), "capacity"));
  EXPECT_TRUE(contains(error_text([] { Battery({.voltage = NAN}); }), "voltage"));
  EXPECT_TRUE(contains(error_text([] { Battery({.resistance = -1.0}); }), "resistance"));
}

}  // namespace

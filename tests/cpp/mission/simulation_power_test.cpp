// Strategy: the closed loop of the stretch with its battery and its brakes: what it takes, an arm
// handed to its brakes in the middle, an empty battery, and snapshots of both.
#include <cstring>
#include <vector>

#include "hurcules/mission/mission_simulation.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

TEST(SimulationPower, ComesOutOfTheBatteryTickByTick) {
  MissionSimulation simulation(stretch_scene(), "stretch");
  double drawn = 0.0;
  for (int i = 0; i < 500; ++i) {
    simulation.step();
    EXPECT_GT(simulation.telemetry().power, 300.0 + 16 * 12.0);  // standby, open brakes, motors
    drawn += 1e-3 * simulation.telemetry().power;
  }
  EXPECT_NEAR(simulation.battery().delivered(), drawn, 1e-9 * drawn);
  EXPECT_EQ(simulation.telemetry().charge, simulation.battery().charge());
  EXPECT_LT(simulation.battery().charge(), 1.0);
  simulation.reset(1);
  EXPECT_EQ(simulation.battery().charge(), 1.0);
}

TEST(SimulationPower, IsNoneAtAJointBehindItsBrake) {
  MissionSimulation simulation(stretch_scene(), "stretch");
  simulation.step(1500);
  simulation.set_brake("LSY", true);
  simulation.step(100);
  const Robot& plan = simulation.controller().plan();
  const auto joint = static_cast<Index>(plan.coordinate("LSY"));
  const double place = simulation.telemetry().q[joint];
  simulation.step(300);
  EXPECT_NEAR(simulation.telemetry().q[joint], place, 1e-5);
  const Recorder& log = simulation.log();
  for (std::size_t i = 0; i < log.columns(); ++i) {
    if (log.channels()[i] != "torque/LSY") continue;
    EXPECT_EQ(log.series(i).tail(300).norm(), 0.0);
  }
  EXPECT_TRUE(contains(error_text([&] { simulation.set_brake("LSX", true); }), "there are: LKN"));
}

TEST(SimulationPower, WithAnEmptyBatteryLeavesTheRobotStandingOnItsBrakes) {
  MissionOptions options;
  options.battery.capacity = 200.0;  // less than a second
  MissionSimulation simulation(stretch_scene(), "stretch", options);
  simulation.step(1000);
  EXPECT_TRUE(simulation.battery().empty());
  EXPECT_EQ(simulation.telemetry().torque.norm(), 0.0);
  const Vector held = simulation.telemetry().q;
  simulation.step(500);
  EXPECT_TRUE(near(simulation.telemetry().q, held, 2e-5));
  EXPECT_FALSE(simulation.finished());
}

TEST(SimulationPower, GoesOnFromASnapshotBitForBit) {
  MissionSimulation a(stretch_scene(), "stretch"), b(stretch_scene(), "stretch");
  a.step(200);
  a.set_brake("REB", true);
  a.step(20);
  b.restore(a.state());
  a.step(200);
  b.step(200);
  // some figures are NaN until they happen: compared as bits
  const std::vector<double> x = a.state(), y = b.state();
  ASSERT_EQ(x.size(), y.size());
  EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(double)), 0);
  EXPECT_EQ(a.battery().energy(), b.battery().energy());
}

}  // namespace

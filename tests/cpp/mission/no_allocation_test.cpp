// Strategy: every allocation is counted while the closed loop runs on the real scene.
#include "support/no_allocation.hpp"

#include "hurcules/mission/mission_simulation.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

void expect_no_allocation(MissionOptions options) {
  options.clock = [] { return 0.0; };
  MissionSimulation simulation(stretch_scene(), "stretch", options);
  const Vector command = Vector::Constant(11, 0.01);
  simulation.step(2600);  // warm, and room for the log
  simulation.reset(2);
  simulation.step(1900);
  const NoAllocation guard;
  simulation.step(200);  // the stretch begins
  simulation.step(200, &command);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(Tick, AllocatesNothing) {
  expect_no_allocation({});
}

TEST(Tick, AllocatesNothingWhileItYields) {
  MissionSimulation simulation(stretch_scene(), "stretch");
  Vector down = Vector::Zero(11);
  down[2] = down[5] = -1.0;  // both hands into the tracks, at full scale
  simulation.step(4000, &down);
  ASSERT_EQ(simulation.telemetry().yielding, 1.0);
  simulation.step(200, &down);
  simulation.reset(2);  // room for the log
  simulation.step(4000, &down);
  const NoAllocation guard;
  simulation.step(200, &down);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(Tick, AllocatesNothingWithNoisySensorsAScannerAndAFault) {
  MissionOptions options;
  options.sensors.models["encoder_position"] = {.noise = 1e-5, .delay = 2, .step = 1e-5};
  options.sensors.models["pose_rotation"] = {.noise = 1e-4, .bias = 1e-4, .drift = 1e-4};
  options.sensors.models["imu_rate"] = {.noise = 1e-3};
  options.sensors.range.rays = 361;
  options.sensors.faults = {{"imu_rate/x", FaultKind::NotANumber, 0.5}};
  expect_no_allocation(options);
}

}  // namespace

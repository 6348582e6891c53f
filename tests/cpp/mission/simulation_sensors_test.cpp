// Strategy: the closed loop with sensors that are not ideal: sameness, snapshots, a whole stretch
// with the errors of usual sensors, and what a lost encoder does to it. The figures of the models
// are assumptions (python/hurcules/sensors.py says whose).
#include <mujoco/mujoco.h>

#include <cmath>

#include "hurcules/mission/mission_simulation.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kBit = 2.0 * M_PI / (1 << 19);  // [rad] of a 19-bit encoder

MissionOptions usual() {
  MissionOptions options;
  options.seed = 5;
  options.record = false;
  options.sensors.models["encoder_position"] = {.noise = kBit, .delay = 1, .step = kBit};
  options.sensors.models["encoder_speed"] = {.noise = 1e-3, .delay = 1};
  options.sensors.models["imu_rate"] = {.noise = 4e-3, .bias = 3e-3, .drift = 1e-5};
  options.sensors.models["pose_position"] = {.noise = 2e-3, .bias = 0.01, .delay = 20};
  options.sensors.range.rays = 50;
  options.sensors.range.model.noise = 0.01;
  return options;
}

// after the beginning of the stretch the joints move: 4 s of it with a fault at 3 s
MissionSimulation make_with(const SensorFault& fault) {
  MissionOptions options;
  options.seed = 5;
  options.record = false;
  options.sensors.faults = {fault};
  return {stretch_scene(), "stretch", options};
}

TEST(SimulationSensors, TheSameSeedGivesTheSameBits) {
  MissionSimulation a(stretch_scene(), "stretch", usual()), b(stretch_scene(), "stretch", usual());
  a.step(300);
  for (int i = 0; i < 300; i += 10) b.step(10);
  EXPECT_TRUE(same_bits(a.state(), b.state()));
  b.reset(6);
  b.step(300);
  EXPECT_FALSE(same_bits(a.state(), b.state()));
}

TEST(SimulationSensors, ARestoredRunGoesOnBitForBit) {
  MissionSimulation a(stretch_scene(), "stretch", usual()), b(stretch_scene(), "stretch", usual());
  a.step(137);
  const std::vector<double> state = a.state();
  const Vector seen = a.observation().snapshot();
  a.step(200);
  b.reset(99);
  b.step(11);
  b.restore(state);
  EXPECT_EQ(b.observation().snapshot(), seen);
  b.step(200);
  EXPECT_TRUE(same_bits(a.state(), b.state()));
}

TEST(SimulationSensors, IdealOnesGiveTheBitsOfNone) {
  MissionOptions with, without;
  with.record = without.record = false;
  with.sensors.models["encoder_position"] = {};
  with.sensors.models["pose_rotation"] = {};
  without.monitors.on = false;
  MissionSimulation a(stretch_scene(), "stretch", with), b(stretch_scene(), "stretch", without);
  a.step(300);
  b.step(300);
  EXPECT_EQ(a.observation().snapshot(), b.observation().snapshot());
  EXPECT_EQ(a.telemetry().torque, b.telemetry().torque);
}

TEST(SimulationSensors, APolicySeesReadingsAndTheLimitsGoByTheTruth) {
  MissionOptions options = usual();
  options.sensors.models["encoder_position"] = {.bias = 5.0};  // beyond any joint range
  options.sensors.monitor.tolerance = 1e9;
  MissionSimulation simulation(stretch_scene(), "stretch", options);
  simulation.step(1);
  EXPECT_GT((simulation.telemetry().seen_q - simulation.telemetry().q).norm(), 1.0);
  EXPECT_EQ(simulation.observation().snapshot()[0], simulation.telemetry().seen_q[0]);
  EXPECT_LT(simulation.limits().measured().position, 0.1);
}

TEST(SimulationSensors, TheStretchSucceedsWithUsualSensors) {
  MissionSimulation simulation(stretch_scene(), "stretch", usual());
  simulation.step(60000);
  EXPECT_EQ(simulation.reason(), "completed");
  EXPECT_FALSE(simulation.held());
  for (const Figure& figure : simulation.figures()) {
    RecordProperty(figure.name, std::to_string(figure.value));
    // without noise 2.0 mm and 0.7 mrad (stretch_physics_test)
    if (figure.name == "hand_error_final_m") {
      EXPECT_LT(figure.value, 4e-3);
    }
  }
}

TEST(SimulationSensors, AnEncoderThatReadsNaNHoldsTheRobotAtOnce) {
  MissionSimulation simulation = make_with({"encoder_position/LSP", FaultKind::NotANumber, 3.0});
  simulation.step(3000);
  EXPECT_FALSE(simulation.held());
  simulation.step(1);
  EXPECT_TRUE(simulation.held());
  const Vector place = simulation.telemetry().q;
  simulation.step(5000);
  EXPECT_EQ(simulation.reason(), "held since 3.000 s: encoder_position/LSP is not a number");
  EXPECT_FALSE(simulation.success());
  EXPECT_NEAR(simulation.time(), 4.0, 0.0015);
  EXPECT_LT((simulation.telemetry().q - place).cwiseAbs().maxCoeff(), 5e-3);
  EXPECT_LT(simulation.telemetry().qd.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(simulation.telemetry().torque.head(14).cwiseAbs().maxCoeff(), 1e-9);  // brakes carry
}

TEST(SimulationSensors, AnEncoderThatStandsStillHoldsTheRobotBeforeMuchHappens) {
  MissionSimulation simulation = make_with({"encoder_position/LSP", FaultKind::Frozen, 3.0});
  simulation.step(9000);
  EXPECT_TRUE(contains(simulation.reason(), "held since ")) << simulation.reason();
  EXPECT_TRUE(contains(simulation.reason(), "LSP")) << simulation.reason();
  // found when the reference has gone 15 mrad on; a servo that sees no answer drives the joint
  // further than that: 60 mrad as measured, which is what this test holds (a regression bound)
  const Telemetry& t = simulation.telemetry();
  EXPECT_LT(t.lag.cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((t.q - t.q_des).cwiseAbs().maxCoeff(), 0.065);
  EXPECT_LT(t.qd.cwiseAbs().maxCoeff(), 1e-3);
}

TEST(SimulationSensors, AHeldRunIsPartOfTheSnapshot) {
  MissionSimulation a = make_with({"encoder_speed/LKN", FaultKind::NotANumber, 0.02});
  a.step(100);
  ASSERT_TRUE(a.held());
  MissionSimulation b = make_with({"encoder_speed/LKN", FaultKind::NotANumber, 0.02});
  b.restore(a.state());
  EXPECT_TRUE(b.held());
  a.step(2000);
  b.step(2000);
  EXPECT_EQ(a.reason(), "held since 0.020 s: encoder_speed/LKN is not a number");
  EXPECT_EQ(b.reason(), a.reason());
  EXPECT_TRUE(same_bits(a.state(), b.state()));
}

TEST(SimulationSensors, ABrokenSensorThatNothingActsOnStopsNothing) {
  MissionSimulation simulation = make_with({"imu_rate/x", FaultKind::NotANumber, 0.01});
  simulation.step(100);
  EXPECT_FALSE(simulation.held());
  EXPECT_FALSE(simulation.finished());
}

TEST(SimulationSensors, ASnapshotOfOtherSensorsDoesNotFit) {
  MissionSimulation plain(stretch_scene(), "stretch"), noisy(stretch_scene(), "stretch", usual());
  EXPECT_TRUE(contains(error_text([&] { noisy.restore(plain.state()); }), "snapshot"));
}

}  // namespace

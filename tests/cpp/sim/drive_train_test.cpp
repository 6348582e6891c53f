// Strategy: one belt with a motor, whose gear a hand computes: at rest, at speed, while it shifts.
// The robot through its gears is in driving_test.cpp.
#include "hurcules/sim/drive_train.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <vector>

#include "hurcules/sim/plant.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// 600 N m in the low gear, 39.7 rad/s in the high one, 7.95 kW
ModelPtr belt(const std::string& transmission = "3 1 0.15 0.92 0.95",
              const std::string& prefix = "") {
  return load_model_text(R"(<mujoco><option timestep="0.001" integrator="implicitfast"/>
    <worldbody><body><joint name=")" +
                         prefix + R"(belt" axis="0 1 0" armature="10"/>
      <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/></body></worldbody>
    <actuator><motor joint=")" +
                         prefix + R"(belt" forcerange="-600 600"/></actuator>
    <custom><numeric name=")" +
                         prefix + R"(velocity_limit_belt" data="39.7"/>
      <numeric name=")" + prefix +
                         R"(power_limit_belt" data="7950"/>
      <numeric name=")" + prefix +
                         R"(transmission_belt" data=")" + transmission + R"("/></custom>
    <keyframe><key name="rest" qpos="0"/></keyframe></mujoco>)");
}

TEST(DriveTrain, ShiftsFromThreeToOneWithoutASteppingBack) {
  const Transmission cvt{
      .low = 3.0, .high = 1.0, .lag = 0.15, .efficiency = 0.92, .governed = 0.95};
  EXPECT_EQ(cvt.steady(0.0, 39.7), 3.0);
  EXPECT_EQ(cvt.steady(39.7, 39.7), 1.0);
  EXPECT_NEAR(cvt.steady(-20.0, 39.7), 0.95 * 39.7 / 20.0, 1e-12);  // backward too
  double last = 3.0;
  for (double speed = 0.0; speed < 50.0; speed += 0.1) {
    EXPECT_LE(cvt.steady(speed, 39.7), last);
    last = cvt.steady(speed, 39.7);
  }
}

TEST(DriveTrain, GivesTheTorqueOfItsGearAndLeavesTheControlAsItWas) {
  Plant physics(belt());
  physics.reset(0);
  physics.data()->ctrl[0] = 1e4;
  physics.step();
  EXPECT_NEAR(physics.data()->actuator_force[0], 600.0, 1e-9);
  EXPECT_EQ(physics.data()->ctrl[0], 1e4);
  for (int i = 0; i < 1500; ++i) physics.step();
  const double speed = physics.qvel()[0], ratio = physics.drive_train().ratio(0);
  EXPECT_LT(ratio, 1.5);
  EXPECT_LE(physics.data()->actuator_force[0] * speed, 7950.0 * 1.001);
  EXPECT_LE(physics.data()->actuator_force[0], 200.0 * ratio + 1e-9);
}

TEST(DriveTrain, FollowsASuddenSpeedWithItsLag) {
  Plant physics(belt());
  physics.reset(0);
  physics.data()->qvel[0] = 39.7;
  for (int i = 0; i < 150; ++i) physics.step();
  EXPECT_NEAR(physics.drive_train().ratio(0), 1.0 + 2.0 * std::exp(-1.0), 0.01);
}

TEST(DriveTrain, GoesOnFromASnapshotBitForBit) {
  Plant a(belt()), b(belt());
  a.reset(0);
  b.reset(0);
  a.data()->ctrl[0] = 500.0;
  for (int i = 0; i < 700; ++i) a.step();
  std::vector<double> values;
  StateWriter writer(values);
  a.save(writer);
  StateReader reader(values);
  b.restore(reader);
  a.step();
  b.step();
  EXPECT_EQ(a.qvel()[0], b.qvel()[0]);
  EXPECT_EQ(a.drive_train().ratio(0), b.drive_train().ratio(0));
}

TEST(DriveTrain, IsFoundBehindAPrefixAndRefusesBadNumbers) {
  EXPECT_TRUE(DriveTrain(belt("3 1 0.15 0.92 0.95", "robot_").get()).exists(0));
  const auto text = [](const std::string& numbers) {
    return error_text([&] { DriveTrain(belt(numbers).get()); });
  };
  EXPECT_TRUE(contains(text("3 1 0.15"), "wants 5 numbers"));
  EXPECT_TRUE(contains(text("1 3 0.15 0.92 0.95"), "low >= high > 0"));
  EXPECT_TRUE(contains(text("3 1 0.15 1.92 0.95"), "0 < efficiency <= 1"));
}

}  // namespace

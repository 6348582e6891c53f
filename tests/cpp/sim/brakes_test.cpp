// Strategy: one loaded joint that a hand can compute: what holds, what slips, how it stops.
// Negative controls: no brake, a weak brake. The arms of the real robot are in arm_brakes_test.cpp,
// brakes while driving in drive_power_test.cpp.
#include "hurcules/sim/brakes.hpp"

#include <mujoco/mujoco.h>

#include <cmath>

#include "hurcules/sim/plant.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// 50 kg at 0.6 m on a joint with a motor of this peak: 294.3 N m of load
ModelPtr beam(const std::string& peak, const std::string& friction = "18") {
  return load_model_text(R"(<mujoco><option timestep="0.001" integrator="implicitfast"/>
    <worldbody><body><joint name="EB" axis="0 -1 0" armature="0.9" frictionloss=")" +
                         friction + R"("
        solreffriction="0.004 1" solimpfriction="0.9999 0.9999 0.001 0.5 2"/>
      <inertial pos="0.6 0 0" mass="50" diaginertia="1 1 1"/></body></worldbody>
    <actuator><motor joint="EB" forcerange="-)" +
                         peak + " " + peak + R"("/></actuator>
    <keyframe><key name="level" qpos="0"/></keyframe></mujoco>)");
}
constexpr double kLoad = 50.0 * 9.81 * 0.6;

class Beam {
 public:
  explicit Beam(const std::string& peak) : physics(beam(peak)) { physics.reset(0); }
  void step(int n) {
    for (int i = 0; i < n; ++i) physics.step();
  }
  [[nodiscard]] double angle() const { return physics.qpos()[0]; }
  [[nodiscard]] double speed() const { return physics.qvel()[0]; }
  Plant physics;
};

TEST(Brakes, HoldALoadAtNoPowerAndSayWhatTheyBear) {
  Beam beam("600");
  beam.physics.brakes().reset(true);
  beam.step(10000);
  EXPECT_NEAR(beam.angle(), 0.0, 1e-4);
  EXPECT_NEAR(beam.physics.brakes().load(0), kLoad, 1e-3 * kLoad);
  EXPECT_EQ(beam.physics.brakes().power(), 0.0);
  beam.physics.brakes().set_closed(0, false);
  EXPECT_EQ(beam.physics.brakes().power(), 12.0);
}

TEST(Brakes, OpenLetTheLoadFallAsItFallsWithoutThem) {
  Beam beam("600");
  beam.step(100);
  // J a = load - friction, over 0.1 s: cos of the angle stays near 1
  const double a = (kLoad - 18.0) / (50.0 * 0.36 + 1.0 + 0.9);
  EXPECT_NEAR(beam.angle(), -0.5 * a * 0.01, 0.02 * 0.5 * a * 0.01);
}

TEST(Brakes, SlipAboveTheirTorqueAsDryFrictionDoes) {
  Beam beam("200");  // a brake of 240 N m under 294 N m
  beam.physics.brakes().reset(true);
  beam.step(100);
  const double a = (kLoad - 240.0) / (50.0 * 0.36 + 1.0 + 0.9);
  EXPECT_NEAR(beam.angle(), -0.5 * a * 0.01, 0.03 * 0.5 * a * 0.01);
}

TEST(Brakes, StopATurningJointWithTheirTorque) {
  Beam beam("600");
  beam.physics.brakes().reset(true);
  beam.physics.data()->qvel[0] = -1.0;  // falling: 720 N m against 294 N m
  int ticks = 0;
  // to 0.05 rad/s: below 0.04 the stiff friction row fades out instead of stepping
  while (beam.speed() < -0.05 && ticks < 1000) {
    beam.step(1);
    ++ticks;
  }
  EXPECT_NEAR(1e-3 * ticks, 0.95 * (50.0 * 0.36 + 1.9) / (720.0 - kLoad), 1e-3);
}

TEST(Brakes, CloseAndOpenOverTheirTime) {
  Beam beam("600");
  Brakes& brakes = beam.physics.brakes();
  brakes.set_closed(0, true);
  beam.step(40);
  EXPECT_FALSE(brakes.is_shut(0) || brakes.is_open(0));
  beam.step(12);
  EXPECT_TRUE(brakes.is_shut(0));
  brakes.set_closed(0, false);
  beam.step(52);
  EXPECT_TRUE(brakes.is_open(0));
}

TEST(Brakes, AreWhereAMotorAndAFrictionRowAre) {
  const Brakes brakes(stretch_scene().get());
  EXPECT_EQ(brakes.names().size(), static_cast<std::size_t>(stretch_scene()->nu));
  EXPECT_EQ(brakes.max_load(brakes.find("LSP")), 1.2 * 800.0);
  EXPECT_TRUE(contains(error_text([&] { (void)brakes.find("LXP"); }),
                       "brake of joint 'LXP' does not exist; there are: "));
  const ModelPtr without = beam("600", "0");
  Brakes none(without.get());
  EXPECT_TRUE(none.names().empty());
  EXPECT_TRUE(contains(error_text([&] { none.set_closed(0, true); }), "has no brake"));
  EXPECT_TRUE(contains(error_text([&] { Brakes(without.get(), {.strength = 0.0}); }), "strength"));
  EXPECT_TRUE(contains(error_text([&] { Brakes(without.get(), {.time = NAN}); }), "time"));
  EXPECT_TRUE(contains(error_text([&] { Brakes(without.get(), {.coil_power = -1.0}); }), "power"));
}

}  // namespace

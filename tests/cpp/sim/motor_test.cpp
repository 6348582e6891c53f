// Strategy: a motor's curve against the formulas of its header and docs/design/robot.md#drive-train
// (CVT); its electric power against what a hand computes; then the drives of both real robots:
// numbers present, and the rotor's inertia, the friction and the damping felt as a motor feels
// them.
#include "hurcules/robot/motor.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/power_meter.hpp"
#include "support/expect.hpp"
#include "support/models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

const MotorLimits kElbow = {600.0, 1.8, 540.0};

ModelPtr robot(const std::string& name) {
  return load_model(hurcules_test::models("/robots/") + name + ".xml");
}

TEST(Motor, GivesPeakTorqueThenPeakPowerThenNothing) {
  EXPECT_EQ(kElbow.at(0.0).upper, 600.0);
  EXPECT_EQ(kElbow.at(0.9).upper, 600.0);  // the corner: 540 W / 600 N m
  EXPECT_NEAR(kElbow.at(1.5).upper, 360.0, 1e-12);
  EXPECT_NEAR(kElbow.at(1.8).upper, 300.0, 1e-12);
  EXPECT_NEAR(kElbow.at(1.89).upper, 0.5 * 540.0 / 1.89, 1e-9);  // halfway to no load
  EXPECT_EQ(kElbow.at(1.99).upper, 0.0);
}

TEST(Motor, NeverDrivesAboveItsPowerAndBrakesWithItsPeak) {
  for (double v = -3.0; v <= 3.0; v += 0.01) {
    const EffortRange range = kElbow.at(v);
    EXPECT_LE(v >= 0.0 ? range.upper * v : range.lower * v, 540.0 + 1e-9) << v;
    EXPECT_EQ(v >= 0.0 ? range.lower : range.upper, v >= 0.0 ? -600.0 : 600.0) << v;
    EXPECT_EQ(kElbow.at(-v).lower, -range.upper) << v;
  }
}

TEST(Motor, OfATrackIsTheCvtOfTheDesignPage) {
  // [robot#drive-train] F_max(v) = F_1 clamp(5.56 / v, 1, 3), F_1 = 1430 N a side; peak 600 N m =
  // 4286 N
  const ModelPtr model = robot("rescue");
  const int drive = mj_name2id(model.get(), mjOBJ_ACTUATOR, "L_drive");
  const MotorLimits limits = read_motor_limits(model.get(), drive);
  for (double v = 0.1; v <= 5.55; v += 0.05) {
    const double force = limits.at(v / 0.14).upper / 0.14;
    EXPECT_NEAR(force, 1430.0 * std::clamp(5.56 / v, 1.0, 3.0), 5.0) << v;
  }
}

TEST(Motor, TakesItsShaftPowerItsLossesAndTheHeatOfItsWindings) {
  const MotorPower power(kElbow, {.efficiency = 0.8, .regeneration = 0.5, .heat_at_peak = 0.3});
  EXPECT_NEAR(power.at(600.0, 0.0), 0.3 * 540.0, 1e-12);           // stalled
  EXPECT_NEAR(power.at(300.0, 1.0), 300.0 / 0.8 + 40.5, 1e-12);    // drives
  EXPECT_NEAR(power.at(300.0, -1.0), -0.5 * 300.0 + 40.5, 1e-12);  // is driven
  EXPECT_EQ(power.at(0.0, 1.0), 0.0);
  EXPECT_GE(MotorPower(kElbow).at(300.0, -1.0), 0.0);  // a resistor burns it
}

TEST(Motor, OfEveryJointOfBothRobotsHasAllThreeLimits) {
  for (const char* name : {"rescue", "manipulation"}) {
    const ModelPtr model = robot(name);
    for (int a = 0; a < model->nu; ++a) {
      const MotorLimits limits = read_motor_limits(model.get(), a);
      const bool track = limits.speed > 10.0;
      EXPECT_TRUE(std::isfinite(limits.power)) << name << a;
      // the corner of the curve: half speed, for the tracks a third (CVT 3:1)
      EXPECT_NEAR(limits.power / (limits.peak * limits.speed), track ? 1.0 / 3.0 : 0.5, 1e-3)
          << mj_id2name(model.get(), mjOBJ_ACTUATOR, a);
    }
  }
}

// one joint with the elbow's drive, turning a point mass in free space
class Drive : public testing::Test {
 protected:
  static constexpr double kInertia = 2.0, kArmature = 0.9, kFriction = 18.0, kDamping = 16.7;
  // speed after so many seconds of this torque
  double turn(double torque, double seconds) {
    mj_resetData(model_.get(), data_.get());
    data_->ctrl[0] = torque;
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) mj_step(model_.get(), data_.get());
    return data_->qvel[0];
  }
  ModelPtr model_ = load_model_text(R"(<mujoco>
    <option timestep="0.001" integrator="implicitfast" gravity="0 0 0"/><worldbody><body>
      <inertial pos="0 0 0" mass="1" diaginertia="2 2 2"/>
      <joint name="EB" axis="0 1 0" armature="0.9" frictionloss="18" damping="16.7"
             solreffriction="0.004 1" solimpfriction="0.9999 0.9999 0.001 0.5 2"/></body>
    </worldbody><actuator><motor joint="EB"/></actuator></mujoco>)");
  std::unique_ptr<mjData, void (*)(mjData*)> data_{mj_makeData(model_.get()), mj_deleteData};
};

TEST_F(Drive, FeelsItsRotorItsFrictionAndItsDamping) {
  EXPECT_NEAR(turn(0.9 * kFriction, 1.0), 0.0, 1e-4);  // friction holds
  // from rest: v = v_end (1 - exp(-t / T)), T = J / d
  const double end = (100.0 - kFriction) / kDamping, T = (kInertia + kArmature) / kDamping;
  EXPECT_NEAR(turn(100.0, 0.1), end * (1.0 - std::exp(-0.1 / T)), 0.01 * end);
  EXPECT_NEAR(turn(100.0, 3.0), end, 1e-3 * end);
}

TEST_F(Drive, GivesAsMuchWorkAsTheMeterCounts) {
  mj_resetData(model_.get(), data_.get());
  PowerMeter meter(model_.get());
  const Brakes brakes(model_.get());
  double work = 0.0, lost = 0.0;
  for (int i = 0; i < 1000; ++i) {
    data_->ctrl[0] = 100.0;
    mj_step(model_.get(), data_.get());
    meter.read(data_.get(), brakes, DriveTrain(model_.get()));
    work += 1e-3 * meter.mechanical();
    lost += 1e-3 * data_->qvel[0] * (kFriction + kDamping * data_->qvel[0]);
  }
  const double kinetic = 0.5 * (kInertia + kArmature) * data_->qvel[0] * data_->qvel[0];
  EXPECT_NEAR(work, kinetic + lost, 0.01 * work);
  EXPECT_EQ(meter.total(), meter.motors() + 300.0);
}

TEST(Motor, RefusesNumbersThatMakeNoMotor) {
  const auto text = [](const std::string& motor, const std::string& custom) {
    const ModelPtr model = load_model_text(
        "<mujoco><worldbody><body><joint name=\"j\"/><geom size=\"1\"/><site name=\"s\"/></body>"
        "</worldbody><actuator><motor " +
        motor + "/></actuator><custom>" + custom + "</custom></mujoco>");
    return error_text([&] { (void)read_motor_limits(model.get(), 0); });
  };
  EXPECT_EQ(text(R"(joint="j")", ""), "");
  EXPECT_TRUE(contains(text(R"(joint="j")", R"(<numeric name="power_limit_j" data="-1"/>)"),
                       "'power_limit_j' wants a number above 0"));
  EXPECT_TRUE(contains(text(R"(joint="j" forcerange="0 5")", ""), "wants a forcerange"));
  EXPECT_TRUE(contains(text(R"(site="s")", ""), "actuator of a joint"));
  EXPECT_TRUE(contains(error_text([] { MotorPower(kElbow, {.efficiency = 0.0}); }), "efficiency"));
  EXPECT_TRUE(
      contains(error_text([] { MotorPower(kElbow, {.regeneration = 2.0}); }), "regeneration"));
  EXPECT_TRUE(contains(error_text([] { MotorPower(kElbow, {.heat_at_peak = NAN}); }), "heat"));
}

}  // namespace

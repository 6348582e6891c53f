// Strategy: one motor on a joint that the test loads as it likes, against the law of a first-order
// body. Not tested: whether 60 s are right for these motors; it is an assumption.
#include "hurcules/sim/motor_thermal_model.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <memory>

#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// peak 100 N m, 1000 W; the second has no limits
constexpr const char* kMotors = R"(
<mujoco>
  <worldbody>
    <body><joint name="a" axis="0 1 0"/><geom size="0.1"/></body>
    <body><joint name="b" axis="0 1 0"/><geom size="0.1"/></body>
  </worldbody>
  <actuator>
    <motor joint="a" gear="10" forcerange="-10 10"/>
    <motor joint="b"/>
  </actuator>
  <custom>
    <numeric name="velocity_limit_a" data="20"/>
    <numeric name="power_limit_a" data="1000"/>
  </custom>
</mujoco>)";

class MotorThermalModelTest : public testing::Test {
 protected:
  MotorThermalModelTest()
      : model_(load_model_text(kMotors)), data_(mj_makeData(model_.get()), mj_deleteData) {}
  // [deg C] of the first motor after this torque [N m] for this time
  double after(double torque, double seconds) {
    data_->actuator_force[0] = torque / 10.0;
    data_->actuator_force[1] = torque;
    for (int i = 0; i < static_cast<int>(100.0 * seconds); ++i) windings_->warm(data_.get());
    return windings_->temperature()[0];
  }

  ModelPtr model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
  std::unique_ptr<MotorThermalModel> windings_ =
      std::make_unique<MotorThermalModel>(model_.get(), MotorLosses{}, 0.01);
};

TEST_F(MotorThermalModelTest, AStalledMotorReachesItsLimitAfterWhatTheLawSays) {
  // peak torque would end at 25 + 105 / 0.36 = 317 deg C: 130 are there after -60 ln(1 - 0.36)
  const double seconds = -60.0 * std::log(1.0 - 0.36);
  EXPECT_NEAR(seconds, 26.8, 0.1);
  EXPECT_NEAR(after(100.0, seconds), 130.0, 0.1);
  EXPECT_NEAR(after(100.0, 600.0), 25.0 + 105.0 / 0.36, 0.1);
}

TEST_F(MotorThermalModelTest, TheContinuousTorqueEndsAtTheLimitAndNoTorqueAtTheAir) {
  EXPECT_NEAR(after(-60.0, 900.0), 130.0, 0.01);
  EXPECT_NEAR(after(0.0, 60.0), 25.0 + 105.0 * std::exp(-1.0), 0.01);
  EXPECT_NEAR(after(0.0, 900.0), 25.0, 0.01);
}

TEST_F(MotorThermalModelTest, AMotorWithoutLimitsOrLossesStaysCold) {
  after(100.0, 60.0);
  EXPECT_EQ(windings_->temperature()[1], 25.0);
  windings_ =
      std::make_unique<MotorThermalModel>(model_.get(), MotorLosses{.heat_at_peak = 0.0}, 0.01);
  EXPECT_EQ(after(100.0, 60.0), 25.0);
  EXPECT_EQ(windings_->names(), (std::vector<std::string>{"a", "b"}));
}

TEST_F(MotorThermalModelTest, RefusesWhatCannotBe) {
  const auto text = [this](const MotorThermalOptions& options) {
    return error_text([&] { MotorThermalModel(model_.get(), {}, 0.01, options); });
  };
  EXPECT_TRUE(contains(text({.limit = 20.0}), "limit wants a temperature above ambient"));
  EXPECT_TRUE(contains(text({.continuous = 0.0}), "continuous wants a share"));
  EXPECT_TRUE(contains(text({.time_constant = -1.0}), "time_constant wants a time above 0"));
}

}  // namespace

// Strategy: the real robot put into postures by hand and stepped: one that stands, one that tips on
// a slope, one whose arms meet; a motor that stalls. Alarms on the way.
#include "hurcules/sim/monitors.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/plant.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;
using Quantity = Monitors::Quantity;

class MonitorsTest : public testing::Test {
 protected:
  MonitorsTest() : physics_(stretch_scene()), m_(physics_.model()) {}
  [[nodiscard]] Monitors make(const MonitorOptions& options = {}) const {
    return {
        m_, {mj_name2id(m_, mjOBJ_BODY, "upper_legs")}, MotorLosses{}, m_->opt.timestep, options};
  }
  double& joint(const char* name) {
    return physics_.qpos()[m_->jnt_qposadr[mj_name2id(m_, mjOBJ_JOINT, name)]];
  }
  void stand(const char* keyframe) { physics_.reset(physics_.find_keyframe(keyframe)); }
  void look(Monitors& monitors, double power = 0.0) {
    physics_.step();
    monitors.look(m_, physics_.data(), power);
  }

  Plant physics_;
  const mjModel* m_;
};

TEST_F(MonitorsTest, TheDrivingRobotStandsWell) {
  Monitors monitors = make();
  stand("drive");
  physics_.brakes().reset(true);
  for (int i = 0; i < 100; ++i) physics_.step();  // until the suspension bears it
  look(monitors);
  // 0.39 m in the pose table (docs/design/robot.md#postures) for the robot without person
  EXPECT_NEAR(monitors.value(Quantity::Margin), 0.39, 0.03);
  EXPECT_GT(monitors.value(Quantity::TipAngle), 0.4);
  EXPECT_GE(monitors.support_points(), 4);
  for (Index i = 0; i < Monitors::kQuantities; ++i) EXPECT_FALSE(monitors.alarm(i)) << i;
}

// fixed, or on a rail: nothing tips over, whatever it touches
TEST(MonitorsOfAFixedRobot, KnowNoMarginsAndRaiseNoAlarm) {
  for (const char* root : {"", "<joint type='slide' axis='1 0 0'/>"}) {
    Plant physics(load_model_text(std::string("<mujoco><worldbody><geom type='plane' size='1 1 1'/>"
                                              "<body name='base' pos='0 0 0.09'>") +
                                  root +
                                  "<geom size='0.1' mass='1'/><body pos='0 0 0.3'>"
                                  "<joint axis='0 1 0'/><geom size='0.05' mass='1'/></body>"
                                  "</body></worldbody></mujoco>"));
    const mjModel* const m = physics.model();
    Monitors monitors(m, {mj_name2id(m, mjOBJ_BODY, "base")}, MotorLosses{}, 1e-3);
    monitors.reset(m, physics.data());
    physics.step();
    monitors.look(m, physics.data(), 0.0);
    for (const Quantity quantity :
         {Quantity::Margin, Quantity::PressureMargin, Quantity::TipAngle, Quantity::Energy}) {
      EXPECT_TRUE(std::isnan(monitors.value(quantity)));
      EXPECT_TRUE(std::isnan(monitors.worst(quantity)));
      EXPECT_FALSE(monitors.alarm(quantity));
    }
    std::vector<double> state;
    StateWriter writer(state);
    monitors.save(writer);
    StateReader reader(state);
    monitors.restore(reader);
    EXPECT_TRUE(std::isnan(monitors.value(Quantity::Margin)));
  }
}

// the scene with gravity as on a slope of so many degrees, nose up, and belts that do not roll
ModelPtr slope_scene(double degrees) {
  mjModel* const m = mj_copyModel(nullptr, stretch_scene().get());
  const double angle = degrees * M_PI / 180.0;
  m->opt.gravity[0] = -9.81 * std::sin(angle);
  m->opt.gravity[2] = -9.81 * std::cos(angle);
  for (const char* belt : {"L_lower_belt", "R_lower_belt", "L_upper_belt", "R_upper_belt"}) {
    m->dof_frictionloss[m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, belt)]] = 1e4;
  }
  return {m, [](const mjModel* model) { mj_deleteModel(const_cast<mjModel*>(model)); }};
}

struct OnSlope {
  double margin = 0.0, tip_angle = 0.0;  // [m], [rad] at the beginning
  double turned = 0.0;                   // [rad] by the upper legs in 1 s
};

// all brakes shut: a rigid robot in this posture
OnSlope stand_on_slope(double degrees, const char* keyframe) {
  Plant physics(slope_scene(degrees));
  const mjModel* const m = physics.model();
  Monitors monitors(m, {mj_name2id(m, mjOBJ_BODY, "upper_legs")}, MotorLosses{}, 1e-3);
  physics.reset(physics.find_keyframe(keyframe));
  physics.brakes().reset(true);
  const int body = mj_name2id(m, mjOBJ_BODY, "upper_legs");
  for (int i = 0; i < 100; ++i) physics.step();  // until the suspension bears it
  monitors.look(m, physics.data(), 0.0);
  const Vector before = Eigen::Map<const Vector>(physics.data()->xquat + 4 * body, 4);
  for (int i = 0; i < 1000; ++i) physics.step();
  const double same =
      std::abs(before.dot(Eigen::Map<const Vector>(physics.data()->xquat + 4 * body, 4)));
  return {monitors.value(Quantity::Margin), monitors.value(Quantity::TipAngle),
          2.0 * std::acos(std::min(same, 1.0))};
}

TEST_F(MonitorsTest, APostureThatTipsOnASlopeIsToldFromOneThatDoesNot) {
  // standing, the centre of mass is 0.266 m before the rear edge and 0.669 m high: it tips at
  // 21.7 degrees; driving, 0.449 and 0.516 m: at 41 degrees
  const OnSlope below = stand_on_slope(18.0, "ready"), above = stand_on_slope(25.0, "ready");
  const OnSlope low = stand_on_slope(25.0, "drive");
  EXPECT_NEAR(below.tip_angle, (21.7 - 18.0) * M_PI / 180.0, 0.01);
  EXPECT_NEAR(above.tip_angle, (21.7 - 25.0) * M_PI / 180.0, 0.01);
  EXPECT_GT(below.margin, 0.0);
  EXPECT_LT(above.margin, 0.0);
  EXPECT_GT(low.margin, 0.1);
  // and so the physics does
  EXPECT_LT(below.turned, 0.03);
  EXPECT_GT(above.turned, 0.15);
  EXPECT_LT(low.turned, 0.03);
}

TEST_F(MonitorsTest, FoldedArmsThatMeetAreSeen) {
  Monitors monitors = make();
  stand("drive");
  look(monitors);
  const double apart = monitors.value(Quantity::Distance);
  EXPECT_GT(apart, 0.01);
  // both lower arms swung inwards before the chest
  stand("drive");
  joint("LSP") = joint("RSP") = 0.9;
  joint("LEB") = joint("REB") = 1.6;
  joint("LSY") = -1.2;
  joint("RSY") = -1.2;
  look(monitors);
  EXPECT_LT(monitors.value(Quantity::Distance), 0.0);
  EXPECT_TRUE(monitors.alarm(Quantity::Distance));
}

TEST_F(MonitorsTest, AStalledMotorRaisesItsAlarmAndLosesItWhenItCools) {
  MonitorOptions options;
  options.windings.time_constant = 0.05;  // [s], so that the test is short
  Monitors monitors = make(options);
  stand("drive");
  physics_.step();
  const int elbow = mj_name2id(m_, mjOBJ_ACTUATOR, "LEB");
  const double peak = m_->actuator_forcerange[2 * elbow + 1];
  for (int i = 0; i < 100; ++i) {
    physics_.data()->actuator_force[elbow] = peak;
    monitors.look(m_, physics_.data(), 0.0);
  }
  EXPECT_TRUE(monitors.alarm(Quantity::Temperature));
  EXPECT_GT(monitors.value(Quantity::Temperature), 130.0);
  const double worst = monitors.worst(Quantity::Temperature);
  for (int i = 0; i < 700; ++i) {
    physics_.data()->actuator_force[elbow] = 0.0;
    monitors.look(m_, physics_.data(), 0.0);
  }
  EXPECT_FALSE(monitors.alarm(Quantity::Temperature));
  EXPECT_EQ(monitors.worst(Quantity::Temperature), worst);
}

TEST_F(MonitorsTest, AnAlarmDoesNotChatter) {
  MonitorOptions options;
  options.max_power = 1000.0;
  Monitors monitors = make(options);
  stand("drive");
  physics_.step();
  const auto after = [&](double power) {
    monitors.look(m_, physics_.data(), power);
    return monitors.alarm(Quantity::Power);
  };
  EXPECT_FALSE(after(999.0));
  EXPECT_TRUE(after(1001.0));
  EXPECT_TRUE(after(999.0));
  const auto lasts = [&](double power) {
    int looks = 0;
    while (after(power) && ++looks < 1000) {
    }
    return looks * m_->opt.timestep;
  };
  EXPECT_GE(lasts(901.0), 1.0);
  EXPECT_NEAR(lasts(899.0), 0.5, 0.002);
  EXPECT_FALSE(after(999.0));
  EXPECT_TRUE(after(1001.0));
  EXPECT_TRUE(after(899.0));
  EXPECT_TRUE(after(901.0));  // and the half second begins anew
  EXPECT_NEAR(lasts(899.0), 0.5, 0.002);
}

TEST_F(MonitorsTest, InTheAirTheyKeepWhatTheySawOnTheGround) {
  Monitors monitors = make();
  stand("drive");
  look(monitors);
  const double margin = monitors.value(Quantity::Margin);
  stand("drive");
  physics_.qpos()[m_->jnt_qposadr[mj_name2id(m_, mjOBJ_JOINT, "root")] + 2] += 1.0;
  look(monitors);
  EXPECT_EQ(monitors.support_points(), 0);
  EXPECT_EQ(monitors.value(Quantity::Margin), margin);
}

TEST_F(MonitorsTest, SwitchedOffTheyLookAtNothing) {
  MonitorOptions options;
  options.on = false;
  Monitors monitors = make(options);
  stand("drive");
  look(monitors, 1e9);
  EXPECT_TRUE(std::isnan(monitors.worst(Quantity::Power)));
  EXPECT_FALSE(monitors.alarm(Quantity::Power));
}

TEST_F(MonitorsTest, RefusesAThresholdThatIsNoNumber) {
  MonitorOptions options;
  options.min_margin = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_text([&] { (void)make(options); }),
            "monitors: the threshold of static_margin_m wants a number, NaN came");
  options.min_margin = -std::numeric_limits<double>::infinity();  // never alarms
  EXPECT_EQ(error_text([&] { (void)make(options); }), "");
}

}  // namespace

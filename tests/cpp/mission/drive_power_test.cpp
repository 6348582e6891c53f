// Strategy: the rescue robot drives a mission of 400 m at 20 km/h on flat ground with every joint
// but the belts braked (F05, H06, H12): its work against friction and damping as a hand computes
// them, and then the battery over the 2 h of F04 with seven such missions there and back (H13).
// Boards of 4 cm on the way for the brakes of the arms; those of neck and knees slip there. The
// drive here is a plain speed loop. Not tested: slopes, loads, turning.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "hurcules/control/joint_servo.hpp"
#include "hurcules/sim/battery.hpp"
#include "hurcules/sim/plant.hpp"
#include "hurcules/sim/power_meter.hpp"
#include "support/expect.hpp"
#include "support/held_posture.hpp"
#include "support/models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kRadius = 0.14, kSpeed = 5.56, kAcceleration = 1.0;
// [N m] at each driven belt: rolling resistance of 0.06 of the weight, 400 N in all
// [robot#drive-train]
constexpr double kRolling = 0.06 * 680.0 * 9.81 * kRadius / 2.0;

ModelPtr scene(const std::string& more = "") {
  const ModelPtr model = load_model_text(
      R"(<mujoco><include file="../robots/rescue.xml"/>
      <include file="flat.xml"/><worldbody>)" +
          more + "</worldbody></mujoco>",
      hurcules_test::models("/scenes"));
  for (const char* belt : {"L_lower_belt", "R_lower_belt"}) {
    const int joint = mj_name2id(model.get(), mjOBJ_JOINT, belt);
    model->dof_frictionloss[model->jnt_dofadr[joint]] = kRolling;
  }
  return model;
}

class Vehicle {
 public:
  explicit Vehicle(const ModelPtr& model) : physics(model), meter(model.get()) {
    physics.reset(physics.find_keyframe("drive"));
    physics.brakes().reset(true);
    for (const char* belt : {"L_lower_belt", "R_lower_belt"}) {
      belts_.push_back(physics.brakes().find(belt));
      physics.brakes().set_closed(belts_.back(), false);
      limits_.push_back(read_motor_limits(model.get(), belts_.back()));
    }
    for (const std::string& joint : physics.brakes().names()) {
      if (joint.find("belt") != std::string::npos) continue;
      kind_.push_back(joint.size() == 3 ? joint[1] : ' ');  // S of LSP, E of REB
      held_.push_back(model->jnt_qposadr[mj_name2id(model.get(), mjOBJ_JOINT, joint.c_str())]);
      start_.push_back(physics.qpos()[held_.back()]);
    }
  }
  // one tick towards this speed [m/s]
  void step(double speed) {
    for (std::size_t i = 0; i < 2; ++i) {
      const int dof = physics.model()->jnt_dofadr[physics.model()->actuator_trnid[2 * belts_[i]]];
      const double velocity = physics.data()->qvel[dof];
      const EffortRange range = limits_[i].at(velocity);
      physics.data()->ctrl[belts_[i]] =
          std::clamp(300.0 * (speed / kRadius - velocity), range.lower, range.upper);
    }
    physics.step();
    meter.read(physics.data(), physics.brakes(), physics.drive_train());
    work += 1e-3 * meter.mechanical();
    electric += 1e-3 * meter.motors();
    energy += 1e-3 * meter.total();
    seconds += 1e-3;
    most_power = std::max(most_power, meter.mechanical());
  }
  // up to speed, along, and down again
  void go(double distance) {
    const double start = physics.qpos()[0];
    for (double speed = 0.0; speed < kSpeed; speed += 1e-3 * kAcceleration) step(speed);
    const double way = physics.qpos()[0] - start;
    while (physics.qpos()[0] - start < distance - way && seconds < 200.0) step(kSpeed);
    for (double speed = kSpeed; speed > 0.0; speed -= 1e-3 * kAcceleration) step(speed);
  }
  // how far the braked joints have moved at most, or those of one kind alone [rad]
  [[nodiscard]] double moved(char kind = 0) const {
    double moved = 0.0;
    for (std::size_t i = 0; i < held_.size(); ++i) {
      if (kind && kind_[i] != kind) continue;
      moved = std::max(moved, std::abs(physics.qpos()[held_[i]] - start_[i]));
    }
    return moved;
  }
  Plant physics;
  PowerMeter meter;
  double work = 0.0, electric = 0.0, energy = 0.0, seconds = 0.0, most_power = 0.0;

 private:
  std::vector<int> belts_, held_;
  std::vector<char> kind_;
  std::vector<double> start_;
  std::vector<MotorLimits> limits_;
};

// [W] of the robot working: standing at the acquisition, every brake open, its servo holding
double working_power() {
  Plant physics(scene());
  Robot robot(physics.model_ptr());
  JointServo servo(robot, model_servo_gains(joint_actuators(robot)), physics.dt());
  physics.reset(physics.find_keyframe("acquisition"));
  robot.set_qpos(std::as_const(physics).qpos());
  const Vector place = robot.configuration();
  servo.reset(std::as_const(physics).qpos());
  PowerMeter meter(physics.model());
  for (int i = 0; i < 3000; ++i) {
    hold_posture(servo, physics, place);
    physics.step();
    meter.read(physics.data(), physics.brakes(), physics.drive_train());
  }
  return meter.total();
}

TEST(DrivePower, OfAMissionIsFrictionAndDampingAndTwoHoursAreInTheBattery) {
  Vehicle vehicle(scene());
  vehicle.go(400.0);
  EXPECT_NEAR(vehicle.physics.qpos()[0], 400.0, 1.0);
  EXPECT_LT(vehicle.moved(), 1e-3);  // arms, legs and trunk without power
  EXPECT_LT(vehicle.most_power, 2.0 * 7950.0);

  // rolling resistance of both driven belts, damping 0.1 N m s/rad on each of four: over a ramp up
  // to v, a cruise and a ramp down
  const double cruise = 400.0 / kSpeed - kSpeed / kAcceleration;
  const double square = kSpeed * kSpeed * (cruise + 2.0 / 3.0 * kSpeed / kAcceleration);
  const double lost = 2.0 * kRolling * 400.0 / kRadius + 0.4 * square / (kRadius * kRadius);
  EXPECT_NEAR(vehicle.work, lost, 0.02 * lost);
  // what braking gives is burnt: more than the net work, and less than that and all of m v^2 / 2
  EXPECT_GT(vehicle.electric, lost / 0.9);
  // through a transmission of 0.92, and 78 s with 36 of 200 N m heat the windings by 12 kJ
  EXPECT_LT(vehicle.electric, (lost + 0.5 * 700.0 * kSpeed * kSpeed) / (0.9 * 0.92) + 15e3);

  Battery battery;
  const double working = working_power(), driving = 14.0 * vehicle.seconds;
  battery.draw(14.0 * vehicle.energy / driving, driving);
  battery.draw(working, 7200.0 - driving);
  RecordProperty("drive_400_m_J", static_cast<int>(vehicle.energy));
  RecordProperty("working_W", static_cast<int>(working));
  RecordProperty("charge_percent", static_cast<int>(100.0 * battery.charge()));
  std::printf(
      "400 m: %.1f s, %.1f kJ work, %.1f kJ electric, %.1f kJ in all, at most %.0f W; moved "
      "%.1e rad; working %.0f W; after 2 h %.1f %%\n",
      vehicle.seconds, 1e-3 * vehicle.work, 1e-3 * vehicle.electric, 1e-3 * vehicle.energy,
      vehicle.most_power, vehicle.moved(), working, 100.0 * battery.charge());
  EXPECT_GT(battery.charge(), 0.1);
}

TEST(DrivePower, IsNoneForTheArmsOverBoards) {
  Vehicle vehicle(scene(R"(<geom class="terrain" type="box" size="0.1 1 0.02" pos="2 0 0.02"/>
      <geom class="terrain" type="box" size="0.1 1 0.02" pos="4 0 0.02"/>)"));
  double jolt = 0.0;  // [m/s^2] of the base, up
  for (int i = 0; i < 6000; ++i) {
    vehicle.step(std::min(1e-3 * i, 1.0));
    jolt = std::max(jolt, vehicle.physics.data()->qacc[2]);
  }
  EXPECT_GT(vehicle.physics.qpos()[0], 4.3);  // it went over both
  EXPECT_GT(jolt, 20.0);                      // 45, on rigid tracks 135
  std::printf("boards: shoulders %.1e, elbows %.1e, all %.1e rad; jolt %.0f m/s^2\n",
              vehicle.moved('S'), vehicle.moved('E'), vehicle.moved(), jolt);
  EXPECT_LT(vehicle.moved('S'), 1e-4);
  // 2.5 mrad: a lower arm falls back on the stop of its spring, and the brake slips at the knock
  EXPECT_LT(vehicle.moved('E'), 5e-3);
}

}  // namespace

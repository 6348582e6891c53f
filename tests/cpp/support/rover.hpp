// The rescue robot that drives: every joint braked but the belts, which keep a speed by a plain
// proportional law as far as their drive trains allow.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/plant.hpp"
#include "hurcules/sim/power_meter.hpp"
#include "support/models.hpp"

namespace hurcules_test {

struct Ground {
  double slope = 0.0;                   // [rad]; gravity is turned, the ground stays
  std::array<double, 2> up{-1.0, 0.0};  // downhill in the plane: the robot, along x, looks up
  double friction = 0.9;
  double payload = 0.0;   // [kg] on the trunk
  std::string more = {};  // MJCF of further ground
};

inline hurcules::ModelPtr rover_scene(const Ground& ground) {
  const double sine = 9.81 * std::sin(ground.slope);
  const std::string gravity = std::to_string(sine * ground.up[0]) + " " +
                              std::to_string(sine * ground.up[1]) + " " +
                              std::to_string(-9.81 * std::cos(ground.slope));
  hurcules::ModelPtr model = hurcules::load_model_text(
      R"(<mujoco><include file="../robots/rescue.xml"/><include file="flat.xml"/>
         <option gravity=")" +
          gravity + R"("/><worldbody>)" + ground.more + "</worldbody></mujoco>",
      models("/scenes"));
  for (int i = 0; i < model->ngeom; ++i) {
    if (model->geom_contype[i] == 2) model->geom_friction[3 * i] = ground.friction;
  }
  model->body_mass[mj_name2id(model.get(), mjOBJ_BODY, "torso")] += ground.payload;
  return model;
}

class Rover {
 public:
  explicit Rover(const Ground& ground = {}, const std::string& key = "drive")
      : physics(rover_scene(ground)), meter(physics.model()) {
    start(key);
  }
  void start(const std::string& key) {
    physics.reset(physics.find_keyframe(key));
    physics.brakes().reset(true);
    for (std::size_t side = 0; side < 2; ++side) {
      const char* const belt = side == 0 ? "L_lower_belt" : "R_lower_belt";
      drive[side] = physics.brakes().find(belt);
      dof_[side] = m().jnt_dofadr[m().actuator_trnid[2 * drive[side]]];
      physics.brakes().set_closed(drive[side], false);
    }
    physics.brakes().advance(physics.data());
  }
  void brake_belts() {
    for (const int belt : drive) physics.brakes().set_closed(belt, true);
    rests = true;
  }
  // one tick with the belts' surfaces at these speeds [m/s]
  void step(double left, double right, double gain = 800.0) {
    const std::array<double, 2> wanted{left / kRadius, right / kRadius};
    for (std::size_t side = 0; side < 2; ++side) {
      d().ctrl[drive[side]] = rests ? 0.0 : gain * (wanted[side] - belt(side));
    }
    physics.step();
    meter.read(physics.data(), physics.brakes(), physics.drive_train());
    work += 1e-3 * meter.mechanical();
    energy += 1e-3 * meter.motors();
  }
  void go(double left, double right, double seconds) {
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) step(left, right);
  }
  [[nodiscard]] double belt(std::size_t side) const { return physics.data()->qvel[dof_[side]]; }
  [[nodiscard]] const mjModel& m() const { return *physics.model(); }
  [[nodiscard]] mjData& d() { return *physics.data(); }
  // [kg] of all there is
  [[nodiscard]] double mass() const { return mj_getTotalmass(&m()); }
  [[nodiscard]] const mjtNum* centre() const {
    return physics.data()->subtree_com + 3 * mj_name2id(&m(), mjOBJ_BODY, "upper_legs");
  }
  // of all four tracks together
  [[nodiscard]] hurcules::TrackReading ground() const {
    hurcules::TrackReading sum;
    for (std::size_t i = 0; i < physics.tracks().belts().size(); ++i) {
      const hurcules::TrackReading one = physics.tracks().read(&m(), physics.data(), i);
      sum.load += one.load;
      sum.traction += one.traction;
      sum.slip += one.load * one.slip;
      sum.speed += one.load * one.speed;
    }
    sum.slip /= sum.load;
    sum.speed /= sum.load;
    return sum;
  }

  static constexpr double kRadius = 0.14;
  hurcules::Plant physics;
  hurcules::PowerMeter meter;
  std::array<int, 2> drive{};
  bool rests = false;
  double work = 0.0, energy = 0.0;  // [J] of the motors: mechanical, electric

 private:
  std::array<int, 2> dof_{};
};

}  // namespace hurcules_test

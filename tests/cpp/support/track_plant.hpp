// The smallest tracked vehicle: two belts with inertia, traction that saturates at friction, and
// turning that slips. Integrated here, no physics engine.
//
//   F = clamp(grip (r w - u), +-limit), u the ground speed under a belt
//   m dv/dt = F_L + F_R - m g sin(slope),   J dw/dt = torque - r F
//   with turning resisted by a force on each belt, backward outside, forward inside
//   omega = skid (F-free kinematics): it follows skid (r w_R - r w_L) / gauge within 0.05 s
#pragma once

#include <algorithm>
#include <cmath>

#include "hurcules/control/drive_controller.hpp"

namespace hurcules_test {

struct TrackPlant {
  double radius = 0.14, gauge = 0.67, mass = 680.0, inertia = 0.85;
  double grip = 200e3;  // [N s/m] so stiff that it creeps down a slope of 0.3 rad by 5 mm/s
  double friction = 0.9;
  double skid = 0.75;     // yaw rate over what the belts ask for
  double slope = 0.0;     // [rad] uphill ahead
  double scrub = 0.0;     // [N] on each belt that resists turning
  double sideways = 0.0;  // [m/s] drift to the left for each rad/s of turning
  hurcules::DriveState state;
  bool stuck = false;  // behind an obstacle: the body stands

  void step(const hurcules::DriveTorques& torques, double dt) {
    constexpr double kGravity = 9.81;
    const double limit = friction * mass * kGravity * std::cos(slope) / 2.0;
    const double turn = state.yaw_rate * gauge / skid / 2.0;
    double pull = 0.0;
    for (const bool is_left : {true, false}) {
      double& rate = is_left ? state.left : state.right;
      const double ground = state.speed + (is_left ? -turn : turn);
      // implicit in the belt's rate, for grip r^2 / J is fast
      const double load = radius * scrub * std::tanh(state.yaw_rate / 0.01);
      const double torque = is_left ? torques.left + load : torques.right - load;
      const double stiff = dt * grip * radius / inertia;
      double next = (rate + dt * torque / inertia + stiff * ground) / (1.0 + stiff * radius);
      double force = grip * (radius * next - ground);
      if (std::abs(force) > limit) {
        force = std::copysign(limit, force);
        next = rate + dt * (torque - radius * force) / inertia;
      }
      rate = torques.brake ? 0.0 : next;
      if (torques.brake) force = std::clamp(-grip * ground, -limit, limit);
      pull += force;
    }
    const double accel = pull / mass - kGravity * std::sin(slope);
    state.speed = stuck ? 0.0 : state.speed + dt * accel;
    const double asked = skid * radius * (state.right - state.left) / gauge;
    state.yaw_rate += dt / 0.05 * (asked - state.yaw_rate);
    hurcules::PlanarPose& pose = state.pose;
    const double drift = sideways * state.yaw_rate;
    pose.x += dt * (state.speed * std::cos(pose.yaw) - drift * std::sin(pose.yaw));
    pose.y += dt * (state.speed * std::sin(pose.yaw) + drift * std::cos(pose.yaw));
    pose.yaw += dt * state.yaw_rate;
  }
};

}  // namespace hurcules_test

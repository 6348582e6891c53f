// The contact force on a link that hangs on a spring, from the deflection of the spring.
//
// A hinge without motor, held by a spring between stops, carries the links behind it:
//   I dds + d ds = k (s_0 - s) + m_g + m_c
// with m_g the moment of their weight, m_c that of the contact, I their inertia. At rest, and
// slowly enough that I dds is small, the contact follows from what is sensed:
//   m_c = d ds - k (s_0 - s) - m_g,   f = m_c / r
// with r the lever of the point where the contact is supposed. At a stop the spring no longer
// tells: the stop bears a share that nobody measures.
#pragma once

#include <memory>
#include <string>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

class SpringForce {
 public:
  // joint: a hinge with stiffness; frame: where the contact is, a site or body behind the joint.
  // Throws Error for names that do not exist, or a joint that is no spring hinge.
  SpringForce(ModelPtr model, const std::string& joint, const std::string& frame);
  SpringForce(const SpringForce& other);

  // what is sensed: qpos (nq), qvel (nv). Allocates nothing.
  void update(const ConstVectorRef& qpos, const ConstVectorRef& qvel);

  [[nodiscard]] Index positions() const;   // nq
  [[nodiscard]] Index velocities() const;  // nv

  [[nodiscard]] double deflection() const { return deflection_; }  // s [rad]
  [[nodiscard]] double moment() const { return moment_; }          // m_c [N m], about the joint
  // [N] at the frame, across its lever, positive where the joint gives way
  [[nodiscard]] double force() const { return moment_ / lever_; }
  [[nodiscard]] double lever() const { return lever_; }  // r [m]
  // direction of that force in W, (3)
  [[nodiscard]] const Vector3& direction() const { return direction_; }
  // the moment is not the contact's alone: the joint rests on a stop
  [[nodiscard]] bool at_stop() const;

 private:
  ModelPtr model_;
  std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
  int joint_ = -1, frame_ = -1;
  bool is_site_ = false;
  double deflection_ = 0.0, moment_ = 0.0, lever_ = 1.0;
  Vector3 direction_ = Vector3::Zero();
};

}  // namespace hurcules

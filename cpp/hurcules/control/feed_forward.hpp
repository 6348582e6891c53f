// What the plan takes is told to its servos, which then correct what the model does not know.
//
//   tau = M(q*) qdd* + h(q*, qdot*)          and the servos' own feedback beside it
//   tau = M(q*) (qdd* + a) + h(q*, qdot*)    decoupled: a [rad/s^2] is what the servos ask for, so
//                                            that no joint's motion disturbs another
//
// Inverse dynamics control; Siciliano et al., Robotics (2009), section 8.5.2.
#pragma once

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/control/joint_servo.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

class FeedForward {
 public:
  FeedForward() = default;
  FeedForward(const JointServo& servo, Index coordinates, bool decoupled, double dt);
  void reset() { last_qd_.setZero(); }  // at rest

  // What it takes to be at q* of the plan and to go at qdot* (n). `commanded`: its change is an
  // acceleration that somebody commands. A velocity that is solved for or scaled down may jump: what
  // that takes is left to the servos. Without what is sensed no servo asks for anything.
  void tell(Robot& plan, const Vector& qd, bool commanded, const RobotState* state,
            JointServo& servo);
  // Tells it without acceleration, for the scaling by torque. Returns how many times its own feedback
  // a decoupled servo asks for (n) as the reference of one coordinate moves and the others stay: at
  // most D_kk / J_k, D the sums of the rows' magnitudes of M, J the rated inertia. D >= M, so that all
  // of them together, each within what is left to its motor, do not ask for more and swing.
  const Vector& tell_growth(Robot& plan, const Vector& qd, const RobotState& state,
                            JointServo& servo);
  // what the plan takes at its velocity now, and by how much that was more than it is now (n) [N m]
  void note(const Robot& plan);
  const Vector& noted_beyond(const Robot& plan);

  void save(StateWriter& writer) const { writer.put(last_qd_); }
  void restore(StateReader& reader) { reader.get(last_qd_); }

 private:
  // efforts = M (qdd + a) + h, feedback included
  void decouple(const Robot& plan, const RobotState& state, JointServo& servo);

  bool decoupled_ = false;
  double dt_ = 0.0;
  Vector rated_;                 // (n) [kg m^2]
  Vector last_qd_, growth_;      // (n)
  Vector qdd_, efforts_;         // (n) scratch
  Vector feedback_, asked_for_;  // (n) scratch: [N m], [rad/s^2] of the servos
  Matrix inertia_;               // (n, n) scratch
};

}  // namespace hurcules

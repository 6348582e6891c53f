// The robust joint servo: a PID that is inverse-optimal in the H-infinity sense.
//
//   tau = (K + I / gamma^2) (de/dt + K_P e + K_I int e dt),   e = q_d - q     [T A.2.12], tau = -u
//
// It needs no model and no gravity: whatever the robot carries is a disturbance that the L2 gain
// gamma bounds. Where a model is there, the torque that it tells (gravity alone, or the whole
// inverse dynamics: Robot::inverse_dynamics) can be fed forward; the law then bears what the model
// misses. The torque saturates joint by joint. Anti-windup is conditional integration: while a
// torque is saturated, an error that would push it further is not integrated. It needs no gain of
// its own, and it leaves the law untouched below saturation.
#pragma once

#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/robot/motor.hpp"

namespace hurcules {

struct JointPidOptions {
  Vector K;            // [N m s/rad], (m), > 0: state weight, trades accuracy against torque
  Vector K_P;          // [1/s], (m), > 0
  Vector K_I;          // [1/s^2], (m), > 0, with K_P^2 > 2 K_I       [T A.2.9]
  double gamma = 1.0;  // > 0: L2 gain from disturbance to error, 1/gamma^2 in [N m s/rad]
  Vector max_torque;   // [N m], (m), > 0: saturation; inf for none
  double dt = 1e-3;    // [s]
};

// Gains for a joint that carries the inertia J and shall have the bandwidth omega:
//   K + 1/gamma^2 = 3 omega J,  K_P = omega,  K_I = omega^2 / 3
// so that a rigid joint, J d2q = tau, has the triple pole -omega: aperiodic, and
// K_P^2 = 3 K_I > 2 K_I. A load step d bends it by at most 0.27 d / (J omega^2), a load ramp by
// ramp / (J omega^3).
struct JointDrive {
  double inertia = 0.0;     // [kg m^2] felt by the joint, its rotor included
  double bandwidth = 0.0;   // [rad/s]
  double max_torque = 0.0;  // [N m]
};
[[nodiscard]] JointPidOptions triple_pole(const std::vector<JointDrive>& drives, double dt);

// e and de/dt of all joints.
struct JointError {
  Vector position;  // [rad], (m)
  Vector velocity;  // [rad/s], (m)
};

class JointPid {
 public:
  explicit JointPid(JointPidOptions options);
  // [N m], (m); the reference stays valid until the next compute
  const Vector& compute(const JointError& error);
  // the same beside a torque that a model tells, [N m], (m); both saturate together
  const Vector& compute(const JointError& error, const ConstVectorRef& feed_forward);
  // what compute will ask of joint i at this error, feed-forward and saturation left out [N m]
  [[nodiscard]] double feedback(Index i, const JointError& error) const;
  // saturation of joint i from now on, never beyond max_torque; 0 to 0 for a drive that is off
  void limit(Index i, const EffortRange& range);
  // goes on from a torque that somebody else gave: at this error joint i's next demand is `torque`
  // [N m], and the integral takes it from there
  void take_over(Index i, const JointError& error, double torque);
  // joint i's demand goes up by so much from now on [N m], as if the integral had grown
  void add(Index i, double torque) { integral_[i] += torque / (gain_[i] * options_.K_I[i]); }
  // the velocity of the reference, 0 in `error`, at which joint i would ask for this torque [N m]
  // in this period: [rad/s]
  [[nodiscard]] double rate_at(Index i, const JointError& error, double torque) const;

  [[nodiscard]] Index size() const { return torque_.size(); }
  [[nodiscard]] const JointPidOptions& options() const { return options_; }
  [[nodiscard]] const Vector& torque() const { return torque_; }  // [N m], (m), of the last compute
  [[nodiscard]] const Vector& demand() const { return demand_; }  // [N m], (m), before saturation
  [[nodiscard]] const Vector& integral() const { return integral_; }  // [rad s], (m)
  // joint i's integral is 0 from now on
  void forget(Index i) { integral_[i] = 0.0; }
  // at rest, without memory
  void reset();
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void compute_joint(Index i, const JointError& error, double feed_forward);

  JointPidOptions options_;
  Vector gain_;  // K + I / gamma^2
  Vector integral_, demand_, torque_;
  Vector lower_, upper_;  // [N m] saturation of the moment
};

}  // namespace hurcules

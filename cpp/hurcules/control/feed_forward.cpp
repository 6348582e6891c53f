#include "hurcules/control/feed_forward.hpp"

namespace hurcules {

FeedForward::FeedForward(const JointServo& servo, Index coordinates, bool decoupled, double dt)
    : decoupled_(decoupled),
      dt_(dt),
      rated_(Vector::Zero(coordinates)),
      last_qd_(rated_),
      growth_(Vector::Ones(coordinates)),
      qdd_(rated_),
      efforts_(rated_),
      feedback_(rated_),
      asked_for_(rated_),
      inertia_(coordinates, coordinates) {
  servo.rated_inertia(rated_);
}

void FeedForward::tell(Robot& plan, const Vector& qd, bool commanded, const RobotState* state,
                       JointServo& servo) {
  if (commanded) {
    qdd_ = (qd - last_qd_) / dt_;
  } else {
    qdd_.setZero();
  }
  last_qd_ = qd;
  plan.set_velocity(qd);
  if (decoupled_ && state) {
    decouple(plan, *state, servo);
    efforts_ -= feedback_;
  } else {
    plan.inverse_dynamics(qdd_, efforts_);
  }
  servo.feed_forward(efforts_, decoupled_);  // dry friction would shake those that are not
}

const Vector& FeedForward::tell_growth(Robot& plan, const Vector& qd, const RobotState& state,
                                       JointServo& servo) {
  qdd_.setZero();
  plan.set_velocity(qd);
  decouple(plan, state, servo);
  plan.mass_matrix(inertia_);
  for (Index k = 0; k < growth_.size(); ++k) {
    if (rated_[k] > 0.0) growth_[k] = inertia_.row(k).lpNorm<1>() / rated_[k];
  }
  efforts_ -= growth_.cwiseProduct(feedback_);
  servo.feed_forward(efforts_, true);
  return growth_;
}

void FeedForward::decouple(const Robot& plan, const RobotState& state, JointServo& servo) {
  servo.feedback(state, feedback_, asked_for_);
  if (!plan.floats()) qdd_ += asked_for_;
  plan.inverse_dynamics(qdd_, efforts_);
  if (!plan.floats()) return;
  plan.floating_inertia(asked_for_, qdd_);
  efforts_ += qdd_;
}

void FeedForward::note(const Robot& plan) {
  qdd_.setZero();
  plan.inverse_dynamics(qdd_, feedback_);
}

const Vector& FeedForward::noted_beyond(const Robot& plan) {
  plan.inverse_dynamics(qdd_, efforts_);
  return feedback_ -= efforts_;
}

}  // namespace hurcules

#include "hurcules/control/joint_pid.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

bool positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

std::string at_joint(Index i) {
  return " at joint " + std::to_string(i);
}

void check(const JointPidOptions& options) {
  const Index m = options.K.size();
  require(options.K_P.size() == m && options.K_I.size() == m && options.max_torque.size() == m,
          "K, K_P, K_I and max_torque want the same size; K has " + std::to_string(m));
  require_number(positive(options.gamma), "gamma wants a positive number", options.gamma);
  require_number(positive(options.dt), "dt wants a positive time [s]", options.dt);
  for (Index i = 0; i < m; ++i) {
    require(positive(options.K[i]) && positive(options.K_P[i]) && positive(options.K_I[i]),
            "K, K_P and K_I want positive numbers" + at_joint(i));  // [T A.2.9]
    require(
        options.K_P[i] * options.K_P[i] > 2.0 * options.K_I[i],
        "the servo is robust only for K_P^2 > 2 K_I; got K_P = " + std::to_string(options.K_P[i]) +
            ", K_I = " + std::to_string(options.K_I[i]) + at_joint(i));  // [T A.2.9]
    require_number(options.max_torque[i] > 0.0,
                   "max_torque" + at_joint(i) + " wants a positive number", options.max_torque[i]);
  }
}

}  // namespace

JointPidOptions triple_pole(const std::vector<JointDrive>& drives, double dt) {
  const auto m = static_cast<Index>(drives.size());
  JointPidOptions options;
  options.dt = dt;
  for (Vector* values : {&options.K, &options.K_P, &options.K_I, &options.max_torque}) {
    values->resize(m);
  }
  // K stays positive: gamma is 1, or as large as the softest joint needs
  double softest = 2.0;
  for (const JointDrive& drive : drives) {
    softest = std::min(softest, 3.0 * drive.bandwidth * drive.inertia);
  }
  if (softest > 0.0) options.gamma = 1.0 / std::sqrt(std::min(1.0, 0.5 * softest));
  for (Index i = 0; i < m; ++i) {
    const JointDrive& drive = drives[static_cast<std::size_t>(i)];
    const double omega = drive.bandwidth;
    options.K[i] = 3.0 * omega * drive.inertia - 1.0 / (options.gamma * options.gamma);
    options.K_P[i] = omega;
    options.K_I[i] = omega * omega / 3.0;
    options.max_torque[i] = drive.max_torque;
  }
  return options;
}

JointPid::JointPid(JointPidOptions options) : options_(std::move(options)) {
  check(options_);
  gain_ = options_.K.array() + 1.0 / (options_.gamma * options_.gamma);
  integral_ = demand_ = torque_ = Vector::Zero(gain_.size());
  lower_ = -options_.max_torque;
  upper_ = options_.max_torque;
}

void JointPid::limit(Index i, const EffortRange& range) {
  lower_[i] = std::max(range.lower, -options_.max_torque[i]);
  upper_[i] = std::min(range.upper, options_.max_torque[i]);
}

void JointPid::take_over(Index i, const JointError& error, double torque) {
  const double e = error.position[i];
  const double integral =
      (torque / gain_[i] - error.velocity[i] - options_.K_P[i] * e) / options_.K_I[i];
  integral_[i] = integral - e * options_.dt;  // compute adds this period's
}

double JointPid::rate_at(Index i, const JointError& error, double torque) const {
  const double dt = options_.dt, e = error.position[i];
  const double at_rest = error.velocity[i] + options_.K_P[i] * e +
                         options_.K_I[i] * (integral_[i] + e * dt);  // demand over gain
  return torque / gain_[i] - at_rest;
}

const Vector& JointPid::compute(const JointError& error) {
  for (Index i = 0; i < size(); ++i) compute_joint(i, error, 0.0);
  return torque_;
}

const Vector& JointPid::compute(const JointError& error, const ConstVectorRef& feed_forward) {
  for (Index i = 0; i < size(); ++i) compute_joint(i, error, feed_forward[i]);
  return torque_;
}

double JointPid::feedback(Index i, const JointError& error) const {
  const double e = error.position[i];
  const double integral = integral_[i] + e * options_.dt;
  return gain_[i] * (error.velocity[i] + options_.K_P[i] * e +
                     options_.K_I[i] * integral);  // [T A.2.12], tau = -u
}

void JointPid::compute_joint(Index i, const JointError& error, double feed_forward) {
  const double e = error.position[i];
  const double integral = integral_[i] + e * options_.dt;
  demand_[i] = feed_forward + feedback(i, error);
  torque_[i] = std::clamp(demand_[i], lower_[i], upper_[i]);
  // a saturated joint keeps its integral unless the error leads back
  const bool deeper = torque_[i] != demand_[i] && (e > 0.0) == (demand_[i] > 0.0);
  if (!deeper) integral_[i] = integral;
}

void JointPid::reset() {
  integral_.setZero();
  demand_.setZero();
  torque_.setZero();
}

void JointPid::save(StateWriter& writer) const {
  writer.put(integral_);
}

void JointPid::restore(StateReader& reader) {
  reader.get(integral_);
}

}  // namespace hurcules

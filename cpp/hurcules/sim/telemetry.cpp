#include "hurcules/sim/telemetry.hpp"

namespace hurcules {

namespace {

const std::vector<std::string>& axes() {
  static const std::vector<std::string> names = {"x", "y", "z"};
  return names;
}

Vector zeros(const std::vector<std::string>& names) {
  return Vector::Zero(static_cast<Index>(names.size()));
}

}  // namespace

Telemetry::Telemetry(const TelemetryNames& names) {
  for (Vector* values : {&q, &qd, &seen_q, &seen_qd, &q_des, &qd_des, &lag, &limit_lower,
                         &limit_upper, &limit_speed, &to_lower, &to_upper, &active}) {
    *values = zeros(names.coordinates);
  }
  for (Vector* values : {&torque, &demand, &joint_error}) *values = zeros(names.joints);
  for (Vector* values : {&level_error, &level_error_measured, &level_active}) {
    *values = zeros(names.levels);
  }
  for (Vector* values : {&task_error, &task_error_measured}) *values = zeros(names.task_rows);
  for (Vector* values : {&base_position, &base_rotation, &seen_base_position, &seen_base_rotation,
                         &base_velocity, &base_spin, &target_in_base}) {
    *values = zeros(axes());
  }
  command = zeros(names.commands);
  for (Vector* values : {&force, &contact}) *values = zeros(names.forces);
}

void Telemetry::clear() {
  for (Vector* values : {&q,
                         &qd,
                         &seen_q,
                         &seen_qd,
                         &q_des,
                         &qd_des,
                         &lag,
                         &limit_lower,
                         &limit_upper,
                         &limit_speed,
                         &to_lower,
                         &to_upper,
                         &active,
                         &torque,
                         &demand,
                         &joint_error,
                         &level_error,
                         &level_error_measured,
                         &level_active,
                         &task_error,
                         &task_error_measured,
                         &command,
                         &force,
                         &contact,
                         &base_position,
                         &base_rotation,
                         &seen_base_position,
                         &seen_base_rotation,
                         &base_velocity,
                         &base_spin,
                         &target_in_base}) {
    values->setZero();
  }
  for (double* value : {&time, &phase, &factorizations, &changes, &iterations, &status, &optimality,
                        &power, &charge, &yielding, &tracking_error, &link_age, &tick_us}) {
    *value = 0.0;
  }
}

void Telemetry::add_log_channels(const TelemetryNames& names, Recorder& recorder) const {
  recorder.add("time", &time);
  recorder.add("phase", &phase);
  recorder.add("q", names.coordinates, q);
  recorder.add("qd", names.coordinates, qd);
  recorder.add("q_des", names.coordinates, q_des);
  recorder.add("qd_des", names.coordinates, qd_des);
  recorder.add("limit_lower", names.coordinates, limit_lower);
  recorder.add("limit_upper", names.coordinates, limit_upper);
  recorder.add("limit_speed", names.coordinates, limit_speed);
  recorder.add("active", names.coordinates, active);
  recorder.add("torque", names.joints, torque);
  recorder.add("joint_error", names.joints, joint_error);
  recorder.add("error", names.levels, level_error);
  recorder.add("measured_error", names.levels, level_error_measured);
  recorder.add("active_rows", names.levels, level_active);
  recorder.add("command", names.commands, command);
  recorder.add("force", names.forces, force);
  recorder.add("contact", names.forces, contact);
  recorder.add("base", axes(), base_position);
  recorder.add("base_rotation", axes(), base_rotation);
  recorder.add("base_velocity", axes(), base_velocity);
  recorder.add("power", &power);
  recorder.add("charge", &charge);
  recorder.add("factorizations", &factorizations);
  recorder.add("iterations", &iterations);
  recorder.add("changes", &changes);
  recorder.add("optimality", &optimality);
  recorder.add("status", &status);
  recorder.add("yielding", &yielding);
  recorder.add("tracking_error", &tracking_error);
  recorder.add("link_age", &link_age);
}

void Telemetry::add_observation_channels(const TelemetryNames& names, Recorder& recorder) const {
  recorder.add("q", names.coordinates, seen_q);
  recorder.add("qd", names.coordinates, seen_qd);
  recorder.add("lag", names.coordinates, lag);
  recorder.add("to_lower", names.coordinates, to_lower);
  recorder.add("to_upper", names.coordinates, to_upper);
  recorder.add("task_error", names.task_rows, task_error_measured);
  recorder.add("active_rows", names.levels, level_active);
  recorder.add("base", axes(), seen_base_position);
  recorder.add("base_rotation", axes(), seen_base_rotation);
  recorder.add("base_velocity", axes(), base_velocity);
  recorder.add("base_spin", axes(), base_spin);
  recorder.add("target_in_base", axes(), target_in_base);
}

}  // namespace hurcules

#include "hurcules/mission/stretch_figures.hpp"

#include <cmath>
#include <limits>

namespace hurcules {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// at the end, measured: joint errors of 0.4 degrees [T §A.3] at 2 m, and what the ground gives way
constexpr double kHandTolerance = 0.02;   // [m]
constexpr double kPitchTolerance = 0.02;  // [rad]

// in the order of the table below
enum : std::size_t {
  kHipLocked,
  kHipReleased,
  kShoulderLocked,
  kPelvisCommanded,
  kPelvisMeasured,
  kPelvisAtHip,
  kPelvisAtShoulder,
  kHand,
  kHandMeasured,
  kHandFinal,
  kPitch,
  kPitchMeasured,
  kPitchFinal,
  kGazeCommanded,
  kGazeMeasured,
  kJoint,
  kJointTime,
  kStretched,
  kTorqueExcess,
};

// Times from the start of the stretch; errors commanded, unless the name says measured or final.
std::vector<Figure> table() {
  return {
      {"hip_locked_s", kNone, 15.0},
      {"hip_released_s", kNone, 25.0},  // the last time
      {"shoulder_locked_s", kNone, 25.0},
      {"pelvis_error_m", kNone, 0.40},  // at the end
      {"pelvis_error_measured_m", kNone, kNone},
      {"pelvis_error_at_hip_locked_m", kNone, kNone},
      {"pelvis_error_at_shoulder_locked_m", kNone, kNone},
      {"hand_error_max_m", kNone, kNone},
      {"hand_error_measured_max_m", kNone, kNone},
      {"hand_error_final_m", kNone, kNone},
      {"pitch_error_max_rad", kNone, kNone},
      {"pitch_error_measured_max_rad", kNone, kNone},
      {"pitch_error_final_rad", kNone, kNone},
      {"gaze_error_max_rad", kNone, kNone},
      {"gaze_error_measured_max_rad", kNone, kNone},
      {"joint_error_max_rad", kNone, 6.98e-3},  // 0.4 degrees [T §A.3]
      {"joint_error_max_s", kNone, kNone},
      {"stretched_m", kNone, kNone},
      {"torque_excess_max_nm", kNone, kNone},
  };
}

}  // namespace

StretchFigures::StretchFigures(const Robot& robot, std::vector<Figure>& figures)
    : figures_(figures),
      joints_{robot.coordinate("HIP"), robot.coordinate("LSP"), robot.coordinate("RSP")} {
  figures_ = table();
}

void StretchFigures::reset() {
  start_ = 0.0;
  hip_locked_ = false;
}

void StretchFigures::note_commanded(const TickReport& report, const StretchErrors& errors) {
  note_limits(report, errors.pelvis);
  set(kPelvisCommanded, errors.pelvis);
  raise(kHand, errors.hand);
  raise(kPitch, errors.pitch);
  raise(kGazeCommanded, errors.gaze);
}

void StretchFigures::note_measured(const TickReport& report, const StretchErrors& errors) {
  set(kPelvisMeasured, errors.pelvis);
  raise(kHandMeasured, errors.hand);
  raise(kPitchMeasured, errors.pitch);
  raise(kGazeMeasured, errors.gaze);
  set(kHandFinal, errors.hand);
  set(kPitchFinal, errors.pitch);
  raise(kTorqueExcess, report.torque_excess);
  if (is_unset(kJoint) || report.joint_error > figures_[kJoint].value) {
    set(kJoint, report.joint_error);
    set(kJointTime, report.time - start_);
  }
}

void StretchFigures::note_stretched(double length) {
  set(kStretched, length);
}

void StretchFigures::note_limits(const TickReport& report, double pelvis) {
  const Eigen::VectorXi& active = report.active_limits;
  const double now = report.time - start_;
  const bool hip = active[joints_.hip] > 0;
  const bool shoulder = active[joints_.left_shoulder] > 0 || active[joints_.right_shoulder] > 0;
  if (hip && is_unset(kHipLocked)) {
    set(kHipLocked, now);
    set(kPelvisAtHip, pelvis);
  }
  if (hip_locked_ && !hip) set(kHipReleased, now);
  if (shoulder && is_unset(kShoulderLocked)) {
    set(kShoulderLocked, now);
    set(kPelvisAtShoulder, pelvis);
  }
  hip_locked_ = hip;
}

std::string_view StretchFigures::verdict() const {
  if (!(figures_[kHandFinal].value <= kHandTolerance)) return "hands off their references";
  if (!(figures_[kPitchFinal].value <= kPitchTolerance)) return "lower arms off their pitch";
  if (!(figures_[kTorqueExcess].value <= 0.0)) return "a motor saturated";
  return "";
}

void StretchFigures::save(StateWriter& writer) const {
  writer.put(start_);
  writer.put(hip_locked_ ? 1.0 : 0.0);
}

void StretchFigures::restore(StateReader& reader) {
  start_ = reader.get();
  hip_locked_ = reader.get() > 0.0;
}

void StretchFigures::raise(std::size_t figure, double value) {
  if (is_unset(figure) || value > figures_[figure].value) set(figure, value);
}

bool StretchFigures::is_unset(std::size_t figure) const {
  return std::isnan(figures_[figure].value);
}

}  // namespace hurcules

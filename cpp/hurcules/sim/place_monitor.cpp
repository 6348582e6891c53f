#include "hurcules/sim/place_monitor.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/sim/readings.hpp"

namespace hurcules {

namespace {

int thing_id(const mjModel* m, mjtObj kind, const std::string& name) {
  return require_id(m, kind, name, "a watched thing");
}

// level, of length 1
Vector3 level(const Vector3& v) {
  return Vector3(v.x(), v.y(), 0.0).normalized();
}

}  // namespace

const std::vector<std::string>& PlaceMonitor::names() {
  static const std::vector<std::string> all = {
      "ahead_m",           "aside_m",        "heading_rad",        "stand_ahead_m",
      "stand_rad",         "hands_ahead_m",  "hands_aside_m",      "left_hand_ahead_m",
      "left_hand_aside_m", "left_hand_up_m", "right_hand_ahead_m", "right_hand_aside_m",
      "right_hand_up_m"};
  return all;
}

PlaceMonitor::PlaceMonitor(const mjModel* m, const std::string& body, double stand_off)
    : body_(thing_id(m, mjOBJ_BODY, body)),
      robot_(thing_id(m, mjOBJ_BODY, "upper_legs")),
      eyes_(thing_id(m, mjOBJ_SITE, "gaze")),
      tips_{thing_id(m, mjOBJ_SITE, "L_tcp"), thing_id(m, mjOBJ_SITE, "R_tcp")},
      places_{mj_name2id(m, mjOBJ_SITE, (body + "_left").c_str()),
              mj_name2id(m, mjOBJ_SITE, (body + "_right").c_str())},
      stand_off_(stand_off) {
  require(stand_off_ >= 0.0 && std::isfinite(stand_off_),
          "a watched thing wants a stand-off >= 0, " + number_text(stand_off_) + " m came");
  require((places_[0] < 0) == (places_[1] < 0),
          "'" + body + "' wants places to grasp on both sides, or none");
  values_ = Vector::Zero(places_[0] < 0 ? kPlaces : kQuantities);
}

void PlaceMonitor::add_log_channels(Recorder& log, const std::string& prefix) const {
  const auto begin = names().begin();
  log.add(prefix, std::vector<std::string>(begin, begin + values_.size()), values_);
}

void PlaceMonitor::save(StateWriter& writer) const {
  for (const Vector* vector : {&error_, &values_}) writer.put(*vector);
}

void PlaceMonitor::restore(StateReader& reader) {
  for (Vector* vector : {&error_, &values_}) reader.get(*vector);
}

void PlaceMonitor::look(const mjModel* /*m*/, const mjData* d) {
  const Vector3 left = level(matrix_at(d->xmat, robot_).col(1)),
                ahead = left.cross(Vector3::UnitZ());

  // the estimate: moved, and turned about its centre
  const Vector3 true_centre = vector_at(d->xpos, body_);
  const Vector3 sight = level(true_centre - vector_at(d->site_xpos, eyes_));
  const double far =
      (true_centre - vector_at(d->site_xpos, eyes_)).head<2>().norm() / CameraError::kAt;
  const Vector3 moved = far * far * CameraError::kAlong * error_[0] * sight +
                        far * CameraError::kAcross * error_[1] * Vector3::UnitZ().cross(sight) +
                        far * CameraError::kUp * error_[2] * Vector3::UnitZ();
  const Vector3 centre = true_centre + moved;
  const Eigen::AngleAxisd turn(far * CameraError::kTurn * error_[3], Vector3::UnitZ());

  const Vector3 from_robot = centre - vector_at(d->xpos, robot_);
  values_[kAhead] = from_robot.dot(ahead);
  values_[kAside] = from_robot.dot(left);
  const Vector3 along = level(turn * Vector3(matrix_at(d->xmat, body_).col(0)));
  values_[kHeading] = std::atan2(along.dot(left), along.dot(ahead));
  const Vector3 to_stand = centre - stand_off_ * along - vector_at(d->subtree_com, robot_);
  values_[kStandAhead] = to_stand.dot(ahead);
  values_[kStandBearing] = std::atan2(to_stand.dot(left), to_stand.dot(ahead));
  const Vector3 hands[2] = {vector_at(d->site_xpos, tips_[0]), vector_at(d->site_xpos, tips_[1])};
  const Vector3 from_hands = centre - 0.5 * (hands[0] + hands[1]);
  values_[kHandsAhead] = from_hands.dot(ahead);
  values_[kHandsAside] = from_hands.dot(left);
  for (int i = 0; i < 2 && places_[0] >= 0; ++i) {
    const Vector3 place = centre + turn * (vector_at(d->site_xpos, places_[i]) - true_centre);
    const Vector3 way = place - hands[i];
    values_.segment<3>(i == 0 ? kLeftX : kRightX) << way.dot(ahead), way.dot(left), way.z();
  }
}

}  // namespace hurcules

#include "hurcules/sim/casualty_monitor.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/sim/readings.hpp"

namespace hurcules {

namespace {

// [N] largest quasi-static force of a contact, ISO/TS 15066 Annex A as widely reproduced
// [test-methods#contact-limits]
double limit_of(const std::string& region) {
  static const std::vector<std::pair<std::string, double>> table = {
      {"skull", 130.0},      {"face", 65.0},     {"neck", 150.0},  {"upper_back", 210.0},
      {"lower_back", 210.0}, {"chest", 140.0},   {"belly", 110.0}, {"pelvis", 180.0},
      {"upper_arm", 150.0},  {"forearm", 160.0}, {"hand", 140.0},  {"thigh", 220.0},
      {"shank", 130.0},      {"foot", 130.0}};
  for (const auto& [name, limit] : table) {
    if (region.size() >= name.size() &&
        region.compare(region.size() - name.size(), name.size(), name) == 0) {
      return limit;
    }
  }
  return std::numeric_limits<double>::infinity();
}

int body_of(const mjModel* m, const std::string& name) {
  return require_id(m, mjOBJ_BODY, name, "a watched casualty");
}

int row_of(const mjModel* m, const std::string& sensor) {
  const int id = mj_name2id(m, mjOBJ_SENSOR, sensor.c_str());
  return id < 0 ? -1 : m->sensor_adr[id];
}

}  // namespace

const std::vector<std::string>& CasualtyMonitor::names() {
  static const std::vector<std::string> all = {
      "on_ground",        "on_left_arm",      "on_right_arm",  "on_bed",
      "on_rest",          "behind_tips_m",    "aside_m",       "height_m",
      "moved_m",          "bed_ahead_m",      "bed_aside_m",   "sag_m",
      "heading_rad",      "stand_ahead_m",    "stand_rad",     "push_n",
      "neck_flexion_rad", "neck_bending_rad", "neck_turn_rad", "head_mps2",
      "contact_share",    "support_n",        "face_up",       "shift_m"};
  return all;
}

CasualtyMonitor::CasualtyMonitor(const mjModel* m, const std::string& prefix, double stand_off)
    : stand_off_(stand_off), region_of_(static_cast<std::size_t>(m->nbody), -1) {
  require(stand_off_ >= 0.0 && std::isfinite(stand_off_),
          "a watched casualty wants a stand-off >= 0, " + number_text(stand_off_) + " m came");
  pelvis_ = body_of(m, prefix + "pelvis");
  chest_ = body_of(m, prefix + "thorax");
  root_ = m->body_rootid[pelvis_];
  arms_[0] = body_of(m, "L_larm");
  arms_[1] = body_of(m, "R_larm");
  robot_ = m->body_rootid[arms_[0]];
  tips_[0] = mj_name2id(m, mjOBJ_SITE, "L_tcp");
  tips_[1] = mj_name2id(m, mjOBJ_SITE, "R_tcp");
  require(tips_[0] >= 0 && tips_[1] >= 0, "a watched casualty wants sites L_tcp and R_tcp");
  bed_ = mj_name2id(m, mjOBJ_BODY, "transfer_bed");
  is_bed_.assign(static_cast<std::size_t>(m->nbody), false);
  for (int i = std::max(bed_, 1); bed_ >= 0 && i < m->nbody; ++i) {  // parents come first
    is_bed_[static_cast<std::size_t>(i)] =
        i == bed_ || is_bed_[static_cast<std::size_t>(m->body_parentid[i])];
  }
  flexion_ = row_of(m, prefix + "neck_flexion");
  bending_ = row_of(m, prefix + "neck_bending");
  turn_ = row_of(m, prefix + "neck_turn");
  head_ = row_of(m, prefix + "head_acceleration");
  std::vector<double> limits;
  for (int i = 0; i < m->nbody; ++i) {
    const std::string name = name_of(*m, mjOBJ_BODY, i);
    if (m->body_rootid[i] != root_ || name.rfind(prefix, 0) != 0) continue;
    const std::string region = name.substr(prefix.size());
    if (mj_name2id(m, mjOBJ_SENSOR, (prefix + "force_" + region).c_str()) < 0) continue;
    region_of_[static_cast<std::size_t>(i)] = static_cast<int>(regions_.size());
    regions_.push_back(region);
    limits.push_back(limit_of(region));
  }
  limits_ = Eigen::Map<const Vector>(limits.data(), static_cast<Index>(limits.size()));
  forces_ = Vector::Zero(limits_.size());
  values_ = Vector::Zero(kQuantities);
}

void CasualtyMonitor::add_log_channels(Recorder& log) const {
  log.add("casualty", names(), values_);
  log.add("casualty/force", regions_, forces_);
}

void CasualtyMonitor::reset() {
  looked_ = carried_ = false;
  values_.setZero();
  forces_.setZero();
}

void CasualtyMonitor::save(StateWriter& writer) const {
  writer.put(looked_ ? 1.0 : 0.0);
  writer.put(carried_ ? 1.0 : 0.0);
  for (const Vector* vector : {&values_, &forces_}) writer.put(*vector);
  writer.put(Vector(origin_));
  writer.put(Vector(taken_));
}

void CasualtyMonitor::restore(StateReader& reader) {
  looked_ = reader.get_count(1) > 0;
  carried_ = reader.get_count(1) > 0;
  for (Vector* vector : {&values_, &forces_}) reader.get(*vector);
  Vector origin(3);
  reader.get(origin);
  origin_ = origin;
  Vector taken(2);
  reader.get(taken);
  taken_ = taken;
}

void CasualtyMonitor::look(const mjModel* m, const mjData* d) {
  values_.setZero();
  add_up(m, d);
  const Vector3 centre = vector_at(d->subtree_com, root_);
  if (!looked_) origin_ = centre;
  looked_ = true;
  const Vector3 left = vector_at(d->site_xpos, tips_[0]), right = vector_at(d->site_xpos, tips_[1]);
  Vector3 aside = left - right;  // the robot's left, level
  aside.z() = 0.0;
  aside.normalize();
  const Vector3 ahead = aside.cross(Vector3::UnitZ());
  const Vector3 from_tips = centre - 0.5 * (left + right);
  values_[kBehindTips] = -from_tips.dot(ahead);
  values_[kAside] = from_tips.dot(aside);
  values_[kHeight] = centre.z() - origin_.z();
  values_[kMoved] = (centre - origin_).head<2>().norm();
  values_[kFaceUp] = d->xmat[9 * chest_ + 6];  // the chest's x axis, out of its front, along z
  values_[kSag] = vector_at(d->xpos, chest_).z() - vector_at(d->xpos, pelvis_).z();
  if (bed_ >= 0) {
    const Vector3 on_bed =
        matrix_at(d->xmat, bed_).transpose() * (centre - vector_at(d->xpos, bed_));
    values_[kBedAhead] = on_bed.x();
    values_[kBedAside] = on_bed.y();
  }
  const Vector3 body = vector_at(d->xpos, chest_) - vector_at(d->xpos, pelvis_);
  values_[kHeading] = std::atan2(-body.dot(ahead), body.dot(aside));
  const Vector3 along = Vector3(body.x(), body.y(), 0.0).normalized();
  const Vector3 stand = centre - stand_off_ * along.cross(Vector3::UnitZ());
  const Vector3 to_stand = stand - vector_at(d->subtree_com, robot_);
  values_[kStandAhead] = to_stand.dot(ahead);
  values_[kStandBearing] = std::atan2(to_stand.dot(aside), to_stand.dot(ahead));
  if (flexion_ >= 0) values_[kNeckFlexion] = d->sensordata[flexion_];
  if (bending_ >= 0) values_[kNeckBending] = d->sensordata[bending_];
  if (turn_ >= 0) values_[kNeckTurn] = d->sensordata[turn_];
  if (head_ >= 0) values_[kHead] = Eigen::Map<const Vector3>(d->sensordata + head_).norm();
  const bool lies = values_[kOnGround] > kLying;
  for (Index i = 0; i < forces_.size(); ++i) {
    double& worst = values_[lies ? kContactShare : kSupport];
    worst = std::max(worst, lies ? forces_[i] / limits_[i] : forces_[i]);
  }
  note_shift();
}

// from when both arms bear all that does not count as lying until he lies again, on ground or bed
void CasualtyMonitor::note_shift() {
  const Eigen::Vector2d here(values_[kBehindTips], values_[kAside]);
  const double on_arms = values_[kOnLeft] + values_[kOnRight];
  if (values_[kOnGround] > kLying || values_[kOnBed] > kLying) {
    carried_ = false;
  } else if (!carried_ && on_arms >= 1.0 - kLying) {
    carried_ = true;
    taken_ = here;
  }
  if (carried_) values_[kShift] = (here - taken_).norm();
}

// contacts of the person, by partner and by region
void CasualtyMonitor::add_up(const mjModel* m, const mjData* d) {
  forces_.setZero();
  const double weight = weight_of(m, root_);
  Vector3 push = Vector3::Zero();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    const int bodies[2] = {m->geom_bodyid[contact.geom[0]], m->geom_bodyid[contact.geom[1]]};
    const bool second = m->body_rootid[bodies[1]] == root_;
    if ((m->body_rootid[bodies[0]] == root_) == second) continue;  // both, or none
    const int mine = bodies[second ? 1 : 0], other = bodies[second ? 0 : 1];
    const ContactForce acts = contact_force(m, d, i);
    const Vector3 force = (second ? 1.0 : -1.0) * acts.force;
    const double share = force.z() / weight;
    if (m->body_weldid[other] == 0) {
      values_[kOnGround] += share;
      continue;
    }
    if (m->body_rootid[other] != robot_) continue;
    if (other == arms_[0] || other == arms_[1]) {
      values_[other == arms_[0] ? kOnLeft : kOnRight] += share;
      push += force;
    } else {
      values_[is_bed_[static_cast<std::size_t>(other)] ? kOnBed : kOnRest] += share;
    }
    const int region = region_of_[static_cast<std::size_t>(mine)];
    if (region >= 0) forces_[region] += acts.normal;
  }
  values_[kPush] = push.head<2>().norm();
}

}  // namespace hurcules

#include "hurcules/sim/load_monitor.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "hurcules/sim/readings.hpp"

namespace hurcules {

namespace {

int id_of(const mjModel* m, mjtObj kind, const std::string& name) {
  return require_id(m, kind, name, "a load");
}

}  // namespace

const std::vector<std::string>& LoadMonitor::names() {
  static const std::vector<std::string> all = {
      "on_ground",    "on_left_hand", "on_right_hand", "on_rest", "in_container", "left_grip_n",
      "right_grip_n", "knock_n",      "height_m",      "moved_m", "tilt_rad",     "sinking_mps",
      "off_m",        "in_ahead_m",   "in_aside_m",    "in_up_m"};
  return all;
}

LoadMonitor::LoadMonitor(const mjModel* m, const std::string& body, const std::string& container)
    : body_(id_of(m, mjOBJ_BODY, body)),
      container_(container.empty() ? -1 : id_of(m, mjOBJ_BODY, container)),
      tips_{id_of(m, mjOBJ_SITE, "L_tcp"), id_of(m, mjOBJ_SITE, "R_tcp")},
      places_{id_of(m, mjOBJ_SITE, body + "_left"), id_of(m, mjOBJ_SITE, body + "_right")},
      hand_(static_cast<std::size_t>(m->nbody), -1) {
  const int hands[2] = {id_of(m, mjOBJ_BODY, "L_hand"), id_of(m, mjOBJ_BODY, "R_hand")};
  robot_ = m->body_rootid[hands[0]];
  for (int i = 1; i < m->nbody; ++i) {  // parents come first
    hand_[static_cast<std::size_t>(i)] = i == hands[0] ? 0
                                         : i == hands[1]
                                             ? 1
                                             : hand_[static_cast<std::size_t>(m->body_parentid[i])];
  }
  for (int i = 0; i < 2; ++i) {
    for (const char* const finger : {"1", "2"}) {
      const std::string side = i == 0 ? "L" : "R";
      const int joint = id_of(m, mjOBJ_JOINT, side + "_pad_" + finger);
      pads_[i].push_back({m->jnt_qposadr[joint], m->jnt_stiffness[joint]});
    }
  }
  values_ = Vector::Zero(kQuantities);
}

void LoadMonitor::add_log_channels(Recorder& log, const std::string& prefix) const {
  log.add(prefix, names(), values_);
}

void LoadMonitor::reset(const mjModel* m, const mjData* d) {
  looked_ = false;
  look(m, d);
  looked_ = false;
}

void LoadMonitor::save(StateWriter& writer) const {
  writer.put(looked_ ? 1.0 : 0.0);
  writer.put(values_);
  writer.put(Vector(origin_));
}

void LoadMonitor::restore(StateReader& reader) {
  looked_ = reader.get_count(1) > 0;
  reader.get(values_);
  Vector origin(3);
  reader.get(origin);
  origin_ = origin;
}

void LoadMonitor::look(const mjModel* m, const mjData* d) {
  values_.setZero();
  add_up(m, d);
  const Vector3 centre = vector_at(d->xpos, body_);
  if (!looked_) origin_ = centre;
  looked_ = true;
  values_[kHeight] = centre.z() - origin_.z();
  values_[kMoved] = (centre - origin_).head<2>().norm();
  values_[kTilt] = std::acos(std::clamp<double>(d->xmat[9 * body_ + 8], -1.0, 1.0));
  mjtNum velocity[6];
  mj_objectVelocity(m, d, mjOBJ_BODY, body_, velocity, 0);
  values_[kSinking] = -velocity[5];
  for (int i = 0; i < 2; ++i) {
    const Vector3 off = vector_at(d->site_xpos, places_[i]) - vector_at(d->site_xpos, tips_[i]);
    values_[kOff] = std::max(values_[kOff], off.norm());
    for (const Pad& pad : pads_[i]) {
      values_[i == 0 ? kLeft : kRight] += pad.stiffness * d->qpos[pad.address];
    }
  }
  if (container_ < 0) return;
  values_.segment<3>(kAhead) =
      matrix_at(d->xmat, container_).transpose() * (centre - vector_at(d->xpos, container_));
}

// contacts of the thing by partner, and those of robot and container
void LoadMonitor::add_up(const mjModel* m, const mjData* d) {
  const double weight = weight_of(m, body_);
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    const int bodies[2] = {m->geom_bodyid[contact.geom[0]], m->geom_bodyid[contact.geom[1]]};
    const bool second = bodies[1] == body_;
    const int other = bodies[second ? 0 : 1];
    const bool mine = second || bodies[0] == body_;
    if (!mine && bodies[0] != container_ && bodies[1] != container_) continue;
    const ContactForce acts = contact_force(m, d, i);
    if (!mine) {
      const int met = bodies[bodies[0] == container_ ? 1 : 0];
      if (m->body_rootid[met] == robot_) values_[kKnock] += acts.normal;
      continue;
    }
    const double share = (second ? 1.0 : -1.0) * acts.force.z() / weight;
    const int hand = hand_[static_cast<std::size_t>(other)];
    if (other == container_) {
      values_[kInContainer] += share;
    } else if (m->body_weldid[other] == 0) {
      values_[kOnGround] += share;
    } else if (hand >= 0) {
      values_[hand == 0 ? kOnLeft : kOnRight] += share;
    } else if (m->body_rootid[other] == robot_) {
      values_[kOnRest] += share;
      values_[kKnock] += acts.normal;
    }
  }
}

}  // namespace hurcules

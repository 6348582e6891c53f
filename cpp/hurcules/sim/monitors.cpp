#include "hurcules/sim/monitors.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

std::vector<bool> find_tracks(const mjModel* m) {
  std::vector<bool> found(static_cast<std::size_t>(m->ngeom), false);
  for (int tuple = 0; tuple < m->ntuple; ++tuple) {
    const char* const name = mj_id2name(m, mjOBJ_TUPLE, tuple);
    if (std::string(name ? name : "").find("track_") == std::string::npos) continue;
    for (int i = m->tuple_adr[tuple]; i < m->tuple_adr[tuple] + m->tuple_size[tuple]; ++i) {
      if (m->tuple_objtype[i] == mjOBJ_GEOM)
        found[static_cast<std::size_t>(m->tuple_objid[i])] = true;
    }
  }
  return found;
}

bool is_worse(Index quantity, double value, double than) {
  return Monitors::falls(quantity) ? value < than : value > than;
}

}  // namespace

const std::vector<std::string>& Monitors::names() {
  static const std::vector<std::string> names = {"self_collision_distance_m",
                                                 "static_margin_m",
                                                 "pressure_margin_m",
                                                 "tip_angle_rad",
                                                 "energy_margin_J",
                                                 "motor_temperature_C",
                                                 "power_W"};
  return names;
}

Monitors::Monitors(const mjModel* m, int robot_root, const MotorLosses& losses,
                   const MonitorOptions& options)
    : options_(options),
      root_(robot_root),
      distance_(m, robot_root, options.distance),
      windings_(m, losses, options.windings),
      is_track_(find_tracks(m)),
      threshold_(thresholds()),
      alarm_(Vector::Zero(kQuantities)) {
  for (Index i = 0; i < kQuantities; ++i) {
    require(!std::isnan(threshold_[i]), "monitors: the threshold of " +
                                            names()[static_cast<std::size_t>(i)] +
                                            " wants a number, NaN came");
  }
  reset();
}

Vector Monitors::thresholds() const {
  Vector result(kQuantities);
  result << options_.min_distance, options_.min_margin, options_.min_pressure_margin,
      options_.min_tip_angle, options_.min_energy, options_.max_temperature, options_.max_power;
  return result;
}

void Monitors::reset() {
  distance_.reset();
  windings_.reset();
  support_points_ = 0;
  value_ = Vector::Zero(kQuantities);
  value_[Distance] = options_.distance.cutoff;
  value_[Temperature] = options_.windings.ambient;
  worst_ = Vector::Constant(kQuantities, std::numeric_limits<double>::quiet_NaN());
  alarm_.setZero();
}

void Monitors::look(const mjModel* m, mjData* d, double power) {
  if (!options_.on) return;
  note(Distance, distance_.measure(m, d));
  collect_support(m, d);
  const Vector3 gravity(m->opt.gravity[0], m->opt.gravity[1], m->opt.gravity[2]);
  if (!polygon_.empty() && gravity.norm() > 0.0) {
    const Vector3 com = Eigen::Map<const Vector3>(d->subtree_com + 3 * root_);
    const Stability stands = polygon_.judge({com, m->body_subtreemass[root_], gravity});
    note(Margin, stands.margin);
    note(PressureMargin, stands.pressure_margin);
    note(TipAngle, stands.tip_angle);
    note(Energy, stands.energy);
  }
  windings_.warm(d);
  note(Temperature, windings_.temperature().size() > 0 ? windings_.temperature().maxCoeff()
                                                       : options_.windings.ambient);
  note(Power, power);
}

void Monitors::collect_support(const mjModel* m, const mjData* d) {
  polygon_.clear();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.efc_address < 0 || contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    const int body[2] = {m->geom_bodyid[contact.geom[0]], m->geom_bodyid[contact.geom[1]]};
    const bool first = m->body_rootid[body[0]] == root_, second = m->body_rootid[body[1]] == root_;
    if (first == second) continue;
    const int other = first ? body[1] : body[0], own = contact.geom[first ? 0 : 1];
    if (m->body_weldid[other] != 0 && !is_track_[static_cast<std::size_t>(own)]) continue;
    mjtNum force[6];
    mj_contactForce(m, d, i, force);
    // what does not press does not carry
    if (force[0] > 0.0) polygon_.add(Eigen::Map<const Vector3>(contact.pos), force[0]);
  }
  support_points_ = static_cast<Index>(polygon_.size());
}

void Monitors::note(Index quantity, double value) {
  value_[quantity] = value;
  if (std::isnan(worst_[quantity]) || is_worse(quantity, value, worst_[quantity])) {
    worst_[quantity] = value;
  }
  // a tenth of the threshold between rising and falling: an alarm does not chatter
  const double limit = threshold_[quantity];
  const double back =
      falls(quantity) ? limit + 0.1 * std::abs(limit) : limit - 0.1 * std::abs(limit);
  if (is_worse(quantity, value, limit)) {
    alarm_[quantity] = 1.0;
  } else if (!is_worse(quantity, value, back)) {
    alarm_[quantity] = 0.0;
  }
}

void Monitors::add_log_channels(Recorder& recorder) const {
  recorder.add("monitor", names(), value_);
}

void Monitors::save(StateWriter& writer) const {
  distance_.save(writer);
  windings_.save(writer);
  for (const Vector* values : {&value_, &worst_, &alarm_}) writer.put(*values);
}

void Monitors::restore(StateReader& reader) {
  distance_.restore(reader);
  windings_.restore(reader);
  reader.get(value_);
  for (double& value : worst_) value = reader.get_any();  // NaN before the first tick
  reader.get(alarm_);
}

}  // namespace hurcules

#include "hurcules/sim/support.hpp"

#include <mujoco/mujoco.h>

#include <limits>

#include "hurcules/robot/object_names.hpp"
#include "hurcules/sim/readings.hpp"

namespace hurcules {

namespace {

std::vector<bool> find_tracks(const mjModel* m) {
  std::vector<bool> found(static_cast<std::size_t>(m->ngeom), false);
  for (int tuple = 0; tuple < m->ntuple; ++tuple) {
    if (name_of(*m, mjOBJ_TUPLE, tuple).find("track_") == std::string::npos) continue;
    for (int i = m->tuple_adr[tuple]; i < m->tuple_adr[tuple] + m->tuple_size[tuple]; ++i) {
      if (m->tuple_objtype[i] == mjOBJ_GEOM)
        found[static_cast<std::size_t>(m->tuple_objid[i])] = true;
    }
  }
  return found;
}

bool touches_ground(const mjModel* m, const mjData* d, int root) {
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    const int body[2] = {m->geom_bodyid[contact.geom[0]], m->geom_bodyid[contact.geom[1]]};
    for (const int side : {0, 1})
      if (m->body_rootid[body[side]] == root && m->body_weldid[body[1 - side]] == 0) return true;
  }
  return false;
}

}  // namespace

Support::Support(const mjModel* m, int robot_root) : root_(robot_root), is_track_(find_tracks(m)) {}

std::optional<Stability> Support::measure(const mjModel* m, const mjData* d,
                                          std::span<const int> carried) {
  collect(m, d);
  const Vector3 gravity(m->opt.gravity[0], m->opt.gravity[1], m->opt.gravity[2]);
  if (polygon_.empty() || gravity.norm() == 0.0) return std::nullopt;
  double mass = m->body_subtreemass[root_];
  Vector3 com = Eigen::Map<const Vector3>(d->subtree_com + 3 * root_);
  for (const int root : carried) {
    if (touches_ground(m, d, root)) continue;
    const double load = m->body_subtreemass[root];
    com += load / (mass + load) * (Eigen::Map<const Vector3>(d->subtree_com + 3 * root) - com);
    mass += load;
  }
  return polygon_.judge({com, mass, gravity});
}

void Support::collect(const mjModel* m, const mjData* d) {
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
}

double static_margin(const mjModel* m, const mjData* d, const std::string& root,
                     const std::vector<std::string>& carried) {
  const auto tree_of = [m](const std::string& body) {
    return m->body_rootid[find_body(m, body, "static_margin")];
  };
  std::vector<int> loads;
  for (const std::string& body : carried) loads.push_back(tree_of(body));
  const std::optional<Stability> stands = Support(m, tree_of(root)).measure(m, d, loads);
  return stands ? stands->margin : -std::numeric_limits<double>::infinity();
}

}  // namespace hurcules

#include "hurcules/sim/self_distance.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <memory>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/geom_bounds.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

bool collides(const mjModel* m, int a, int b) {
  const int body_a = m->geom_bodyid[a], body_b = m->geom_bodyid[b];
  if (m->body_weldid[body_a] == m->body_weldid[body_b]) return false;
  return (m->geom_contype[a] & m->geom_conaffinity[b]) != 0 ||
         (m->geom_contype[b] & m->geom_conaffinity[a]) != 0;
}

// joints that turn the body: not slides, along which parts of one thing move, nor springs
int turning_joints(const mjModel* m, int body) {
  int joints = 0;
  for (int i = 0; i < m->body_jntnum[body]; ++i) {
    const int j = m->body_jntadr[body] + i;
    joints += m->jnt_type[j] == mjJNT_HINGE && m->jnt_stiffness[j] == 0.0 ? 1 : 0;
  }
  return joints;
}

// such joints on the way from one body to the other through the tree
int joints_between(const mjModel* m, int a, int b) {
  int joints = 0;
  while (a != b) {  // parents have smaller numbers
    int& lower = a > b ? a : b;
    joints += turning_joints(m, lower);
    lower = m->body_parentid[lower];
  }
  return joints;
}

}  // namespace

SelfDistance::SelfDistance(const mjModel* m, const std::vector<int>& roots,
                           const SelfDistanceOptions& options)
    : options_(options) {
  require(options_.joints >= 1, "self-collision: joints wants a number >= 1");
  require(std::isfinite(options_.near) && options_.near >= 0.0,
          "self-collision: near wants a distance >= 0 [m]");
  require(std::isfinite(options_.cutoff) && options_.cutoff > 0.0,
          "self-collision: cutoff wants a distance > 0 [m]");
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(m), mj_deleteData);
  require(data != nullptr, "MuJoCo has no memory for this model");
  mj_kinematics(m, data.get());
  for (int a = 0; a < m->ngeom; ++a) {
    if (!in_trees(*m, m->geom_bodyid[a], roots)) continue;
    for (int b = a + 1; b < m->ngeom; ++b) {
      if (!in_trees(*m, m->geom_bodyid[b], roots) || !collides(m, a, b)) continue;
      const int joints = joints_between(m, m->geom_bodyid[a], m->geom_bodyid[b]);
      const auto is_near = [&] {
        return mj_geomDistance(m, data.get(), a, b, 2.0 * options_.near, nullptr) < options_.near;
      };
      if (joints < options_.joints || (joints == options_.joints && is_near())) continue;
      pairs_.push_back({a, b});
    }
  }
}

double SelfDistance::measure(const mjModel* m, mjData* d) {
  double least = options_.cutoff;
  const Index last = nearest_;
  nearest_ = -1;
  const auto look = [&](Index index) {
    const Pair& pair = pairs_[static_cast<std::size_t>(index)];
    if (sphere_gap(m, d, pair.first, pair.second) >= least) return;
    if (box_gap(m, d, {pair.first, pair.second}, least) >= least) return;
    const double distance = mj_geomDistance(m, d, pair.first, pair.second, least, nullptr);
    if (distance >= least) return;
    least = distance;
    nearest_ = index;
  };
  if (last >= 0) look(last);
  for (Index i = 0; i < pairs(); ++i) {
    if (i != last) look(i);
  }
  return least;
}

std::vector<std::pair<std::string, std::string>> SelfDistance::names(const mjModel* m) const {
  std::vector<std::pair<std::string, std::string>> names;
  for (const Pair& pair : pairs_) {
    names.emplace_back(geom_name(*m, pair.first), geom_name(*m, pair.second));
  }
  return names;
}

void SelfDistance::restore(StateReader& reader) {
  nearest_ = static_cast<Index>(reader.get());
  require(nearest_ >= -1 && nearest_ < pairs(), "the snapshot belongs to another model or mission");
}

}  // namespace hurcules

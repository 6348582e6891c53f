#include "hurcules/robot/collision_pairs.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/robot/joint_actuators.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

constexpr double kAlways = 0.9;  // in contact in so many of the postures: made so

// what the model says about the geoms of a robot
class Shapes {
 public:
  explicit Shapes(const Robot& robot)
      : robot_(robot),
        model_(*robot.model()),
        driven_(static_cast<std::size_t>(model_.nbody), false) {
    const std::vector<bool> joints = joints_of_coordinates(robot);
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (joints[j]) driven_[static_cast<std::size_t>(model_.jnt_bodyid[j])] = true;
  }

  [[nodiscard]] int body(int geom) const { return model_.geom_bodyid[geom]; }

  // of a tree that the coordinates move
  [[nodiscard]] bool is_own(int body) const { return in_own_tree(robot_, body); }
  [[nodiscard]] bool stands_still(int body) const { return !may_move(model_, body); }

  // the model lets them touch
  [[nodiscard]] bool may_touch(int a, int b) const {
    const mjModel& m = model_;
    if (m.body_weldid[body(a)] == m.body_weldid[body(b)]) return false;
    for (int i = 0; i < m.npair; ++i) {
      const int first = m.pair_geom1[i], second = m.pair_geom2[i];
      if ((first == a && second == b) || (first == b && second == a)) return true;
    }
    const int low = std::min(body(a), body(b)), high = std::max(body(a), body(b));
    for (int i = 0; i < m.nexclude; ++i)
      if (m.exclude_signature[i] == (low << 16) + high) return false;
    return (m.geom_contype[a] & m.geom_conaffinity[b]) != 0 ||
           (m.geom_contype[b] & m.geom_conaffinity[a]) != 0;
  }

  // bodies with driven joints on the way from one to the other
  [[nodiscard]] int links_between(int a, int b) const {
    int links = 0;
    while (a != b) {  // parents have smaller numbers
      int& lower = a > b ? a : b;
      links += driven_[static_cast<std::size_t>(lower)] ? 1 : 0;
      lower = model_.body_parentid[lower];
    }
    return links;
  }

 private:
  const Robot& robot_;
  const mjModel& model_;
  std::vector<bool> driven_;  // (nbody)
};

class Postures {
 public:
  Postures(const Robot& robot, std::uint32_t seed) : home_(robot.configuration()), random_(seed) {
    for (const Coordinate& coordinate : robot.coordinates()) {
      const bool turns = robot.model()->jnt_type[coordinate.joints[0].joint] == mjJNT_HINGE;
      reach_.push_back(turns ? M_PI : 1.0);
      limits_.emplace_back(coordinate.lower, coordinate.upper);
    }
  }

  [[nodiscard]] Vector next() {
    Vector q = home_;
    for (Index i = 0; i < q.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto [lower, upper] = limits_[k];
      const double low = std::isfinite(lower) ? lower : home_[i] - reach_[k];
      const double high = std::isfinite(upper) ? upper : home_[i] + reach_[k];
      q[i] = low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
    }
    return q;
  }

 private:
  Vector home_;
  std::vector<double> reach_;  // [rad] or [m] where there is no limit
  std::vector<std::pair<double, double>> limits_;
  std::mt19937 random_;
};

bool same(const Skeleton::Pose& a, const Skeleton::Pose& b) {
  return (a.p - b.p).norm() < 1e-9 && (a.R - b.R).norm() < 1e-9;
}

Skeleton::Pose seen_from(const Robot& robot, int first, int second) {
  const Skeleton::Pose a = robot.pose({mjOBJ_BODY, first}), b = robot.pose({mjOBJ_BODY, second});
  return {a.R.transpose() * (b.p - a.p), a.R.transpose() * b.R};
}

// the same robot in the same place
void stand_alike(const Robot& robot, Robot& probe) {
  probe.set_qpos(robot.qpos());
  if (!robot.support_name().empty()) probe.stand_on(robot.support_name());
}

// those whose geoms some posture moves against each other
std::vector<GeomPair> moving(const std::vector<GeomPair>& pairs, const Robot& robot,
                             Postures postures) {
  const Shapes shapes(robot);
  Robot probe(robot.model(), robot.coordinate_names());
  stand_alike(robot, probe);
  std::vector<Skeleton::Pose> before;
  for (const GeomPair& pair : pairs)
    before.push_back(seen_from(probe, shapes.body(pair.first), shapes.body(pair.second)));
  probe.set_configuration(postures.next());
  std::vector<GeomPair> found;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const GeomPair& pair = pairs[i];
    if (!same(before[i], seen_from(probe, shapes.body(pair.first), shapes.body(pair.second))))
      found.push_back(pair);
  }
  return found;
}

// how far apart they are now, `near` where it is further
std::vector<CollisionPair> measured(const std::vector<GeomPair>& pairs, const Robot& probe,
                                    double near) {
  GeomDistance distance(probe, pairs, near, pairs.size());
  std::vector<CollisionPair> found;
  for (const GeomPair& pair : pairs) found.push_back({pair, near});
  for (const GeomDistance::Near& one : distance.measure(probe))
    if (one.pair >= 0) found[static_cast<std::size_t>(one.pair)].distance = one.distance;
  return found;
}

// Which of these pairs come near in sampled postures and are not in contact in nearly all. What is
// decided is measured no more.
class Sieve {
 public:
  Sieve(const std::vector<CollisionPair>& pairs, const Robot& probe,
        const CollisionSampling& sampling)
      : pairs_(pairs),
        near_(sampling.near),
        clear_enough_((1.0 - kAlways) * sampling.postures),
        seen_(pairs.size()) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      open_.push_back(i);
      seen_[i].near = pairs[i].distance < near_;
    }
    renew(probe);
  }

  void look(const Robot& probe) {
    if (open_.empty()) return;
    const std::span<const GeomDistance::Near> near = distance_->measure(probe);
    touches_.assign(open_.size(), false);
    for (const GeomDistance::Near& one : near) {
      if (one.pair < 0) continue;
      seen_[open_[static_cast<std::size_t>(one.pair)]].near = true;
      touches_[static_cast<std::size_t>(one.pair)] = one.distance < 0.0;
    }
    std::size_t decided = 0;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      seen_[open_[k]].clear += touches_[k] ? 0 : 1;
      decided += keeps(open_[k]) ? 1 : 0;
    }
    if (2 * decided <= open_.size()) return;
    std::erase_if(open_, [&](std::size_t i) { return keeps(i); });
    renew(probe);
  }

  [[nodiscard]] bool keeps(std::size_t i) const {
    return seen_[i].near && seen_[i].clear >= clear_enough_;
  }

 private:
  struct Seen {
    bool near = false;
    int clear = 0;  // postures without contact
  };

  void renew(const Robot& probe) {
    std::vector<GeomPair> pairs;
    for (const std::size_t i : open_) pairs.push_back(pairs_[i].geoms);
    const std::size_t count = pairs.size();
    if (count > 0) distance_.emplace(probe, std::move(pairs), near_, count);
  }

  const std::vector<CollisionPair>& pairs_;
  double near_, clear_enough_;
  std::vector<Seen> seen_;
  std::vector<std::size_t> open_;  // those that are not decided
  std::vector<bool> touches_;      // of these, now
  std::optional<GeomDistance> distance_;
};

// those that come near, and are not in contact by construction
std::vector<CollisionPair> selected(const std::vector<GeomPair>& candidates, const Robot& robot,
                                    const CollisionSampling& sampling) {
  require(sampling.postures > 0, "postures wants a number > 0");
  Robot probe(robot.model(), robot.coordinate_names());
  stand_alike(robot, probe);
  Postures postures(robot, sampling.seed);
  std::vector<CollisionPair> found =
      measured(moving(candidates, robot, postures), probe, sampling.near);
  Sieve sieve(found, probe, sampling);
  for (int i = 0; i < sampling.postures; ++i) {
    probe.set_configuration(postures.next());
    sieve.look(probe);
  }
  std::vector<CollisionPair> kept;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (sieve.keeps(i) && found[i].distance > 0.0) kept.push_back(found[i]);
  return kept;
}

// where a robot's bodies go further than any sampled posture: along slides of a wide range, over the
// ground on driven wheels
class Roaming {
 public:
  explicit Roaming(const Robot& robot) : model_(*robot.model()) {
    for (const Coordinate& coordinate : robot.coordinates()) {
      const int joint = coordinate.joints.front().joint;
      if (model_.jnt_type[joint] != mjJNT_SLIDE || coordinate.upper - coordinate.lower < kWide)
        continue;
      const int body = model_.jnt_bodyid[joint];
      const Vector3 axis(model_.jnt_axis + 3 * joint);
      ways_.push_back({body, robot.pose({mjOBJ_BODY, body}).R * axis});
    }
    for (const int wheel : driven_wheels(model_)) {
      const int root = model_.body_rootid[model_.jnt_bodyid[wheel]];
      ways_.push_back({root, Vector3::UnitX()});
      ways_.push_back({root, Vector3::UnitY()});
    }
  }

  [[nodiscard]] bool meets(const GeomPair& pair) const {
    const auto leads = [&](const Way& way) {
      return is_below(model_.geom_bodyid[pair.first], way.body) &&
             (model_.geom_type[pair.second] != mjGEOM_PLANE || crosses(pair.second, way.axis));
    };
    return std::any_of(ways_.begin(), ways_.end(), leads);
  }

 private:
  static constexpr double kWide = 2.0;  // [m]
  struct Way {
    int body = 0;
    Vector3 axis;  // in W
  };

  [[nodiscard]] bool is_below(int body, int other) const {
    while (body > other) body = model_.body_parentid[body];
    return body == other;
  }
  // of a plane that stands still
  [[nodiscard]] bool crosses(int plane, const Vector3& axis) const {
    constexpr double kAlong = 1e-3;
    const Matrix3 R = rotation_of(model_.body_quat + 4 * model_.geom_bodyid[plane]) *
                      rotation_of(model_.geom_quat + 4 * plane);
    return std::abs(R.col(2).dot(axis)) > kAlong;
  }

  const mjModel& model_;
  std::vector<Way> ways_;
};

// those that a robot which roams may meet, but for what it touches now
std::vector<CollisionPair> met(const std::vector<GeomPair>& candidates, const Robot& robot,
                               const CollisionSampling& sampling) {
  const Roaming roaming(robot);
  Robot probe(robot.model(), robot.coordinate_names());
  stand_alike(robot, probe);
  std::vector<GeomPair> pairs;
  for (const GeomPair& pair : moving(candidates, robot, Postures(robot, sampling.seed)))
    if (roaming.meets(pair)) pairs.push_back(pair);
  std::vector<CollisionPair> found = measured(pairs, probe, sampling.near);
  std::erase_if(found, [](const CollisionPair& pair) { return pair.distance <= 0.0; });
  return found;
}

}  // namespace

std::vector<CollisionPair> self_pairs(const Robot& robot, const CollisionSampling& sampling) {
  const Shapes shapes(robot);
  const int geoms = static_cast<int>(robot.model()->ngeom);
  std::vector<GeomPair> candidates;
  for (int a = 0; a < geoms; ++a) {
    if (!shapes.is_own(shapes.body(a))) continue;
    for (int b = a + 1; b < geoms; ++b) {
      if (!shapes.is_own(shapes.body(b)) || !shapes.may_touch(a, b)) continue;
      if (shapes.links_between(shapes.body(a), shapes.body(b)) > 1) candidates.push_back({a, b});
    }
  }
  return selected(candidates, robot, sampling);
}

std::vector<CollisionPair> obstacle_pairs(const Robot& robot,
                                          const std::vector<std::string>& bodies,
                                          const CollisionSampling& sampling) {
  const Shapes shapes(robot);
  const mjModel& m = *robot.model();
  std::vector<int> named;
  for (const std::string& name : bodies) {
    const int id = find_object(m, mjOBJ_BODY, name);
    require(!shapes.is_own(id), "body '" + name + "' is part of the robot, not around it");
    named.push_back(id);
  }
  std::set<int> met_named;  // that can touch the robot, they or what hangs on them
  const auto is_named = [&](int body) {
    bool is = false;
    for (; body != 0; body = m.body_parentid[body]) {
      if (std::find(named.begin(), named.end(), body) == named.end()) continue;
      met_named.insert(body);
      is = true;
    }
    return is;
  };
  std::vector<GeomPair> still, told;
  for (int a = 0; a < m.ngeom; ++a) {
    if (!shapes.is_own(shapes.body(a))) continue;
    for (int b = 0; b < m.ngeom; ++b) {
      if (shapes.is_own(shapes.body(b)) || !shapes.may_touch(a, b)) continue;
      const bool named_one = is_named(shapes.body(b));
      if (m.geom_type[b] == mjGEOM_HFIELD) continue;  // no distance of these is right
      if (named_one) {
        told.push_back({a, b});
      } else if (shapes.stands_still(shapes.body(b))) {
        still.push_back({a, b});
      }
    }
  }
  for (const int body : named) {
    require(met_named.contains(body), "body '" + name_of(m, mjOBJ_BODY, body) +
                                          "' has no geom that can touch the robot (contype, "
                                          "conaffinity)");
  }
  std::vector<CollisionPair> found = selected(still, robot, sampling);
  std::set<std::pair<int, int>> known;
  for (const CollisionPair& pair : found) known.emplace(pair.geoms.first, pair.geoms.second);
  for (const CollisionPair& pair : met(still, robot, sampling))
    if (known.emplace(pair.geoms.first, pair.geoms.second).second) found.push_back(pair);
  for (const GeomPair& pair : moving(told, robot, Postures(robot, sampling.seed)))
    found.push_back({pair, sampling.near});
  return found;
}

}  // namespace hurcules

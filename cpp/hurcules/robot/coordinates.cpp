#include "hurcules/robot/coordinates.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/robot/motor.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// "left_coordinate_HIP" without "coordinate_" is "left_HIP"
std::optional<std::string> without(const char* name, const std::string& marker) {
  const std::string text = name ? name : "";
  const auto at = text.find(marker);
  if (at == std::string::npos) return std::nullopt;
  return text.substr(0, at) + text.substr(at + marker.size());
}

bool is_single(const mjModel& m, int joint) {
  return m.jnt_type[joint] == mjJNT_HINGE || m.jnt_type[joint] == mjJNT_SLIDE;
}

bool is_ball(const mjModel& m, int joint) {
  return m.jnt_type[joint] == mjJNT_BALL;
}

// `part`: of a ball joint one that it turns, -1 for any
bool drives(const mjModel& m, int actuator, int joint, int part = -1) {
  const int kind = m.actuator_trntype[actuator];
  return (kind == mjTRN_JOINT || kind == mjTRN_JOINTINPARENT) &&
         m.actuator_trnid[2 * actuator] == joint &&
         (part < 0 || axis_of(m, actuator) == part - kTurns);
}

int first_actuator(const mjModel& m, int joint, int part) {
  for (int a = 0; a < m.nu; ++a)
    if (drives(m, a, joint, part)) return a;
  return -1;
}

DrivenJoint driven(const mjModel& m, int joint, double factor) {
  return {joint, m.jnt_qposadr[joint], m.jnt_dofadr[joint], actuator_of(m, joint), factor};
}

Coordinate from_tuple(const mjModel& m, int tuple, const std::string& name) {
  Coordinate coordinate;
  coordinate.name = name;
  for (int i = 0; i < m.tuple_size[tuple]; ++i) {
    const int at = m.tuple_adr[tuple] + i;
    const int id = m.tuple_objid[at];
    require(m.tuple_objtype[at] == mjOBJ_JOINT && is_single(m, id),
            "coordinate '" + name + "' wants hinge or slide joints, element " + std::to_string(i) +
                " of its tuple is something else");
    require(m.tuple_objprm[at] != 0 && std::isfinite(m.tuple_objprm[at]),
            "coordinate '" + name + "' wants a factor for joint '" + joint_name(m, id) +
                "', its prm is 0 or not finite");
    coordinate.joints.push_back(driven(m, id, m.tuple_objprm[at]));
  }
  require(!coordinate.joints.empty(),
          "coordinate '" + name + "' wants a joint, its tuple is empty");
  return coordinate;
}

std::vector<Coordinate> from_tuples(const mjModel& m) {
  std::vector<Coordinate> found;
  for (int t = 0; t < m.ntuple; ++t)
    if (const auto name = without(mj_id2name(&m, mjOBJ_TUPLE, t), "coordinate_"))
      found.push_back(from_tuple(m, t, *name));
  return found;
}

// those of a free joint, or of a ball joint, which is the turns alone
std::vector<Coordinate> from_parts(const mjModel& m, int joint) {
  std::vector<Coordinate> found;
  const int first = is_ball(m, joint) ? kTurns : 0;
  for (int part = first; part < kParts; ++part) {
    DrivenJoint driven_joint = driven(m, joint, 1.0);
    driven_joint.part = part;
    driven_joint.dof += part - first;
    if (is_ball(m, joint)) driven_joint.actuator = first_actuator(m, joint, part);
    Coordinate coordinate;
    coordinate.name = part_name(m, joint, part);
    if (part < kTurns) coordinate.unit = "m";
    coordinate.joints = {driven_joint};
    coordinate.lower = -kInfinity;
    coordinate.upper = coordinate.max_velocity = kInfinity;
    found.push_back(std::move(coordinate));
  }
  return found;
}

std::vector<Coordinate> from_joints(const mjModel& m, bool with_actuator) {
  std::vector<Coordinate> found;
  for (int j = 0; j < m.njnt; ++j) {
    if (with_actuator && actuator_of(m, j) < 0) continue;
    if (is_ball(m, j)) {
      for (Coordinate& part : from_parts(m, j)) found.push_back(std::move(part));
    } else if (is_single(m, j)) {
      found.emplace_back();
      found.back().name = joint_name(m, j);
      found.back().joints = {driven(m, j, 1.0)};
    }
  }
  return found;
}

// the free joint at the root of the tree of the coordinates
int free_joint_of(const mjModel& m, const std::vector<Coordinate>& coordinates) {
  require(!coordinates.empty(), "a robot that floats wants a joint beside its root");
  const int root = m.body_rootid[m.jnt_bodyid[coordinates.front().joints.front().joint]];
  const int joint = m.body_jntnum[root] > 0 ? m.body_jntadr[root] : -1;
  require(joint >= 0 && m.jnt_type[joint] == mjJNT_FREE,
          "a robot that floats wants a free joint at its root; body '" +
              name_or_number(m, mjOBJ_BODY, root) +
              "' has none: MJCF gives it one by <freejoint/>, hurcules.load_urdf(path, "
              "floating=True) to a URDF");
  return joint;
}

// takes the names of a root's coordinates off the front
bool take_root(const mjModel& m, std::vector<std::string>& names) {
  for (int j = 0; j < m.njnt; ++j) {
    if (m.jnt_type[j] != mjJNT_FREE) continue;
    const std::vector<Coordinate> root = from_parts(m, j);
    const auto same = [](const Coordinate& part, const std::string& name) {
      return part.name == name;
    };
    if (names.size() < root.size() || !std::equal(root.begin(), root.end(), names.begin(), same))
      continue;
    names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(root.size()));
    return true;
  }
  return false;
}

// why a joint of this name can be none
void require_not_free(const mjModel& m, const std::string& name) {
  const int joint = mj_name2id(&m, mjOBJ_JOINT, name.c_str());
  require(joint < 0 || m.jnt_type[joint] != mjJNT_FREE,
          "joint '" + name + "' is free and can be no coordinate by name: Robot(model, " +
              "floating=True) makes it six");
}

// ball joints by the names of their three coordinates
std::vector<std::string> with_parts(const mjModel& m, const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    const int joint = mj_name2id(&m, mjOBJ_JOINT, name.c_str());
    if (joint >= 0 && is_ball(m, joint)) {
      for (const Coordinate& part : from_parts(m, joint)) all.push_back(part.name);
    } else {
      all.push_back(name);
    }
  }
  return all;
}

// the three of a ball joint, none without the others
void require_whole(const mjModel& m, const std::vector<Coordinate>& coordinates) {
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const DrivenJoint& own = coordinates[i].joints.front();
    if (own.part < 0) continue;
    const std::size_t first = i - std::min(i, static_cast<std::size_t>(own.part - kTurns));
    for (int part = kTurns; part < kParts; ++part) {
      const std::size_t at = first + static_cast<std::size_t>(part - kTurns);
      require(at < coordinates.size() && coordinates[at].name == part_name(m, own.joint, part),
              "'" + coordinates[i].name + "' is one of three coordinates of a ball joint: they " +
                  "are wanted together and in their order, as '" + joint_name(m, own.joint) + "'");
    }
  }
}

// each name among the tuples' coordinates, then among the joints
std::vector<Coordinate> chosen(const mjModel& m, std::vector<Coordinate> all,
                               const std::vector<std::string>& names) {
  for (Coordinate& joint : from_joints(m, false)) all.push_back(std::move(joint));
  std::vector<Coordinate> found;
  for (const std::string& name : with_parts(m, names)) {
    const auto same = [&](const Coordinate& coordinate) { return coordinate.name == name; };
    const auto one = std::find_if(all.begin(), all.end(), same);
    if (one == all.end()) {
      require_not_free(m, name);
      std::vector<std::string> existing;
      for (const Coordinate& coordinate : all) existing.push_back(coordinate.name);
      throw Error(unknown_name("joint", name, existing));
    }
    found.push_back(*one);
  }
  require_whole(m, found);
  return found;
}

std::optional<Coupling> coupling_of(const mjModel& m, int equality) {
  const int first = m.eq_obj1id[equality], second = m.eq_obj2id[equality];
  if (m.eq_type[equality] != mjEQ_JOINT || !m.eq_active0[equality] || second < 0)
    return std::nullopt;
  const mjtNum* const c = m.eq_data + mjNEQDATA * equality;
  const bool linear = c[1] != 0.0 && c[2] == 0.0 && c[3] == 0.0 && c[4] == 0.0;
  if (!linear || !is_single(m, first) || !is_single(m, second)) return std::nullopt;
  const int at = m.jnt_qposadr[first], of = m.jnt_qposadr[second];
  return Coupling{first, second, at, of, c[1], m.qpos0[at] + c[0] - c[1] * m.qpos0[of]};
}

using Place = std::pair<std::size_t, std::size_t>;  // coordinate, joint of it

std::optional<Place> find_joint(const std::vector<Coordinate>& all, int joint) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all[i].joints.size(); ++k)
      if (all[i].joints[k].joint == joint) return Place{i, k};
  return std::nullopt;
}

// the first joint of a coupling follows the coordinate of the second; true when that is new
bool follow(const mjModel& m, const Coupling& coupling, std::vector<Coordinate>& all) {
  const std::optional<Place> leader = find_joint(all, coupling.second);
  std::optional<Place> own = find_joint(all, coupling.first);
  if (!leader || (own && own->first == leader->first)) return false;
  const DrivenJoint by = all[leader->first].joints[leader->second];
  std::vector<DrivenJoint>& joints = all[leader->first].joints;
  // the first joint, and what followed it, follow the leader now
  std::vector<DrivenJoint> moved = {driven(m, coupling.first, 1.0)};
  if (own) moved = all[own->first].joints;
  const DrivenJoint first = moved[own ? own->second : 0];
  for (DrivenJoint joint : moved) {
    const double slope = joint.factor / first.factor;
    joint.offset += slope * (coupling.shift + coupling.slope * by.offset - first.offset);
    joint.factor = slope * coupling.slope * by.factor;
    joints.push_back(joint);
  }
  if (own) all.erase(all.begin() + static_cast<std::ptrdiff_t>(own->first));
  return true;
}

// couples what equality constraints couple: several joints become one coordinate
void couple(const mjModel& m, std::vector<Coordinate>& all) {
  bool changed = true;
  while (changed) {
    changed = false;
    for (const Coupling& coupling : find_couplings(m)) {
      changed = follow(m, coupling, all) || changed;
      if (!find_joint(all, coupling.second))
        changed = follow(m, turned_round(coupling), all) || changed;
    }
  }
}

// a limit that is told of no joint would be no limit
void require_limits_of_joints(const mjModel& m) {
  for (int i = 0; i < m.nnumeric; ++i) {
    const std::string name = name_of(m, mjOBJ_NUMERIC, i);
    const auto joint = without(name.c_str(), "velocity_limit_");
    if (!joint) continue;
    if (mj_name2id(&m, mjOBJ_JOINT, joint->c_str()) < 0) {
      throw Error("numeric '" + name +
                  "': " + unknown_name("joint", *joint, names_of(m, {mjOBJ_JOINT})));
    }
    require(m.numeric_size[i] == 1, "numeric '" + name + "' wants one number, " +
                                        std::to_string(m.numeric_size[i]) + " came");
  }
}

// [rad/s] or [m/s] of the joint
double velocity_limit(const mjModel& m, const DrivenJoint& driven_joint) {
  const std::string joint = joint_name(m, driven_joint.joint);
  for (int i = 0; i < m.nnumeric; ++i) {
    if (without(mj_id2name(&m, mjOBJ_NUMERIC, i), "velocity_limit_") != joint) continue;
    const double limit = m.numeric_data[m.numeric_adr[i]];
    require(limit > 0, "velocity limit of joint '" + joint + "' wants to be above 0, " +
                           number_text(limit) + " came");
    return limit;
  }
  return kInfinity;
}

// [N m] or [N] that every actuator of the joint can give both ways, 0 without actuators
double effort_limit(const mjModel& m, int joint, int part) {
  double sum = 0;
  for (int a = 0; a < m.nu; ++a) {
    if (drives(m, a, joint, part)) sum += peak_effort(&m, a);
  }
  if (!m.jnt_actfrclimited[joint]) return sum;
  const double* range = m.jnt_actfrcrange + 2 * joint;
  return std::min(sum, std::min(-range[0], range[1]));
}

// the tightest of what its joints allow, in the units of the coordinate
void set_limits(const mjModel& m, Coordinate& coordinate) {
  coordinate.lower = -kInfinity;
  coordinate.upper = coordinate.max_velocity = kInfinity;
  coordinate.max_effort = 0;
  if (m.jnt_type[coordinate.joints.front().joint] == mjJNT_SLIDE) coordinate.unit = "m";
  for (const DrivenJoint& driven_joint : coordinate.joints) {
    const int joint = driven_joint.joint;
    const double factor = driven_joint.factor;
    if (m.jnt_limited[joint] && is_ball(m, joint)) {  // no part of it turns further than all of it
      coordinate.upper = m.jnt_range[2 * joint + 1];
      coordinate.lower = -coordinate.upper;
    } else if (m.jnt_limited[joint]) {
      const double a = (m.jnt_range[2 * joint] - driven_joint.offset) / factor;
      const double b = (m.jnt_range[2 * joint + 1] - driven_joint.offset) / factor;
      coordinate.lower = std::max(coordinate.lower, std::min(a, b));
      coordinate.upper = std::min(coordinate.upper, std::max(a, b));
    }
    coordinate.max_velocity =
        std::min(coordinate.max_velocity, velocity_limit(m, driven_joint) / std::abs(factor));
    coordinate.max_effort += std::abs(factor) * effort_limit(m, joint, driven_joint.part);
  }
  if (coordinate.max_effort <= 0) coordinate.max_effort = kInfinity;
  require(coordinate.lower <= coordinate.upper,
          "coordinate '" + coordinate.name + "': the ranges of its joints do not meet");
}

void require_separate(const mjModel& m, const std::vector<Coordinate>& coordinates) {
  std::vector<std::string> names;
  for (const Coordinate& coordinate : coordinates) names.push_back(coordinate.name);
  require_distinct(names, "coordinates");
  std::set<int> dofs;
  for (const Coordinate& coordinate : coordinates) {
    for (const DrivenJoint& driven_joint : coordinate.joints)
      require(dofs.insert(driven_joint.dof).second, "joint '" + joint_name(m, driven_joint.joint) +
                                                        "' belongs to one coordinate only, '" +
                                                        coordinate.name + "' names it again");
  }
}

}  // namespace

Coupling turned_round(const Coupling& coupling) {
  return {coupling.second,     coupling.first,       coupling.second_qpos,
          coupling.first_qpos, 1.0 / coupling.slope, -coupling.shift / coupling.slope};
}

std::vector<Coupling> find_couplings(const mjModel& m) {
  std::vector<Coupling> found;
  for (int i = 0; i < m.neq; ++i) {
    if (const std::optional<Coupling> coupling = coupling_of(m, i)) found.push_back(*coupling);
  }
  return found;
}

int actuator_of(const mjModel& m, int joint) {
  return first_actuator(m, joint, -1);
}

int axis_of(const mjModel& m, int actuator) {
  const double* const gear = m.actuator_gear + 6 * actuator;
  if (m.actuator_trntype[actuator] != mjTRN_JOINT) return -1;  // those of the parent turn
  for (int axis = 0; axis < 3; ++axis)
    if (gear[axis] != 0.0 && gear[(axis + 1) % 3] == 0.0 && gear[(axis + 2) % 3] == 0.0)
      return axis;
  return -1;
}

double gear_of(const mjModel& m, int actuator) {
  const double* const gear = m.actuator_gear + 6 * actuator;
  if (!is_ball(m, m.actuator_trnid[2 * actuator])) return gear[0];
  const int axis = axis_of(m, actuator);
  return axis < 0 ? std::hypot(gear[0], gear[1], gear[2]) : gear[axis];
}

std::string part_name(const mjModel& m, int joint, int part) {
  static constexpr std::array<const char*, kParts> kNames = {"x", "y", "z", "rx", "ry", "rz"};
  return joint_name(m, joint) + "_" + kNames[static_cast<std::size_t>(part)];
}

std::string joint_name(const mjModel& m, int joint) {
  const std::string name = name_of(m, mjOBJ_JOINT, joint);
  return name.empty() ? "joint" + std::to_string(joint) : name;
}

bool names_coordinates(const mjModel& m) {
  for (int t = 0; t < m.ntuple; ++t)
    if (without(mj_id2name(&m, mjOBJ_TUPLE, t), "coordinate_")) return true;
  return false;
}

std::vector<Coordinate> find_coordinates(const mjModel& m, const std::vector<std::string>& asked,
                                         bool floating) {
  require_limits_of_joints(m);
  std::vector<std::string> names = asked;
  floating = take_root(m, names) || floating;
  std::vector<Coordinate> found = from_tuples(m);
  if (!names.empty()) {
    found = chosen(m, std::move(found), names);
  } else {
    if (found.empty()) found = from_joints(m, true);
    if (found.empty()) found = from_joints(m, false);
  }
  if (!names_coordinates(m)) couple(m, found);
  for (Coordinate& coordinate : found) set_limits(m, coordinate);
  require_separate(m, found);
  if (!floating) return found;
  std::vector<Coordinate> all = from_parts(m, free_joint_of(m, found));
  all.insert(all.end(), found.begin(), found.end());
  return all;
}

}  // namespace hurcules

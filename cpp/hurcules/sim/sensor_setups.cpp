#include "hurcules/sim/sensor_setups.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

using Array = SensorSource::Array;

void add(SensorSetup& setup, const std::string& entry, SensorSource source) {
  setup.entries.push_back(entry);
  setup.sources.push_back(source);
}

// entries NAME/x, NAME/y, NAME/z, or x, y, z without a name
void add_axes(SensorSetup& setup, const std::string& name, Array array, int address) {
  const std::string prefix = name.empty() ? "" : name + "/";
  for (int i = 0; i < 3; ++i) {
    add(setup, prefix + "xyz" [i], { array, address + i, 1.0 });
  }
}

SensorSetup encoders(const mjModel* m, const std::vector<int>& roots, bool speed) {
  SensorSetup setup{speed ? kEncoderSpeed : kEncoderPosition, speed ? "rad/s" : "rad", {}, {}};
  for (const int joint : encoder_joints(m, roots)) {
    const SensorSource source = speed ? SensorSource{Array::Velocity, m->jnt_dofadr[joint], 1.0}
                                      : SensorSource{Array::Position, m->jnt_qposadr[joint], 1.0};
    add(setup, name_of(*m, mjOBJ_JOINT, joint), source);
  }
  return setup;
}

// body that a sensor sits on, -1 for one that has none
int body_of(const mjModel* m, int sensor) {
  const int id = m->sensor_objid[sensor];
  switch (m->sensor_objtype[sensor]) {
    case mjOBJ_BODY:
    case mjOBJ_XBODY:
      return id;
    case mjOBJ_SITE:
      return m->site_bodyid[id];
    case mjOBJ_GEOM:
      return m->geom_bodyid[id];
    default:
      return -1;
  }
}

bool is_on(const mjModel* m, int sensor, const std::vector<int>& roots) {
  const int body = body_of(m, sensor);
  return body >= 0 && in_trees(*m, body, roots);
}

SensorSetup inertial(const mjModel* m, const std::vector<int>& roots, int type, SensorSetup setup) {
  for (int s = 0; s < m->nsensor; ++s) {
    if (m->sensor_type[s] != type || !is_on(m, s, roots)) continue;
    if (!name_of(*m, mjOBJ_SENSOR, s).ends_with(setup.name)) continue;
    add_axes(setup, "", Array::Sensor, m->sensor_adr[s]);
    break;
  }
  return setup;
}

SensorSetup loads(const mjModel* m, const std::vector<int>& roots) {
  SensorSetup setup{"load", "N", {}, {}};
  for (int s = 0; s < m->nsensor; ++s) {
    const int data = m->sensor_intprm[s * mjNSENS];
    if (m->sensor_type[s] != mjSENS_CONTACT || !is_on(m, s, roots)) continue;
    if (!(data & (1 << mjCONDATA_FORCE)) || m->sensor_intprm[s * mjNSENS + 2] != 1) continue;
    const int skipped = data & (1 << mjCONDATA_FOUND) ? 1 : 0;
    add_axes(setup, name_of(*m, mjOBJ_SENSOR, s), Array::Sensor, m->sensor_adr[s] + skipped);
  }
  return setup;
}

// [m] half the height of a track's first box, else the radius of its first cylinder
double track_radius(const mjModel* m, int tuple) {
  double cylinder = 0.0;
  for (int i = m->tuple_adr[tuple] + 1; i < m->tuple_adr[tuple] + m->tuple_size[tuple]; ++i) {
    const int geom = m->tuple_objid[i];
    if (m->tuple_objtype[i] != mjOBJ_GEOM) continue;
    if (m->geom_type[geom] == mjGEOM_BOX) return m->geom_size[3 * geom + 2];
    if (cylinder == 0.0 && m->geom_type[geom] == mjGEOM_CYLINDER) cylinder = m->geom_size[3 * geom];
  }
  return cylinder;
}

SensorSetup track_speeds(const mjModel* m, const std::vector<int>& roots) {
  SensorSetup setup{"track_speed", "m/s", {}, {}};
  for (int tuple = 0; tuple < m->ntuple; ++tuple) {
    const std::string name = name_of(*m, mjOBJ_TUPLE, tuple);
    const std::size_t at = name.find("track_");
    const int first = m->tuple_adr[tuple];
    if (at == std::string::npos || m->tuple_objtype[first] != mjOBJ_JOINT) continue;
    const int joint = m->tuple_objid[first];
    if (!in_trees(*m, m->jnt_bodyid[joint], roots)) continue;
    add(setup, name.substr(at + 6),
        {Array::Velocity, m->jnt_dofadr[joint], track_radius(m, tuple)});
  }
  return setup;
}

void add_pose(const mjModel* m, int root, std::vector<SensorSetup>& setups) {
  if (m->body_jntnum[root] == 0) return;
  const int joint = m->body_jntadr[root];
  if (m->jnt_type[joint] != mjJNT_FREE) return;
  const int qpos = m->jnt_qposadr[joint], dof = m->jnt_dofadr[joint];
  SensorSetup position{"pose_position", "m", {}, {}}, rotation{kPoseRotation, "1", {}, {}};
  SensorSetup velocity{"pose_velocity", "m/s", {}, {}}, rate{"pose_rate", "rad/s", {}, {}};
  add_axes(position, "", Array::Position, qpos);
  for (int i = 0; i < 4; ++i) {
    add(rotation, std::string(1, "wxyz"[i]), {Array::Position, qpos + 3 + i, 1.0});
  }
  add_axes(velocity, "", Array::Velocity, dof);
  add_axes(rate, "", Array::Velocity, dof + 3);
  for (SensorSetup* setup : {&position, &rotation, &velocity, &rate}) {
    setups.push_back(std::move(*setup));
  }
}

}  // namespace

std::vector<int> encoder_joints(const mjModel* m, const std::vector<int>& roots) {
  std::vector<int> joints;
  for (int a = 0; a < m->nu; ++a) {
    const int joint = m->actuator_trnid[2 * a];
    if (m->actuator_trntype[a] != mjTRN_JOINT || m->jnt_type[joint] < mjJNT_SLIDE) continue;
    if (!in_trees(*m, m->jnt_bodyid[joint], roots)) continue;
    if (std::find(joints.begin(), joints.end(), joint) == joints.end()) joints.push_back(joint);
  }
  return joints;
}

std::vector<SensorSetup> find_sensors(const mjModel* m, const std::vector<int>& roots) {
  std::vector<SensorSetup> setups;
  setups.push_back(encoders(m, roots, false));
  setups.push_back(encoders(m, roots, true));
  setups.push_back(inertial(m, roots, mjSENS_ACCELEROMETER, {"imu_acceleration", "m/s^2", {}, {}}));
  setups.push_back(inertial(m, roots, mjSENS_GYRO, {"imu_rate", "rad/s", {}, {}}));
  setups.push_back(loads(m, roots));
  setups.push_back(track_speeds(m, roots));
  add_pose(m, roots.front(), setups);
  std::erase_if(setups, [](const SensorSetup& setup) { return setup.sources.empty(); });
  return setups;
}

}  // namespace hurcules

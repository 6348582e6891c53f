#include "hurcules/sim/data_quantity.hpp"

#include <mujoco/mujoco.h>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

// of the world: what is fixed to it
bool is_below(const mjModel& m, int body, int above) {
  if (above == 0) return m.body_weldid[body] == 0;
  while (body > above) body = m.body_parentid[body];
  return body == above;
}

double force_below(const mjModel& m, const mjData& d, int body) {
  double sum = 0.0;
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& contact = d.contact[i];
    if (contact.efc_address < 0 || contact.geom[0] < 0 || contact.geom[1] < 0) continue;
    const bool first = is_below(m, m.geom_bodyid[contact.geom[0]], body);
    const bool second = is_below(m, m.geom_bodyid[contact.geom[1]], body);
    if (first == second) continue;
    mjtNum force[6];
    mj_contactForce(&m, &d, i, force);
    sum += force[0];
  }
  return sum;
}

std::vector<std::string> frame_names(const mjModel& m) {
  return names_of(m, {mjOBJ_SITE, mjOBJ_BODY, mjOBJ_CAMERA, mjOBJ_GEOM});
}

// where the position of the first of these (Robot::frame has the same order) with this name stands
std::optional<std::pair<double * mjData_::*, int>> place_of(const mjModel& m,
                                                            const std::string& name) {
  for (const auto& [type, array] : {std::pair{mjOBJ_SITE, &mjData::site_xpos},
                                    {mjOBJ_BODY, &mjData::xpos},
                                    {mjOBJ_CAMERA, &mjData::cam_xpos},
                                    {mjOBJ_GEOM, &mjData::geom_xpos}}) {
    const int id = mj_name2id(&m, type, name.c_str());
    if (id >= 0) return std::pair(array, 3 * id);
  }
  return std::nullopt;
}

}  // namespace

std::optional<DataQuantity> DataQuantity::find(const mjModel& m, const std::string& name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const std::string group = name.substr(0, slash), object = name.substr(slash + 1);
  if (group == "position") {
    if (const auto found = place_of(m, object)) return DataQuantity(found->first, found->second, 3);
    throw Error(unknown_name("frame", object, frame_names(m)));
  }
  if (group == "distance") {
    for (std::size_t k = object.find('/'); k != std::string::npos; k = object.find('/', k + 1)) {
      const auto one = place_of(m, object.substr(0, k)), other = place_of(m, object.substr(k + 1));
      if (!one || !other) continue;
      DataQuantity distance(one->first, one->second, 1);
      distance.other_ = other->first;
      distance.other_place_ = other->second;
      return distance;
    }
    throw Error(unknown_name("distance of two frames", object, frame_names(m)));
  }
  if (group == "joint" || group == "joint_velocity") {
    const int joint = find_object(m, mjOBJ_JOINT, object);
    require(m.jnt_type[joint] == mjJNT_HINGE || m.jnt_type[joint] == mjJNT_SLIDE,
            "joint '" + object + "' wants to be a hinge or a slide");
    if (group == "joint") return DataQuantity(&mjData::qpos, m.jnt_qposadr[joint], 1);
    return DataQuantity(&mjData::qvel, m.jnt_dofadr[joint], 1);
  }
  if (group == "sensor") {
    const int sensor = find_object(m, mjOBJ_SENSOR, object);
    return DataQuantity(&mjData::sensordata, m.sensor_adr[sensor], m.sensor_dim[sensor]);
  }
  if (group == "contact_force") return DataQuantity(nullptr, find_object(m, mjOBJ_BODY, object), 1);
  return std::nullopt;
}

void DataQuantity::read(const mjModel& m, const mjData& d, VectorRef out) const {
  if (other_) {
    const Eigen::Map<const Vector3> one(d.*array_ + place_), other(d.*other_ + other_place_);
    out[0] = (one - other).norm();
  } else if (array_) {
    out = Eigen::Map<const Vector>(d.*array_ + place_, size_);
  } else {
    out[0] = force_below(m, d, place_);
  }
}

}  // namespace hurcules

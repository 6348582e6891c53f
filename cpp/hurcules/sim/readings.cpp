#include "hurcules/sim/readings.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

int require_id(const mjModel* m, int kind, const std::string& name, const std::string& who) {
  const int id = mj_name2id(m, kind, name.c_str());
  require(id >= 0, who + " wants a " + mju_type2Str(kind) + " '" + name + "', the model has none");
  return id;
}

int find_body(const mjModel* m, const std::string& name, const std::string& where) {
  const int id = mj_name2id(m, mjOBJ_BODY, name.c_str());
  if (id >= 0) return id;
  std::vector<std::string> names = names_of(*m, {mjOBJ_BODY});
  names.erase(names.begin());  // the world
  throw Error(where + ": " + unknown_name("body", name, names));
}

PlanarPose pose_on_ground(const mjData* d, int body) {
  const Vector3 place = vector_at(d->xpos, body), left = matrix_at(d->xmat, body).col(1);
  return {place.x(), place.y(), std::atan2(-left.x(), left.y())};
}

PlanarPose centre_on_ground(const mjData* d, int body) {
  const Vector3 centre = vector_at(d->subtree_com, body);
  return {centre.x(), centre.y(), pose_on_ground(d, body).yaw};
}

Vector3 vector_at(const double* values, int i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

Matrix3 matrix_at(const double* values, int i) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values + 9 * i);
}

double weight_of(const mjModel* m, int body) {
  return m->body_subtreemass[body] * std::abs(m->opt.gravity[2]);
}

ContactForce contact_force(const mjModel* m, const mjData* d, int i) {
  mjtNum wrench[6];
  mj_contactForce(m, d, i, wrench);
  // the rows of the frame are the normal and two tangents
  return {matrix_at(d->contact[i].frame, 0).transpose() * vector_at(wrench, 0), wrench[0]};
}

}  // namespace hurcules

#include "hurcules/sim/readings.hpp"

#include <mujoco/mujoco.h>

#include <cmath>

#include "hurcules/base/error.hpp"

namespace hurcules {

int require_id(const mjModel* m, int kind, const std::string& name, const std::string& who) {
  const int id = mj_name2id(m, kind, name.c_str());
  require(id >= 0, who + " wants a " + mju_type2Str(kind) + " '" + name + "', the model has none");
  return id;
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

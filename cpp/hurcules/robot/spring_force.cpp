#include "hurcules/robot/spring_force.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {
namespace {

constexpr double kShortest = 1e-3;  // [m] a lever below this gives no force

// [rad] this near to a stop its contact is on: MuJoCo's soft stops give way by less
constexpr double kStop = 1e-4;

int spring_hinge(const mjModel& m, const std::string& name) {
  std::vector<std::string> springs;
  for (int j = 0; j < m.njnt; ++j) {
    if (m.jnt_type[j] != mjJNT_HINGE || m.jnt_stiffness[j] <= 0.0) continue;
    springs.push_back(name_of(m, mjOBJ_JOINT, j));
    if (springs.back() == name) return j;
  }
  throw Error(unknown_name("hinge with a spring", name, springs));
}

bool is_behind(const mjModel& m, int body, int first) {
  while (body > first) body = m.body_parentid[body];
  return body == first;
}

Vector3 vector(const double* values) {
  return Eigen::Map<const Vector3>(values);
}

}  // namespace

SpringForce::SpringForce(ModelPtr model, const std::string& joint, const std::string& frame)
    : model_(std::move(model)), data_(mj_makeData(model_.get()), mj_deleteData) {
  const mjModel& m = *model_;
  require(data_ != nullptr, "MuJoCo has no memory for this model");
  joint_ = spring_hinge(m, joint);
  frame_ = mj_name2id(&m, mjOBJ_SITE, frame.c_str());
  is_site_ = frame_ >= 0;
  if (!is_site_) frame_ = mj_name2id(&m, mjOBJ_BODY, frame.c_str());
  require(frame_ >= 0, "site or body '" + frame + "' does not exist");
  const int body = is_site_ ? m.site_bodyid[frame_] : frame_;
  require(is_behind(m, body, m.jnt_bodyid[joint_]),
          "frame '" + frame + "' wants to be behind the spring '" + joint + "', it is not");
  const Vector rest = Eigen::Map<const Vector>(m.qpos0, m.nq);
  update(rest, Vector::Zero(m.nv));
}

SpringForce::SpringForce(const SpringForce& other)
    : model_(other.model_),
      data_(mj_makeData(model_.get()), mj_deleteData),
      joint_(other.joint_),
      frame_(other.frame_),
      is_site_(other.is_site_) {
  require(data_ != nullptr, "MuJoCo has no memory for this model");
  const Vector rest = Eigen::Map<const Vector>(model_->qpos0, model_->nq);
  update(rest, Vector::Zero(model_->nv));
}

void SpringForce::update(const ConstVectorRef& qpos, const ConstVectorRef& qvel) {
  const mjModel& m = *model_;
  mjData& d = *data_;
  assert(qpos.size() == m.nq && qvel.size() == m.nv);
  std::copy(qpos.begin(), qpos.end(), d.qpos);
  mj_kinematics(&m, &d);
  mj_comPos(&m, &d);
  const int body = m.jnt_bodyid[joint_], at = m.jnt_qposadr[joint_];
  const Vector3 anchor = vector(d.xanchor + 3 * joint_), axis = vector(d.xaxis + 3 * joint_);
  const Vector3 arm = vector(d.subtree_com + 3 * body) - anchor;
  const Vector3 weight = m.body_subtreemass[body] * vector(m.opt.gravity);
  const double spring = m.jnt_stiffness[joint_] * (m.qpos_spring[at] - qpos[at]);
  const int dof = m.jnt_dofadr[joint_];
  deflection_ = qpos[at];
  moment_ = m.dof_damping[dof] * qvel[dof] - spring - axis.dot(arm.cross(weight));
  const double* const place = is_site_ ? d.site_xpos + 3 * frame_ : d.xpos + 3 * frame_;
  const Vector3 sweep = axis.cross(vector(place) - anchor);
  lever_ = std::max(sweep.norm(), kShortest);
  direction_ = sweep / lever_;
}

Index SpringForce::positions() const {
  return static_cast<Index>(model_->nq);
}
Index SpringForce::velocities() const {
  return static_cast<Index>(model_->nv);
}

bool SpringForce::at_stop() const {
  if (!model_->jnt_limited[joint_]) return false;
  const double* const range = model_->jnt_range + 2 * joint_;
  return deflection_ < range[0] + kStop || deflection_ > range[1] - kStop;
}

}  // namespace hurcules

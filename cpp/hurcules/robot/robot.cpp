// The state of a robot: its names, its configuration and velocity, the body that it stands on.
//
// A free root moves so that this body does not. Where it goes: X_WR = X_WS (where the support stood)
// X_SR (as the joints are now), X_SR by the joints between them alone. How it moves: screws.cpp.
#include "hurcules/robot/robot.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/base/state.hpp"
#include "hurcules/base/values.hpp"
#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/momentum.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;  // [rad] a ball joint that is so far beyond its range is at it

// a hash
std::uint64_t hash_of_coordinates(const std::vector<Coordinate>& coordinates) {
  std::uint64_t hash = kHashOfNothing;
  for (const Coordinate& coordinate : coordinates) hash = hash_of(coordinate.name + ";", hash);
  return hash;
}

// The struct alone, pointing into the model: MuJoCo's kinematics then leave the geoms out, which
// are most of its work.
std::unique_ptr<const mjModel, void (*)(const mjModel*)> without_geoms(const mjModel* model) {
  require(model != nullptr, "a robot wants a model, none came");
  auto* const lean = new mjModel(*model);
  lean->ngeom = 0;
  return {lean, [](const mjModel* m) { delete m; }};
}

// [rad/s] or [m/s] below which a joint may stick on a real robot
constexpr double kSticks = 2e-3;

// Where MuJoCo's friction is all of `frictionloss`: it is a soft constraint of force -v b / R, with
// R = (1 - d) / d A, b = 2 / (d_max T) (its documentation, "Computation": solver parameters).
double slides_from(const mjModel& m, int dof) {
  const mjtNum* const reference = m.dof_solref + mjNREF * dof;
  const mjtNum* const impedance = m.dof_solimp + mjNIMP * dof;
  const double d_max = std::clamp(impedance[1], mjMINIMP, mjMAXIMP);
  const double d_0 = std::clamp(impedance[0], mjMINIMP, mjMAXIMP);
  const double d = impedance[2] > mjMINVAL ? d_0 : 0.5 * (d_0 + d_max);  // without a width: flat
  const bool safe = !(m.opt.disableflags & mjDSBL_REFSAFE);
  const double T = safe ? std::max(reference[0], 2.0 * m.opt.timestep) : reference[0];
  const double b = reference[0] > 0.0 ? 2.0 / (d_max * T) : -reference[1] / d_max;
  const double R = (1.0 - d) / d * m.dof_invweight0[dof];
  return b > 0.0 ? m.dof_frictionloss[dof] * R / b : 0.0;
}

}  // namespace

void add_step(const std::vector<RotationVector>& rotations, const ConstVectorRef& step,
              VectorRef q) {
  auto next = rotations.begin();
  for (Index i = 0; i < q.size();) {
    if (next == rotations.end() || i < next->first) {
      q[i] += step[i];
      ++i;
      continue;
    }
    const Vector3 turn = step.segment<3>(i), before = q.segment<3>(i);
    if (turn.squaredNorm() > 0.0)  // at rest it keeps its bits
      q.segment<3>(i) = rotation_log(rotation_exp(before) * rotation_exp(turn));
    i += 3;
    ++next;
  }
}

void hold_ranges(const std::vector<RotationVector>& rotations, const ConstVectorRef& before,
                 VectorRef q) {
  for (const RotationVector& rotation : rotations) {
    auto r = q.segment<3>(rotation.first);
    const double was = before.segment<3>(rotation.first).norm(), angle = r.norm();
    const double most = was > rotation.range + kRounding ? was : rotation.range;
    if (angle > most) r *= most / angle;
  }
}

Robot::Robot(ModelPtr model, const std::vector<std::string>& joints, bool floating)
    : model_(std::move(model)), lean_(without_geoms(model_.get())), data_(nullptr, mj_deleteData) {
  const mjModel& m = *model_;
  coordinates_ = find_coordinates(m, joints, floating);
  identity_ = {structure_of(m), hash_of_coordinates(coordinates_), size()};
  floating_ = size() > 0 && coordinates_[0].joints[0].part == 0;
  find_rotations();
  if (!names_coordinates(m))
    closures_ = std::make_unique<Closures>(m, coordinates_, !joints.empty());
  if (closures_ && closures_->size() == 0) closures_.reset();
  data_.reset(mj_makeData(&m));
  require(data_ != nullptr, "MuJoCo has no memory for this model");
  q_ = Vector::Zero(size());
  v_ = change_ = Vector::Zero(size());
  find_dry_friction(m);
  inertia_ = Matrix::Zero(m.nv, m.nv);
  column_ = Vector::Zero(m.nv);
  efforts_ = Vector::Zero(m.nv);
  find_trees();
  const int root = root_body();
  const int joint = m.body_jntnum[root] > 0 ? m.body_jntadr[root] : -1;
  if (joint >= 0 && m.jnt_type[joint] == mjJNT_FREE) {
    root_qpos_ = m.jnt_qposadr[joint];
    root_dof_ = m.jnt_dofadr[joint];
  }
  find_screws();
  set_keyframe("");
}

Robot::~Robot() = default;

void Robot::find_trees() {
  if (size() > 0) trees_.clear();
  for (const Coordinate& coordinate : coordinates_) {
    for (const DrivenJoint& joint : coordinate.joints) {
      const int root = model_->body_rootid[model_->jnt_bodyid[joint.joint]];
      if (std::find(trees_.begin(), trees_.end(), root) == trees_.end()) trees_.push_back(root);
    }
  }
}

double Robot::timestep() const {
  return model_->opt.timestep;
}

Frame Robot::support() const {
  return {mjOBJ_BODY, support_ < 0 ? root_body() : support_};
}

std::string Robot::support_name() const {
  return support_ < 0 ? "" : name_of(*model_, mjOBJ_BODY, support_);
}

std::vector<std::string> Robot::coordinate_names() const {
  std::vector<std::string> found;
  for (const Coordinate& coordinate : coordinates_) found.push_back(coordinate.name);
  return found;
}

Index Robot::coordinate(const std::string& name) const {
  const auto same = [&](const Coordinate& coordinate) { return coordinate.name == name; };
  const auto found = std::find_if(coordinates_.begin(), coordinates_.end(), same);
  if (found == coordinates_.end())
    throw Error(unknown_name("coordinate", name, coordinate_names()));
  return found - coordinates_.begin();
}

Frame Robot::frame(const std::string& name) const {
  for (const int type : {mjOBJ_SITE, mjOBJ_BODY, mjOBJ_CAMERA, mjOBJ_GEOM}) {
    const int id = mj_name2id(model_.get(), type, name.c_str());
    if (id < 0) continue;
    if (type == mjOBJ_CAMERA && model_->cam_mode[id] != mjCAMLIGHT_FIXED)
      throw Error("camera '" + name + "' follows something; a frame is fixed in a body");
    return {type, id};
  }
  const auto existing = names_of(*model_, {mjOBJ_SITE, mjOBJ_BODY, mjOBJ_CAMERA, mjOBJ_GEOM});
  throw Error(unknown_name("frame", name, existing));
}

bool Robot::is_body(Frame frame) const {
  return frame.type == mjOBJ_BODY;
}

std::string Robot::differs(const ModelIdentity& wanted) const {
  if (wanted.coordinates != size())
    return std::to_string(wanted.coordinates) + " coordinates are wanted, " +
           std::to_string(size()) + " came";
  if (wanted.structure != identity_.structure) return "the models differ";
  std::string names;
  for (const Coordinate& coordinate : coordinates_)
    names += (names.empty() ? "" : ", ") + coordinate.name;
  return "other coordinates of the same model are wanted than " + names;
}

Index Robot::nv() const {
  return model_->nv;
}

Index Robot::nu() const {
  return model_->nu;
}

Index Robot::sensor_rows() const {
  return model_->nsensordata;
}

void Robot::set_qpos(const ConstVectorRef& qpos) {
  require_values("set_qpos", qpos, model_->nq);
  qpos_ = qpos;
  read_qpos();
}

void Robot::set_configuration(const ConstVectorRef& q) {
  require_values("set_configuration", q, size());
  for (Index i = root_size(); i < size(); ++i)
    for (const DrivenJoint& joint : coordinates_[i].joints)
      if (joint.part < 0) qpos_[joint.qpos] = joint.factor * q[i] + joint.offset;
  if (floating_) qpos_.segment<3>(root_qpos_) = q.head<3>();
  if (closures_) change_ = q - q_;
  for (const RotationVector& rotation : rotations_) {
    const Matrix3 R = rotation_exp(Vector3(q.segment<3>(rotation.first)));
    if (closures_ && !change_.segment<3>(rotation.first).isZero(0.0))
      change_.segment<3>(rotation.first) =
          rotation_log(rotation_of(qpos_.data() + rotation.qpos).transpose() * R);
    const Eigen::Quaterniond turn(R);
    qpos_.segment<4>(rotation.qpos) << turn.w(), turn.vec();
  }
  if (closures_) closures_->close(qpos_.data(), change_);
  keep_support();
  screws_stale_ = std::max(screws_stale_, Stale::Places);
  note_motion();
}

void Robot::set_velocity(const ConstVectorRef& velocity) {
  require_values("set_velocity", velocity, size());
  v_ = velocity;
  for (Index i = 0; i < size(); ++i)
    for (const DrivenJoint& joint : coordinates_[i].joints)
      data_->qvel[joint.dof] = joint.factor * v_[i];
  note_velocity();
}

void Robot::set_keyframe(const std::string& name) {
  const mjModel& m = *model_;
  const int key = name.empty() ? -1 : mj_name2id(&m, mjOBJ_KEY, name.c_str());
  if (key < 0 && !name.empty())
    throw Error(unknown_name("keyframe", name, names_of(m, {mjOBJ_KEY})));
  qpos_ = Eigen::Map<const Vector>(key < 0 ? m.qpos0 : m.key_qpos + key * m.nq, m.nq);
  read_qpos();
  if (closures_) closures_->measure(qpos_.data());
  bool open = closures_ && closures_->error() > Closures::kOpen;
  for (Index i = root_size(); i < size(); ++i) {
    for (const DrivenJoint& joint : coordinates_[i].joints) {  // mimic joints may have an offset
      const double follows = joint.factor * q_[i] + joint.offset;
      open = open || (joint.part < 0 && std::abs(qpos_[joint.qpos] - follows) > Closures::kOpen);
    }
  }
  if (open) set_configuration(Vector(q_));
}

void Robot::coordinates_of(const ConstVectorRef& qpos, VectorRef q) const {
  if (qpos.size() != model_->nq || q.size() != size())
    throw Error("coordinates_of wants qpos of " + std::to_string(model_->nq) + " and q of " +
                std::to_string(size()) + " values, " + std::to_string(qpos.size()) + " and " +
                std::to_string(q.size()) + " came");
  for (Index i = root_size(); i < size(); ++i) {
    const DrivenJoint& first = coordinates_[i].joints.front();
    q[i] = (qpos[first.qpos] - first.offset) / first.factor;
  }
  if (floating_) q.head<3>() = qpos.segment<3>(root_qpos_);
  for (const RotationVector& rotation : rotations_)
    q.segment<3>(rotation.first) = rotation_log(rotation_of(qpos.data() + rotation.qpos));
}

void Robot::velocities_of(const ConstVectorRef& qvel, VectorRef velocity) const {
  if (qvel.size() != model_->nv || velocity.size() != size())
    throw Error("velocities_of wants qvel of " + std::to_string(model_->nv) + " and velocity of " +
                std::to_string(size()) + " values, " + std::to_string(qvel.size()) + " and " +
                std::to_string(velocity.size()) + " came");
  for (Index i = 0; i < size(); ++i) {
    const DrivenJoint& first = coordinates_[i].joints.front();
    velocity[i] = qvel[first.dof] / first.factor;
  }
}

void Robot::stand_on(const std::string& body) {
  const Frame frame = this->frame(body);
  require(frame.type == mjOBJ_BODY, "a robot stands on a body; '" + body + "' is none");
  stand_on(frame);
}

void Robot::stand_on(Frame frame) {
  const mjModel& m = *model_;
  require(is_body(frame) && frame.id < m.nbody, "a robot stands on a body of its model");
  const std::string body = name_of(m, mjOBJ_BODY, frame.id);
  const int root = m.body_rootid[frame.id];
  require(size() > 0 && root == root_body(),
          "'" + body + "' belongs to another tree than the coordinates");
  require(!floating_, "a robot whose root is a coordinate stands by its contacts (ContactTask); '" +
                          body + "' cannot hold it");
  require(root_qpos_ >= 0, "a robot stands on a body of a tree with a free joint; '" + body +
                               "' is bolted to the world");
  require(!closures_ || !closures_->feels(root_dof_),
          "a robot that is tied to the ground or to another robot stands there, on '" + body +
              "' it cannot: Robot(model, floating=True) moves its root by contacts");
  const bool stood = support_ >= 0;
  support_ = frame.id;
  if (stood) {
    screws_->stand_on(support_);
  } else {
    find_screws();
  }
  read_qpos();
}

void Robot::note_support() {
  if (support_ < 0) return;
  const Skeleton::Pose stands = screws().pose(support_);
  p_WS_ = stands.p;
  R_WS_ = stands.R;
}

void Robot::keep_support() {
  if (support_ < 0) return;
  const Skeleton::Pose RS = Skeleton::between(*model_, root_body(), support_, qpos_.data());
  const Matrix3 R = R_WS_ * RS.R.transpose();
  const Eigen::Quaterniond turn(R);
  qpos_.segment<3>(root_qpos_) = p_WS_ - R * RS.p;
  qpos_.segment<4>(root_qpos_ + 3) << turn.w(), turn.x(), turn.y(), turn.z();
}

void Robot::find_dry_friction(const mjModel& m) {
  dry_friction_.resize(coordinates_.size());
  if (m.opt.disableflags & mjDSBL_FRICTIONLOSS) return;
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    for (const DrivenJoint& joint : coordinates_[i].joints) {
      if (m.dof_frictionloss[joint.dof] <= 0.0) continue;
      const double factor = std::abs(joint.factor);
      dry_friction_[i].push_back({factor * m.dof_frictionloss[joint.dof],
                                  std::max(kSticks, slides_from(m, joint.dof) / factor)});
    }
    std::sort(dry_friction_[i].begin(), dry_friction_[i].end(),
              [](const DryFriction& a, const DryFriction& b) { return a.slides < b.slides; });
  }
}

void Robot::find_rotations() {
  const mjModel& m = *model_;
  for (Index i = 0; i < size(); ++i) {
    const DrivenJoint& joint = coordinates_[i].joints.front();
    if (joint.part != kTurns) continue;
    const bool free = m.jnt_type[joint.joint] == mjJNT_FREE;
    rotations_.push_back(
        {i, joint.joint, joint.qpos + (free ? 3 : 0), free ? kInfinity : coordinates_[i].upper});
  }
}

void Robot::find_screws() {
  screws_ = std::make_unique<Screws>(*model_, coordinates_, closures_.get(), root_body(), support_);
  momentum_ = std::make_unique<Momentum>(*model_, root_body(), screws_->skeleton());
}

void Robot::read_qpos() {
  if (closures_) closures_->measure(qpos_.data());
  screws_stale_ = Stale::All;
  note_support();
  note_motion();
}

void Robot::note_motion() {
  fresh_ = false;
  coordinates_of(qpos_, q_);
  note_velocity();
}

void Robot::note_velocity() {
  if (closures_) {
    for (Index f = 0; f < closures_->size(); ++f)
      data_->qvel[closures_->dof(f)] = closures_->share().row(f).dot(v_);
    closures_->set_velocity(qpos_.data(), data_->qvel);
  }
  screws_stale_ = std::max(screws_stale_, Stale::Velocity);
}

const Screws& Robot::screws() const {
  if (screws_stale_ == Stale::Nothing) return *screws_;
  if (screws_stale_ == Stale::All) screws_->note(qpos_.data());
  if (screws_stale_ >= Stale::Places) screws_->place(qpos_.data());
  screws_->set_velocity(v_);
  momentum_stale_ = std::max(momentum_stale_, screws_stale_);
  screws_stale_ = Stale::Nothing;
  return *screws_;
}

const Momentum& Robot::momentum() const {
  const Screws& screws = this->screws();
  if (momentum_stale_ == Stale::All) momentum_->note(screws.skeleton());
  if (momentum_stale_ >= Stale::Places) momentum_->place(screws);
  if (momentum_stale_ >= Stale::Velocity) momentum_->forget_rate();
  momentum_stale_ = Stale::Nothing;
  return *momentum_;
}

void Robot::need_mujoco() const {
  if (support_ >= 0)
    Eigen::Map<Screw>(data_->qvel + root_dof_).noalias() = screws().root_motion() * v_;
  if (fresh_) return;
  std::copy(qpos_.begin(), qpos_.end(), data_->qpos);
  mj_kinematics(lean_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
  fresh_ = true;
}

}  // namespace hurcules

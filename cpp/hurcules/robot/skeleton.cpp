#include "hurcules/robot/skeleton.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <cstring>
#include <utility>

#include "hurcules/base/pose.hpp"

namespace hurcules {
namespace {

using Pose = Skeleton::Pose;

// in the body's parent, before its joints
Pose mounted(const mjModel& m, int body) {
  return {vector_of(m.body_pos + 3 * body), rotation_of(m.body_quat + 4 * body)};
}

// by its own joints; `see` (joint, axis, anchor) is told each of them before it moves
template <class See>
Pose moved(const mjModel& m, int body, Pose pose, const double* qpos, See&& see) {
  const int end = m.body_jntadr[body] + m.body_jntnum[body];
  for (int joint = m.body_jntadr[body]; joint < end; ++joint) {
    const int address = m.jnt_qposadr[joint];
    const double* const q = qpos + address;
    const auto axis = vector_of(m.jnt_axis + 3 * joint);
    const Vector3 turned = pose.R * axis;
    const Vector3 anchor = pose.p + pose.R * vector_of(m.jnt_pos + 3 * joint);
    see(joint, turned, anchor);
    if (m.jnt_type[joint] == mjJNT_FREE) return {vector_of(q), rotation_of(q + 3)};
    if (m.jnt_type[joint] == mjJNT_SLIDE) {
      pose.p += (q[0] - m.qpos0[address]) * turned;
      continue;
    }
    // about its anchor, which stays
    pose.R = pose.R * (m.jnt_type[joint] == mjJNT_BALL
                           ? rotation_of(q)
                           : Eigen::AngleAxisd(q[0] - m.qpos0[address], axis).toRotationMatrix());
    pose.p = anchor - pose.R * vector_of(m.jnt_pos + 3 * joint);
  }
  return pose;
}

constexpr auto kUnseen = [](int, const Vector3&, const Vector3&) {};

}  // namespace

Skeleton::Skeleton(const mjModel& m, const std::vector<int>& driven, int root)
    : bodies_(static_cast<std::size_t>(m.nbody)),
      index_of_joint_(static_cast<std::size_t>(m.njnt), -1),
      axes_(driven.size(), Vector3::Zero()),
      anchors_(driven.size(), Vector3::Zero()) {
  for (std::size_t j = 0; j < driven.size(); ++j)
    index_of_joint_[static_cast<std::size_t>(driven[j])] = static_cast<int>(j);
  find_bones(m, driven, root);
  find_held(m);
  poses_.resize(bones_.size());
}

void Skeleton::find_bones(const mjModel& m, const std::vector<int>& driven, int root) {
  std::vector<bool> is_bone(bodies_.size(), false);
  if (root >= 0) is_bone[static_cast<std::size_t>(root)] = true;
  for (const int joint : driven) is_bone[static_cast<std::size_t>(m.jnt_bodyid[joint])] = true;
  // bodies come after their parents
  for (int body = 1; body < m.nbody; ++body) {
    const auto b = static_cast<std::size_t>(body);
    const int parent = bodies_[static_cast<std::size_t>(m.body_parentid[body])].bone;
    bodies_[b].bone = parent;
    if (!is_bone[b]) continue;
    bodies_[b] = {static_cast<int>(bones_.size()), true, {}};
    bones_.push_back({body, parent, body == root, {}});
  }
}

void Skeleton::find_held(const mjModel& m) {
  for (int joint = 0; joint < m.njnt; ++joint) {
    if (bodies_[static_cast<std::size_t>(m.jnt_bodyid[joint])].is_bone) continue;
    const int type = m.jnt_type[joint], first = m.jnt_qposadr[joint];
    const int size = type == mjJNT_FREE ? 7 : type == mjJNT_BALL ? 4 : 1;
    for (int i = 0; i < size; ++i) held_.push_back(first + i);
  }
  read_.resize(held_.size() + static_cast<std::size_t>(7 * m.nbody + 6 * m.njnt + m.nq));
}

void Skeleton::note(const mjModel& m, const double* qpos) {
  // the model's numbers too: who owns it may have written them anew
  bool same = std::exchange(noted_, true);
  double* place = read_.data();
  const auto take = [&](const double* values, mjtSize count) {
    const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(double);
    if (std::memcmp(place, values, bytes) != 0) {
      std::memcpy(place, values, bytes);
      same = false;
    }
    place += count;
  };
  for (const int address : held_) take(qpos + address, 1);
  take(m.body_pos, 3 * m.nbody);
  take(m.body_quat, 4 * m.nbody);
  take(m.jnt_pos, 3 * m.njnt);
  take(m.jnt_axis, 3 * m.njnt);
  take(m.qpos0, m.nq);
  if (same) return;
  for (int body = 1; body < m.nbody; ++body) {
    Hanging& hanging = bodies_[static_cast<std::size_t>(body)];
    const Pose& parent = bodies_[static_cast<std::size_t>(m.body_parentid[body])].pose;
    if (hanging.is_bone) {
      bones_[static_cast<std::size_t>(hanging.bone)].mounted = parent * mounted(m, body);
    } else {
      hanging.pose = parent * moved(m, body, mounted(m, body), qpos, kUnseen);
    }
  }
}

void Skeleton::place(const mjModel& m, const double* qpos) {
  const auto see = [this](int joint, const Vector3& axis, const Vector3& anchor) {
    const int j = index_of_joint_[static_cast<std::size_t>(joint)];
    if (j < 0) return;
    axes_[static_cast<std::size_t>(j)] = axis;
    anchors_[static_cast<std::size_t>(j)] = anchor;
  };
  for (std::size_t i = 0; i < bones_.size(); ++i) {
    const Bone& bone = bones_[i];
    if (bone.root) {
      const double* const q = qpos + m.jnt_qposadr[m.body_jntadr[bone.body]];
      poses_[i] = {vector_of(q), rotation_of(q + 3)};
    } else {
      poses_[i] = moved(m, bone.body, of_bone(bone.parent) * bone.mounted, qpos, see);
    }
  }
}

Pose Skeleton::pose(int body) const {
  const Hanging& hanging = bodies_[static_cast<std::size_t>(body)];
  if (hanging.bone < 0) return hanging.pose;
  const Pose& bone = poses_[static_cast<std::size_t>(hanging.bone)];
  return hanging.is_bone ? bone : bone * hanging.pose;
}

Vector3 Skeleton::position(int body) const {
  const Hanging& hanging = bodies_[static_cast<std::size_t>(body)];
  if (hanging.bone < 0) return hanging.pose.p;
  const Pose& bone = poses_[static_cast<std::size_t>(hanging.bone)];
  return hanging.is_bone ? bone.p : Vector3(bone.p + bone.R * hanging.pose.p);
}

Pose Skeleton::between(const mjModel& m, int ancestor, int body, const double* qpos) {
  Pose pose;
  for (; body != ancestor; body = m.body_parentid[body])
    pose = moved(m, body, mounted(m, body), qpos, kUnseen) * pose;
  return pose;
}

Pose Skeleton::before(const mjModel& m, int joint, const Pose& pose, const double* qpos) {
  const int address = m.jnt_qposadr[joint];
  const auto axis = vector_of(m.jnt_axis + 3 * joint), own = vector_of(m.jnt_pos + 3 * joint);
  const double* const q = qpos + address;
  if (m.jnt_type[joint] == mjJNT_SLIDE)
    return {pose.p - (q[0] - m.qpos0[address]) * (pose.R * axis), pose.R};
  const Vector3 anchor = pose.p + pose.R * own;
  const Matrix3 R =
      pose.R * (m.jnt_type[joint] == mjJNT_BALL
                    ? Matrix3(rotation_of(q).transpose())
                    : Eigen::AngleAxisd(m.qpos0[address] - q[0], axis).toRotationMatrix());
  return {anchor - R * own, R};
}

}  // namespace hurcules

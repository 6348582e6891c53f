// Forward kinematics of the bodies that the coordinates move, and of nothing else.
//
// A bone is a body with a driven joint, or a root that stands on another body. All other bodies
// hang on a bone, or on the world, where they hung when `note` looked: their own joints are held.
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"

struct mjModel_;

namespace hurcules {

class Skeleton {
 public:
  struct Pose {
    Vector3 p = Vector3::Zero();  // [m] in W
    Matrix3 R = Matrix3::Identity();
  };
  // `driven`: joints, in the order of the model; `root`: a body whose pose comes from outside, -1
  // for none
  Skeleton(const mjModel_& model, const std::vector<int>& driven, int root);

  // what hangs where; qpos (nq), of which all but the driven joints are read
  void note(const mjModel_& model, const double* qpos);
  // the bones; qpos (nq), of which the driven joints and a root's seven numbers are read
  void place(const mjModel_& model, const double* qpos);

  [[nodiscard]] Pose pose(int body) const;
  [[nodiscard]] Vector3 position(int body) const;  // [m] of its origin in W
  // the bones, parents first; -1 stands for the world
  [[nodiscard]] int bones() const { return static_cast<int>(bones_.size()); }
  [[nodiscard]] int body_of(int bone) const { return at(bone).body; }
  [[nodiscard]] int parent_of(int bone) const { return at(bone).parent; }
  [[nodiscard]] Pose of_bone(int bone) const {
    return bone < 0 ? Pose{} : poses_[static_cast<std::size_t>(bone)];
  }
  // on which a body hangs, and how: in the bone, or in W
  [[nodiscard]] int bone_of(int body) const { return bodies_[static_cast<std::size_t>(body)].bone; }
  [[nodiscard]] const Pose& hanging(int body) const {
    return bodies_[static_cast<std::size_t>(body)].pose;
  }
  // of driven joint j, in W
  [[nodiscard]] const Vector3& axis(Index j) const { return axes_[static_cast<std::size_t>(j)]; }
  [[nodiscard]] const Vector3& anchor(Index j) const {
    return anchors_[static_cast<std::size_t>(j)];
  }
  // pose of a body in an ancestor of its, by the joints in between
  [[nodiscard]] static Pose between(const mjModel_& model, int ancestor, int body,
                                    const double* qpos);
  // where a body was that stands at this pose before its last joint, this one, moved it
  [[nodiscard]] static Pose before(const mjModel_& model, int joint, const Pose& pose,
                                   const double* qpos);

 private:
  struct Bone {
    int body = 0;
    int parent = -1;  // bone, -1: the world
    bool root = false;
    Pose mounted;  // in the parent bone, or in W, before its own joints
  };
  struct Hanging {
    int bone = -1;
    bool is_bone = false;
    Pose pose;  // in the bone, or in W
  };
  void find_bones(const mjModel_& model, const std::vector<int>& driven, int root);
  void find_held(const mjModel_& model);
  [[nodiscard]] const Bone& at(int bone) const { return bones_[static_cast<std::size_t>(bone)]; }

  std::vector<Bone> bones_;  // parents first
  std::vector<Pose> poses_;  // of the bones in W
  std::vector<Hanging> bodies_;
  std::vector<int> index_of_joint_;  // (njnt), -1 unless driven
  std::vector<Vector3> axes_, anchors_;
  std::vector<int> held_;     // addresses in qpos that `note` reads
  std::vector<double> read_;  // what it read there, and in the model: the same again says the same
  bool noted_ = false;
};

// X_AC = X_AB X_BC
[[nodiscard]] inline Skeleton::Pose operator*(const Skeleton::Pose& ab, const Skeleton::Pose& bc) {
  return {ab.p + ab.R * bc.p, ab.R * bc.R};
}

}  // namespace hurcules

// How bodies move with the coordinates: a screw for each driven joint, and its rate.
//
//   V_b = sum S_j qdot_j       of the driven joints j that move body b
//   A_b = sum V_<j x S_j qdot_j                  at constant coordinate velocities; V_<j: without j
//   a point: v = V.lin + w x r,  a = A.lin + A.rot x r + w x v        r: from the tree's origin
// A free joint is six of them: three slides in W, and three turns at once about the axes of its body; a
// ball joint is the turns. A joint that follows (closures.hpp) moves by G qdot, its rate has S g too.
// A root that stands on another body s moves by -V_s and accelerates by -A_s: then s does not.
#pragma once

#include <span>
#include <vector>

#include "hurcules/base/types.hpp"
#include "hurcules/robot/skeleton.hpp"

struct mjModel_;

namespace hurcules {

class Closures;
struct Coordinate;

// Angular and linear velocity in W of what is fixed to a body, the linear one of the point that is
// at the origin of the body's tree at this moment; or their rates.
using Screw = Eigen::Matrix<double, 6, 1>;

// A point of a body.
struct BodyPoint {
  int body = 0;
  Vector3 point = Vector3::Zero();  // [m] in W
};

class Screws {
 public:
  // `support`: the body that stands, of the tree with this root; -1: every root does. `closures` may
  // be null; it is asked for what it measured last.
  Screws(const mjModel_& model, const std::vector<Coordinate>& coordinates,
         const Closures* closures, int root, int support);

  // another body of the tree stands; not for a tree whose root stood
  void stand_on(int support) { support_ = support; }

  // what hangs where; qpos (nq), of which all but the driven joints are read
  void note(const double* qpos) { skeleton_.note(*model_, qpos); }
  // poses and screws; qpos (nq), of which the driven joints and the root are read
  void place(const double* qpos);
  // rates of the screws, where they are now; velocity of the coordinates [rad/s] (n)
  void set_velocity(const Vector& velocity);

  [[nodiscard]] Skeleton::Pose pose(int body) const { return skeleton_.pose(body); }
  [[nodiscard]] bool moves(int body) const { return stands(body) || !above(body).empty(); }
  [[nodiscard]] bool moves(int first, int second) const {  // against each other
    return above(first) != above(second) || stands(first) != stands(second);
  }
  // velocity of a point of a body, and angular velocity of the body, by coordinate: (3, n) in W
  void point_jacobian(const Vector3& point, int body, MatrixRef J) const;
  void rotation_jacobian(int body, MatrixRef J) const;
  // (n) how fast the second point leaves the first along a direction, by coordinate
  void separation(const BodyPoint& first, const BodyPoint& second, const Vector3& direction,
                  Eigen::Ref<Eigen::RowVectorXd> row) const;
  // act(i, body, S): coordinate i moves the body, and all below it, by S; several add up
  template <class Act>  // each_screw.hpp
  void each_screw(Act&& act) const;
  // what they accelerate with when the coordinates do not
  [[nodiscard]] Vector3 point_drift(const Vector3& point, int body) const;
  [[nodiscard]] Vector3 rotation_drift(int body) const;
  // of a body, at the velocity of set_velocity, while it is moving
  [[nodiscard]] Screw velocity_of(int body) const;
  [[nodiscard]] Screw rate_of(int body) const;
  [[nodiscard]] bool moving() const { return moving_; }  // only then is there a drift
  [[nodiscard]] Vector3 origin(int body) const;          // of its tree
  [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
  // (6, n): qvel of a root that stands on another body, by coordinate
  [[nodiscard]] const Eigen::Matrix<double, 6, Eigen::Dynamic>& root_motion() const {
    return root_motion_;
  }

 private:
  // one joint of one coordinate, or one that follows
  struct Driven {
    Index coordinate;  // -1: it follows
    Index follower;    // among those, else -1
    int joint, body;
    double factor;
    int part;                     // of a free or a ball joint, else -1
    Screw screw = Screw::Zero();  // at the coordinate's velocity 1
    Screw rate = Screw::Zero();   // at its velocity
    double speed = 0.0;           // that velocity, of the last set_velocity
    Index before = -1;            // the joint before it on the way from the root, -1: none
    // of what it moves, by all joints from the root to it: velocity and its rate
    Screw velocity_to = Screw::Zero(), rate_to = Screw::Zero();
  };

  [[nodiscard]] static std::vector<Driven> driven_of(const mjModel_& model,
                                                     const std::vector<Coordinate>& coordinates,
                                                     const Closures* closures);
  void find_above();
  [[nodiscard]] const std::vector<Index>& above(int body) const {
    return above_[static_cast<std::size_t>(body)];
  }
  [[nodiscard]] const Driven& driven(Index j) const { return driven_[static_cast<std::size_t>(j)]; }
  // the coordinates that move a joint, each with the joint's velocity at its velocity 1
  template <class Act>
  void each_coordinate(const Driven& joint, Act&& act) const;
  // its tree stands on something else than the root
  [[nodiscard]] bool stands(int body) const;
  // of the root of its tree
  [[nodiscard]] Screw root_velocity_of(int body) const;
  [[nodiscard]] Screw root_rate_of(int body) const;
  // (3, n): `of` a screw of each coordinate
  template <class Of>
  void fill(int body, MatrixRef J, Of&& of) const;
  // to a row, by coordinate: how fast the joints move a point along a direction
  void add_rates(std::span<const Index> joints, const BodyPoint& at, const Vector3& direction,
                 Eigen::Ref<Eigen::RowVectorXd> row) const;
  void note_root();

  const mjModel_* model_;
  const Closures* closures_;
  int root_, support_;
  std::vector<Driven> driven_;             // in the order of the model's joints
  std::vector<std::vector<Index>> above_;  // (nbody) which of them move a body
  Skeleton skeleton_;
  Vector velocity_;  // (n)
  bool moving_ = false;
  // of the root, where it stands on another body
  Screw root_velocity_ = Screw::Zero(), root_rate_ = Screw::Zero();
  Eigen::Matrix<double, 6, Eigen::Dynamic> root_motion_;
};

}  // namespace hurcules

// Centre of mass and momentum of a tree of bodies, by coordinate, and their rates.
//
//   h = m r, p = m v + w x h, L = I w + h x v   of a part: what hangs on one bone, and is rigid
//   F = m A.lin + A.rot x h + w x p,  N = I A.rot + h x A.lin + w x L + v x p    A: its rate
// (w, v) and A: screws.hpp; I, L, N about the origin o of the tree, r from there, in W. What a joint
// moves are its part and all below, their sums. About the centre of mass c: L - c x p, N - c x F.
#pragma once

#include <optional>
#include <vector>

#include "hurcules/base/types.hpp"
#include "hurcules/robot/screws.hpp"

struct mjModel_;

namespace hurcules {

class Momentum {
 public:
  // of the tree with this root; 0: of all bodies
  Momentum(const mjModel_& model, int root, const Skeleton& skeleton);

  // the parts, where what hangs on the bones has changed; allocates nothing
  void note(const Skeleton& skeleton);
  // where they are now
  void place(const Screws& screws);
  // the coordinates move otherwise
  void forget_rate() { rate_.reset(); }

  [[nodiscard]] const Vector3& com() const { return com_; }  // [m] in W
  // (3, n) of the centre of mass, [m/s] a unit; of the angular momentum about it [kg m^2] (hinges)
  void com_jacobian(const Screws& screws, MatrixRef J) const;
  void angular_jacobian(const Screws& screws, MatrixRef A) const;
  // what they change with when the coordinates' velocities do not: [m/s^2], [N m]
  [[nodiscard]] Vector3 com_drift(const Screws& screws) const;
  [[nodiscard]] Vector3 angular_drift(const Screws& screws) const;

 private:
  struct Inertia {
    double mass = 0.0;                 // [kg]
    Vector3 moment = Vector3::Zero();  // [kg m] h
    Matrix3 second = Matrix3::Zero();  // [kg m^2] I
  };
  struct Rate {
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();  // F [N], N [N m]
  };
  [[nodiscard]] bool contains(int body) const;
  [[nodiscard]] Inertia& own(int bone) { return own_[static_cast<std::size_t>(bone + 1)]; }
  [[nodiscard]] const Inertia& own(int bone) const {
    return own_[static_cast<std::size_t>(bone + 1)];
  }
  [[nodiscard]] Inertia& below(int bone) { return below_[static_cast<std::size_t>(bone + 1)]; }
  [[nodiscard]] const Inertia& below(int bone) const {
    return below_[static_cast<std::size_t>(bone + 1)];
  }
  // reckoned once
  [[nodiscard]] const Rate& rate(const Screws& screws) const;

  const mjModel_* model_;
  int root_;
  // by bone, that of the world first: in the bone, I about its own centre of mass; in W about o; with
  // all below
  std::vector<Inertia> noted_, own_, below_;
  Vector3 com_ = Vector3::Zero(), arm_ = Vector3::Zero();  // c in W, and from o
  mutable std::optional<Rate> rate_;                       // none: nobody has asked
};

}  // namespace hurcules

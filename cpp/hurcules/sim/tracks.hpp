// Tracks: rigid geoms whose surface moves with a belt, and one physics step that gives them
// traction.
//
// A track is a tuple `track_NAME` (any prefix before it) of a belt hinge and then the geoms that
// the belt runs around. Between mj_step1 and mj_step2 each contact row of such a geom
//   - gets the belt's surface velocity as a column of its own, so that traction loads the drive
//   with no lag;
//   - is kept from hopping: MuJoCo's friction cone pushes a sliding contact apart by mu |tangential
//   reference|, which is
//     taken off the normal reference (de Saxce), after the tangential one was capped;
//   - counts for nothing where a box, a straight run with x along the belt, is touched on its front
//   or rear face: the cylinder there stands before it, and an edge of the ground would hook.
// Measured against Coulomb's law to 2 % (mujoco-facts.md §4).
#pragma once

#include <vector>

struct mjModel_;
struct mjData_;

namespace hurcules {

class Tracks {
 public:
  // throws Error when a tuple is no track, or when the model has tracks but not the dense Jacobian
  // and the elliptic cones that they want
  explicit Tracks(const mjModel_* model);
  // between mj_step1 and mj_step2
  void add_belts(const mjModel_* model, mjData_* data) const;

  [[nodiscard]] bool empty() const { return belts_.empty(); }
  // joint ids of the belts, a track each
  [[nodiscard]] const std::vector<int>& belts() const { return belts_; }

 private:
  std::vector<int> belts_;
  std::vector<int> belt_dof_;  // a geom: velocity index of its belt, -1 for none
};

// mj_step with the tracks' traction
void step(const mjModel_* model, mjData_* data, const Tracks& tracks);

}  // namespace hurcules

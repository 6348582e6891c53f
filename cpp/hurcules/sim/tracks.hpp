// Tracks: rigid geoms whose surface moves with a belt, and the traction that it gives.
//
// A track is a tuple `track_NAME` (any prefix before it) of a belt hinge and then the geoms that
// the belt runs around. Between mj_step1 and mj_step2 each contact row of such a geom
//   - gets the belt's surface velocity as a column of its own, so that traction loads the drive
//     with no lag;
//   - is kept from hopping: MuJoCo's friction cone pushes a sliding contact apart by
//     mu |tangential reference|, which is taken off the normal reference (de Saxce), after the
//     tangential one was capped;
//   - counts for nothing where a box, a straight run with x along the belt, is touched on its front
//     or rear face: the cylinder there stands before it, and an edge of the ground would hook.
// Measured against Coulomb's law to 2 % (docs/design/mujoco.md#track-measurements).
#pragma once

#include <string>
#include <vector>

struct mjModel_;
struct mjData_;

namespace hurcules {

// What a track does on the ground, over its contact points; forward is what the belt drives to.
struct TrackReading {
  double load = 0.0;      // [N] of normal force
  double traction = 0.0;  // [N] forward, on the robot
  double slip = 0.0;      // [m/s] belt faster than ground, mean by load; 0 off the ground
  double speed = 0.0;     // [m/s] of the belt's surface, mean by load; 0 off the ground
};

class Tracks {
 public:
  // throws Error when a tuple is no track, or when the model has tracks but not the elliptic cones
  // that they want
  explicit Tracks(const mjModel_* model);
  // between mj_step1 and mj_step2
  void add_belts(const mjModel_* model, mjData_* data) const;

  [[nodiscard]] bool empty() const { return belts_.empty(); }
  // joint ids of the belts, a track each
  [[nodiscard]] const std::vector<int>& belts() const { return belts_; }
  // throws Error with the names that exist; without prefix and `track_`
  [[nodiscard]] std::size_t find(const std::string& name) const;
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  // after a step, of that step
  [[nodiscard]] TrackReading read(const mjModel_* model, const mjData_* data,
                                  std::size_t track) const;

 private:
  // places for the belts in the rows of a sparse Jacobian
  void make_room(mjData_* data) const;
  [[nodiscard]] int track_of(int geom) const {
    return geom < 0 ? -1 : track_of_geom_[static_cast<std::size_t>(geom)];
  }
  [[nodiscard]] int dof_of(int geom) const {  // of the belt around it, -1 for none
    const int track = track_of(geom);
    return track < 0 ? -1 : dof_[static_cast<std::size_t>(track)];
  }

  std::vector<std::string> names_;
  std::vector<int> belts_;
  std::vector<int> track_of_geom_;  // -1 for none
  std::vector<int> dof_;            // of the belts
};

}  // namespace hurcules

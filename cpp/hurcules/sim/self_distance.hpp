// How near the robot comes to itself: the smallest distance of chosen pairs of its contact shapes.
//
// Chosen are the pairs that the physics would let collide, with at least `joints` turning joints between
// them; those with no more than that only if they lie apart by `near` in the model's initial
// posture. What has fewer joints between it is kept apart by joint ranges; what lies near by
// construction (an upper arm beside the torso) would hide all else. Boxes around the shapes rule
// out most pairs (separating axes: their gap is never more than the distance); the rest are
// measured exactly.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

struct SelfDistanceOptions {
  int joints = 3;        // hinges that no spring holds
  double near = 0.05;    // [m]
  double cutoff = 0.25;  // [m] what is further apart counts as this
};

class SelfDistance {
 public:
  // throws Error for options out of range
  SelfDistance(const mjModel_* model, const std::vector<int>& robot_roots,
               const SelfDistanceOptions& options = {});
  // after a step: of the posture at its beginning. [m], negative where shapes meet
  double measure(const mjModel_* model, mjData_* data);

  [[nodiscard]] Index pairs() const { return static_cast<Index>(pairs_.size()); }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> names(const mjModel_* m) const;
  // of the pairs, the nearest one when measured last; -1: all further than the cutoff
  [[nodiscard]] Index nearest() const { return nearest_; }
  void reset() { nearest_ = -1; }
  void save(StateWriter& writer) const { writer.put(static_cast<double>(nearest_)); }
  void restore(StateReader& reader);

 private:
  struct Pair {
    int first = 0, second = 0;  // geoms
  };
  SelfDistanceOptions options_;
  std::vector<Pair> pairs_;
  Index nearest_ = -1;  // it is looked at first: the others then need not be measured
};

}  // namespace hurcules

// What a robot stands on: its contacts that press, of the robot with what does not move, and of its
// tracks with anything.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hurcules/sim/stability.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

class Support {
 public:
  Support(const mjModel_* model, int robot_root);
  // After a step; nothing in the air and without gravity. `carried`: bodies at the roots of other
  // trees; each counts to the robot's mass while it does not touch the ground.
  [[nodiscard]] std::optional<Stability> measure(const mjModel_* model, const mjData_* data,
                                                 std::span<const int> carried = {});
  // measured last
  [[nodiscard]] Index points() const { return static_cast<Index>(polygon_.size()); }

 private:
  void collect(const mjModel_* model, const mjData_* data);

  int root_;
  SupportPolygon polygon_;
  std::vector<bool> is_track_;  // (ngeom)
};

// [m] of a robot after a step, -inf in the air. `root`: the body at its root, `carried`: those of
// loads. Throws Error for names that the model lacks.
[[nodiscard]] double static_margin(const mjModel_* model, const mjData_* data,
                                   const std::string& root,
                                   const std::vector<std::string>& carried = {});

}  // namespace hurcules

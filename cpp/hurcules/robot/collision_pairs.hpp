// Which geoms of a robot can come near each other, or near what stands around it.
//
// Of two geoms that may touch (contype, conaffinity, <pair>, <exclude> of the model) these are left
// out:
//   - what the coordinates do not move against each other, and neighbours in the robot's tree;
//   - what is in contact in the robot's present configuration, or in nearly every sampled posture;
//   - what never comes near in sampled postures.
// Bodies that are named as obstacles may move: of those, only what no coordinate moves is left out.
// A robot on slides of 2 m or more, or on driven wheels, may go anywhere along them: of what stands
// still there, only what it touches now is left out.
// Postures are drawn evenly between the limits of the coordinates (a turn or a metre to either side
// where there is none); the same seed draws the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hurcules/robot/geom_distance.hpp"

namespace hurcules {

struct CollisionSampling {
  double near = 0.3;   // [m] nearer than that in no posture: left out
  int postures = 200;  // > 0
  std::uint32_t seed = 0;
};

struct CollisionPair {
  GeomPair geoms;
  double distance = 0.0;  // [m] in the robot's present configuration; `near` where farther
};

// pairs of geoms of the trees that the coordinates move
[[nodiscard]] std::vector<CollisionPair> self_pairs(const Robot& robot,
                                                    const CollisionSampling& sampling = {});
// Pairs of these with what stands still around them (floor, walls, fixed bodies), and with the bodies
// of these names. Throws Error for a name that is no body, or a body of the robot's own trees.
[[nodiscard]] std::vector<CollisionPair> obstacle_pairs(const Robot& robot,
                                                        const std::vector<std::string>& bodies = {},
                                                        const CollisionSampling& sampling = {});

}  // namespace hurcules

// The controllers of the missions that are tables, by name: stacks and channels that their phases
// command, and where the robot starts.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/control/whole_body_controller.hpp"

namespace hurcules {

// For this scene, standing at the start.
//
// "lift" (lift and casualty): stacks `arms`, `press` (force control downwards) and `posture`.
// "disposal": stacks `hands` (place and direction of both, then pelvis, then posture) and `posture`;
// `left_grip` and `right_grip` move the fingers.
// Both: a channel a task, `drive` for the tracks, `joints` for all joints but belts and fingers, one
// by one. `method`: how the hierarchy is solved, one of method_names(). Throws Error for another name
// or method, or a scene without the robot.
[[nodiscard]] std::shared_ptr<WholeBodyController> table_controller(const std::string& name,
                                                                    const ModelPtr& model,
                                                                    const std::string& method);
// what else differs from the keyframe "stretch" where a lift starts: angles [rad] by coordinate,
// "KN" the one of this name or both sides
[[nodiscard]] const std::vector<std::pair<std::string, double>>& lift_start();

}  // namespace hurcules

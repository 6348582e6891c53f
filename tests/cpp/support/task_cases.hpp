// Every task of the house on a tiny robot, for the suite that is stamped over all of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hurcules/tasks/angle_task.hpp"
#include "hurcules/tasks/center_of_mass_task.hpp"
#include "hurcules/tasks/gaze_task.hpp"
#include "hurcules/tasks/manipulability_task.hpp"
#include "hurcules/tasks/orientation_task.hpp"
#include "hurcules/tasks/pose_task.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "hurcules/tasks/posture_task.hpp"
#include "hurcules/tasks/swivel_task.hpp"
#include "support/tiny_models.hpp"

namespace hurcules_test {

using TaskPtr = std::unique_ptr<hurcules::Task>;

struct TaskCase {
  std::string name;
  const char* model;
  std::function<TaskPtr(const hurcules::Robot&)> make;
};

template <typename T, typename... Arguments>
TaskCase task_case(const std::string& name, const char* model, Arguments... arguments) {
  return {name, model, [=](const hurcules::Robot& robot) -> TaskPtr {
            return std::make_unique<T>(name, robot, arguments...);
          }};
}

inline std::vector<TaskCase> arm_cases() {
  using namespace hurcules;
  const Matrix two = (Matrix(2, 3) << 1, 0, 0, 0, 0.6, 0.8).finished();
  const SwivelTaskOptions swivel{"shoulder", "elbow", "tip", "world", {0.2, 0.3, -1}};
  return {
      task_case<PostureTask>("arm_posture", kArm),
      task_case<PositionTask>("arm_position", kArm, std::string("tip")),
      task_case<PositionTask>("arm_two_directions", kArm, std::string("forearm"),
                              PositionTaskOptions{.axes = two}),
      task_case<OrientationTask>("arm_orientation", kArm, std::string("tip")),
      task_case<PoseTask>("arm_pose_orientation", kArm, std::string("tip")),
      task_case<AngleTask>("arm_elevation", kArm, std::string("hand")),
      task_case<AngleTask>("arm_heading", kArm, std::string("elbow"),
                           AngleTaskOptions{AngleKind::Heading, {1, 1, 0}, ""}),
      task_case<SwivelTask>("arm_swivel", kArm, swivel),
      task_case<GazeTask>("arm_gaze", kArm, std::string("eye")),
      task_case<CenterOfMassTask>("arm_com", kArm),
      task_case<ManipulabilityTask>("arm_manipulability", kArm, std::string("tip")),
      task_case<ManipulabilityTask>("arm_manipulability_of_two_directions", kArm,
                                    std::string("forearm"), ManipulabilityTaskOptions{.axes = two}),
      task_case<ManipulabilityTask>("arm_manipulability_with_turns", kArm, std::string("tip"),
                                    ManipulabilityTaskOptions{.turns = true}),
  };
}

inline std::vector<TaskCase> twin_cases() {
  using namespace hurcules;
  const Matrix one = (Matrix(1, 3) << 1, 0, 0).finished();
  const SwivelTaskOptions left{"sh_l", "fa_l", "hand_l", "chest"};
  const SwivelTaskOptions leg{"toe_r", "fa_r", "hand_l", "head", {1, 1, 0}};
  return {
      task_case<PostureTask>("twin_posture", kTwin, std::vector<std::string>{"WST", "KN"}),
      task_case<PositionTask>("twin_position", kTwin, std::string("hand_l")),
      task_case<PositionTask>("twin_toe_of_a_coupled_leg", kTwin, std::string("toe_r")),
      task_case<PositionTask>("twin_hand_to_hand", kTwin, std::string("hand_l"),
                              PositionTaskOptions{.reference = "hand_r"}),
      task_case<PositionTask>("twin_pelvis", kTwin, std::string("trunk"),
                              PositionTaskOptions{"toe_l", one}),
      task_case<OrientationTask>("twin_orientation", kTwin, std::string("hand_r")),
      task_case<OrientationTask>("twin_hand_in_hand", kTwin, std::string("hand_l"),
                                 OrientationTaskOptions{"hand_r"}),
      task_case<PoseTask>("twin_pose_orientation", kTwin, std::string("hand_r"),
                          PoseTaskOptions{"base_site"}),
      task_case<RelativePoseTask>("twin_pose_hand_in_hand", kTwin, std::string("hand_l"),
                                  std::string("hand_r")),
      task_case<AngleTask>("twin_elevation", kTwin, std::string("fa_l"),
                           AngleTaskOptions{AngleKind::Elevation, {0, 0.1, -1}, ""}),
      task_case<AngleTask>("twin_heading_in_base", kTwin, std::string("chest"),
                           AngleTaskOptions{AngleKind::Heading, {1, 0, 0}, "base_site"}),
      task_case<AngleTask>("twin_elevation_in_chest", kTwin, std::string("hand_r"),
                           AngleTaskOptions{AngleKind::Elevation, {1, 0, 0}, "chest"}),
      task_case<SwivelTask>("twin_swivel", kTwin, left),
      task_case<SwivelTask>("twin_swivel_of_moving_points", kTwin, leg),
      task_case<GazeTask>("twin_gaze", kTwin, std::string("eye")),
      task_case<GazeTask>("twin_gaze_of_a_site", kTwin, std::string("gaze")),
      task_case<CenterOfMassTask>("twin_com", kTwin),
      task_case<ManipulabilityTask>("twin_manipulability", kTwin, std::string("hand_l")),
      task_case<CenterOfMassTask>("twin_com_in_base", kTwin,
                                  CenterOfMassTaskOptions{.reference = "base"}),
  };
}

inline std::vector<TaskCase> ball_cases() {
  using namespace hurcules;
  return {
      task_case<PostureTask>("ball_posture", kBallArm),
      task_case<PostureTask>("ball_posture_of_parts", kBallArm,
                             std::vector<std::string>{"wrist_rz", "shoulder_rx", "elbow"}),
      task_case<PositionTask>("ball_position", kBallArm, std::string("tip")),
      task_case<PoseTask>("ball_pose_orientation", kBallArm, std::string("tip")),
      task_case<CenterOfMassTask>("ball_com", kBallArm),
      task_case<ManipulabilityTask>("ball_manipulability", kBallArm, std::string("tip")),
  };
}

inline std::vector<TaskCase> all_cases() {
  std::vector<TaskCase> cases = arm_cases();
  for (TaskCase& more : twin_cases()) cases.push_back(std::move(more));
  for (TaskCase& more : ball_cases()) cases.push_back(std::move(more));
  return cases;
}

// prints a case by its name
inline void PrintTo(const TaskCase& task, std::ostream* out) {
  *out << task.name;
}

}  // namespace hurcules_test

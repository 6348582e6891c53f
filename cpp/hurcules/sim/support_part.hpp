// What a robot is said to stand on: a body, and all of the robot that no coordinate moves against it
// (tracks and wheels on their springs, what is welded).
#pragma once

#include <string>
#include <vector>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

class SupportPart {
 public:
  // throws Error for what is no body of the model
  SupportPart(const Robot& robot, const std::string& body);
  [[nodiscard]] bool has(int body) const { return own_[static_cast<std::size_t>(body)]; }
  // after a step: something that is not of the robot presses on it
  [[nodiscard]] bool bears(const mjModel_* model, const mjData_* data) const;

 private:
  int root_;
  std::vector<bool> own_;  // (nbody)
};

// Whether a body can bear a robot on level ground, as it stands.
struct SupportFit {
  static constexpr double kMost = 0.05;  // [m] that the soles of a part may differ: steps, springs
  double height = 0.0;  // [m] the lowest point of its part above the ground, inf: it has no shapes
  std::vector<std::string> lowest;  // bodies whose own lowest points are within kMost of the ground
  [[nodiscard]] bool fits() const { return height <= kMost; }
};
// `robot` stands on the body. The ground is where the lowest point of the part of `before` is, which
// bore it until now, or of all of the robot ("").
// known (n): coordinates whose places are; what others move against the body is passed over.
// Nothing that has shapes is known, not `before` either: it fits.
[[nodiscard]] SupportFit support_fit(const Robot& robot, const std::string& body,
                                     const std::string& before, const std::vector<bool>& known);
// Which way is up where a robot stands: the mean normal of its contacts with what does not move (of
// those within 60 degrees of against gravity), or, without any, against gravity; (3) of length 1, in W.
[[nodiscard]] Vector3 up_of_ground(const mjModel_* model, const mjData_* data, int robot_root);

}  // namespace hurcules

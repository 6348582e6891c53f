// How far a frame is from a singularity: the volume of the velocities that the coordinates give it.
//
//   s = sqrt(det(J J' + delta^2 1)) (1),   J = A J_WF, with turns [A J_WF; J_w,WF]
// the product of the singular values of J, rounded by delta = 1e-3 where one of them is 0: there ds/dq
// fades. ds/dq and the drift are central differences of s, on a robot of its own: four kinematics for
// each coordinate that moves the frame. To stay away from singularities: set_target(s_min) and the
// interval [0, inf].
#pragma once

#include <Eigen/Cholesky>

#include "hurcules/tasks/value_task.hpp"

namespace hurcules {

struct ManipulabilityTaskOptions {
  Matrix axes = Matrix3::Identity();  // A (m, 3), m = 1 to 3: directions in W that count
  bool turns = false;                 // rotations [rad] count beside positions [m]
};

class ManipulabilityTask : public ValueTask {
 public:
  // throws Error for a frame that no coordinate moves
  ManipulabilityTask(std::string name, const Robot& robot, const std::string& frame,
                     ManipulabilityTaskOptions options = {});
  ManipulabilityTask(const ManipulabilityTask& other);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<ManipulabilityTask>(*this);
  }
  [[nodiscard]] std::string unit() const override { return {}; }

 private:
  void measure(const Robot& robot) override;
  [[nodiscard]] double volume(const Robot& robot);  // s; leaves the Jacobians of the frame
  [[nodiscard]] double volume_at(const Vector& q);  // of the probe

  Frame frame_;
  Matrix axes_;
  bool turns_;
  Robot probe_;
  Matrix linear_, angular_, rows_, gram_;  // (3, n), (3, n), (m, n), (m, m)
  Eigen::LLT<Matrix> factor_;
  Vector q_, step_;  // (n)
};

}  // namespace hurcules

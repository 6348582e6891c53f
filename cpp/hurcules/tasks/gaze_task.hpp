// The camera looks at a point of the world.
//
//   c = R_WC^T (p_WT - p_WC): the target T from the camera C; x along the line of sight, z up
//   e = -(atan2(c_y, c_x), atan2(c_z, |(c_x, c_y)|))  [rad] (2): yaw and pitch of the line of sight
//       less those of the direction to the target; zero = looking at it  [T §4.3.2], its g_gaze
//   J = -dangle/dc J_c (2, n)
// For a camera of the model x is its line of sight (MuJoCo's -z), for any other frame its x axis.
// Singular where the target is right above or below the camera: within 1.1 degrees of it J fades;
// e jumps from pi to -pi behind the camera. A target nearer than 1 cm counts as 1 cm away.
#pragma once

#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

class GazeTask : public Task {
 public:
  // the target starts 1 m ahead; throws Error for a frame that does not exist, or that no coordinate
  // moves
  GazeTask(std::string name, const Robot& robot, const std::string& frame);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<GazeTask>(*this);
  }

  void update(const Robot& robot) override;
  // looks ahead at a point 1 m away, whatever it looked at before
  void reset(const Robot& robot) override;
  // the target comes onto the line of sight, as far away as it was
  void hold(const Robot& robot) override;
  // moves the target around the camera of the last update, to the left (yaw) and upward (pitch) as
  // seen from it; [rad/s], (2)
  void advance(const ConstVectorRef& velocity, double dt) override;
  void back_calculate(double share) override;
  [[nodiscard]] ConstVectorRef yielding_target() const override { return target_; }
  // nothing is fed forward: the target is a point, the rows are angles
  void lead_target(const ConstVectorRef& step, double dt) override;
  [[nodiscard]] Index target_size() const override { return 3; }
  void assign_target(const ConstVectorRef& target) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

  [[nodiscard]] const Vector3& target() const { return target_; }  // p_WT [m]
  // at rest; seen at the next update
  void set_target(const Vector3& target);

 private:
  void turn(double by_yaw, double by_pitch);

  Frame frame_;
  Reference camera_;
  PointMotion seen_;                           // the target from the camera
  Vector3 position_ = Vector3::Zero();         // p_WC [m] at the last update
  Matrix3 orientation_ = Matrix3::Identity();  // R_WC at the last update
  Vector3 target_ = Vector3::Zero();
};

}  // namespace hurcules

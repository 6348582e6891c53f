#include "hurcules/sim/obstacle_sight.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "hurcules/base/pose.hpp"

namespace hurcules {

namespace {

constexpr double kMocapTime = 0.02;  // [s] over which the velocity of a mocap body is taken
constexpr double kMocapLeap = 0.1;   // [m] or [rad] in a tick: put there, not moved

int mocap_below(const mjModel& m, int body) {
  while (body > 0 && m.body_mocapid[body] < 0) body = m.body_parentid[body];
  return body > 0 ? body : -1;
}

// a pose, and how fast it came there from where it was last seen
BodyMotion moved_to(const Skeleton::Pose& pose, const std::optional<BodyMotion>& last, double dt) {
  if (!last) return {pose};
  const Vector3 step = pose.p - last->pose.p;
  const Vector3 turn = rotation_log(pose.R * last->pose.R.transpose());
  if (std::max(step.norm(), turn.norm()) > kMocapLeap) return {pose};
  const double share = std::min(1.0, dt / kMocapTime);
  return {pose, last->linear + share * (step / dt - last->linear),
          last->angular + share * (turn / dt - last->angular)};
}

}  // namespace

ObstacleSight::ObstacleSight(const WholeBodyController& controller, const Robot& world) {
  for (Task* const task : controller.tasks()) {
    auto* const apart = dynamic_cast<DistanceTask*>(task);
    if (!apart) continue;
    for (const int body : apart->loose_bodies(world))
      obstacles_.push_back({apart, body, mocap_below(*world.model(), body)});
  }
}

void ObstacleSight::tell(const Robot& world, const Plant& plant, const Vector& qvel,
                         double dt) const {
  const mjModel& m = *plant.model();
  for (const Obstacle& obstacle : obstacles_) {
    DistanceTask& task = *obstacle.task;
    if (!task.sees_obstacles()) continue;
    const Frame frame{mjOBJ_BODY, obstacle.body};
    if (obstacle.mocap < 0) {
      const Twist twist = world.twist(frame, qvel);
      task.see_obstacle(obstacle.body, {world.pose(frame), twist.linear, twist.angular});
      continue;
    }
    const int id = m.body_mocapid[obstacle.mocap];
    const double* const p = plant.data()->mocap_pos + 3 * id;
    const double* const q = plant.data()->mocap_quat + 4 * id;
    const Skeleton::Pose mocap{{p[0], p[1], p[2]},
                               Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().matrix()};
    const Skeleton::Pose pose =
        mocap * Skeleton::between(m, obstacle.mocap, obstacle.body, plant.qpos().data());
    task.see_obstacle(obstacle.body, moved_to(pose, task.obstacle(obstacle.body), dt));
  }
}

}  // namespace hurcules

// What the force tasks of a controller read, tick by tick: the deflection of a spring, or sensors of
// the model.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hurcules/robot/spring_force.hpp"
#include "hurcules/tasks/force_task.hpp"

namespace hurcules {

class ForceReadings {
 public:
  void add(ForceTask& task, std::unique_ptr<SpringForce> spring);
  // `sign` times that row is the force that the robot exerts along the task's axis; with a site: the
  // part along the axis of three rows in the axes of the site, however both are turned. The task is
  // told through a low-pass of 3 ms. Throws Error for a sign of 0 or one that is not finite.
  void add(ForceTask& task, int sensor_row, double sign, std::optional<Frame> site = {});
  // the same for other tasks, those of a copied controller
  [[nodiscard]] ForceReadings of(const std::function<ForceTask*(ForceTask&)>& task) const;

  // Each task is told what it reads: qpos (nq), qvel (nv) as sensed, sensors (nsensordata) or null
  // for 0 N. `robot`: where the controller will see it.
  void tell(const Robot& robot, const Vector& qpos, const Vector& qvel,
            const double* sensors) const;
  [[nodiscard]] bool want_sensors() const;
  [[nodiscard]] bool feed(const ForceTask& task) const;

 private:
  struct Reading {
    ForceTask* task = nullptr;
    std::shared_ptr<SpringForce> spring;  // else
    int row = -1;
    double sign = 1.0;
    std::optional<Frame> site;
  };
  [[nodiscard]] static double of_spring(const Reading& reading, const Vector& qpos,
                                        const Vector& qvel);
  [[nodiscard]] static double of_sensors(const Reading& reading, const Robot& robot,
                                         const double* sensors);

  std::vector<Reading> readings_;
};

}  // namespace hurcules

// Bodies keep away from each other: an inequality a pair.
//
//   e_i = distance of pair i [m] (k),  J = its gradient (k, n);   margin <= e_i
// Farther than `most` a pair asks for nothing. Where the nearest geoms of two bodies change, J
// jumps; its own change with the velocity (drift) is left out.
#pragma once

#include "hurcules/robot/geom_distance.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

struct DistanceTaskOptions {
  std::vector<std::pair<std::string, std::string>> pairs;  // names of bodies or geoms
  double margin = 0.03;                                    // [m]
  double most = 0.3;                                       // [m] > margin
};

class DistanceTask : public Task {
 public:
  DistanceTask(std::string name, const Robot& robot, const DistanceTaskOptions& options);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<DistanceTask>(*this);
  }

  void update(const Robot& robot) override;
  // there is no target: hold and advance change nothing
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override { Task::save(writer); }
  void restore(StateReader& reader) override { Task::restore(reader); }
  [[nodiscard]] bool rows_apart() const override { return true; }

 private:
  GeomDistance distances_;
};

}  // namespace hurcules

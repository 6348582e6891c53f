// Targets that give way while the motors hold the robot back, and come back afterwards.
//
// While the motion slows down every target follows the robot as fast as the law would have led the
// robot to it (back-calculation, as of an integrator that saturates). A target that rested then is led
// back once the motion is free again, slowly at first: where the robot is blocked still, it gives way
// again. One that somebody moves meanwhile stays where it was moved.
#pragma once

#include <vector>

#include "hurcules/tasks/task.hpp"

namespace hurcules {

class YieldingTargets {
 public:
  YieldingTargets() = default;
  explicit YieldingTargets(const std::vector<Task*>& tasks);

  // every target is where it is wanted
  void forget();
  // One tick of dt [s]. `slowed`: the motion was slowed down in it; `rate` [1/s]: of the law.
  void update(bool slowed, double rate, double dt);
  // [unit] how far a target is from where it rested, 0 where it did not give way
  [[nodiscard]] double given_way(const Task& task) const;
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Yielded {
    Task* task;
    bool on = false;
    Vector wanted;  // where it rested
    Vector left;    // where it was left: elsewhere, somebody has moved it
    Vector step;    // scratch

    void give_way(double share, double dt);
    void lead_back(double free, double dt);
    void stop(double dt);
  };

  std::vector<Yielded> yielded_;
  double free_ = 0.0;  // [s] since the motion was slowed down last
};

}  // namespace hurcules

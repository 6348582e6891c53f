// What the tasks of a stack measure while the robot moves, measured by copies: those of the
// controller notice nothing.
//
// Moved at qdot = u, of length 1, the rows of a task change by dJ/dt u, its drift: what J u grows by
// with each rad along u. The dead zone asks for it to tell a saddle from the end of a level's reach.
#pragma once

#include <memory>
#include <vector>

#include "hurcules/control/stack.hpp"
#include "hurcules/robot/robot.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules {

class SaddleProbe {
 public:
  explicit SaddleProbe(const Robot& robot);
  // makes the memory
  void set_stack(const Stack& stack);
  // what the next questions are about; both must live until then
  void look_at(const Robot& robot, const Stack& stack);
  // the coordinates move along u (n): measures the first `levels`; false where u is no numbers
  bool move(const Vector& u, std::size_t levels);
  // (rows) of one of these levels, weighted [unit/rad^2]; 0 where they are limits
  [[nodiscard]] const Vector& drift(std::size_t level) const { return drifts_[level]; }

 private:
  Robot robot_;
  std::vector<std::vector<std::unique_ptr<Task>>> tasks_;  // of each level
  std::vector<Vector> drifts_;
  std::vector<double> scratch_;
  const Robot* looked_at_ = nullptr;
  const Stack* stack_ = nullptr;
  bool stands_there_ = false;
};

}  // namespace hurcules

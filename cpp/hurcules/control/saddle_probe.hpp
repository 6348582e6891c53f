// Whether a level that hardly pulls any more stands at a saddle or at the end of its reach.
//
// Moved by h along u (n, of length 1), a level with the rows A and the rates y = -k e pulls along u
// with  u'A'y; what that grows by with each rad is
//   y'(dA/dh)u - k |A u|^2,     (dA/dh)u = dJ/dt qdot at qdot = u: the drift of its tasks
// More than nothing: the way along u becomes better the further it goes, as from a straight arm
// whose target lies inside its reach. Less: it stands where it can do no better.
// Tasks and robot are measured as copies: those of the controller notice nothing.
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
  // what the pull of a level's equality rows along u grows by [unit^2/s per rad^2]; gain: k [1/s]
  [[nodiscard]] double growth(std::size_t k, const Level& level, const Vector& u, double gain);

 private:
  Robot robot_;
  std::vector<std::vector<std::unique_ptr<Task>>> tasks_;  // of each level
  std::vector<double> scratch_;
  const Robot* looked_at_ = nullptr;
  const Stack* stack_ = nullptr;
  bool stands_there_ = false;
};

}  // namespace hurcules

// Judges a step of episodes side by side, by what was read of their simulations and what their task
// says: reward, cost, how it ended, and the numbers that are told of these.
//
// The cost is 1 where the robot touches itself; is beyond the limit of a joint's place by more than
// 5 mrad (of slides 5 mm) at the end of the step, or within it further than ever; or where the task
// says so.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

struct Claims {                       // of a task, (n) each
  std::vector<ConstVectorRef> terms;  // of the reward
  FlagsRef failed;
  FlagsRef ended;  // by success
  FlagsRef costly;
};

struct Verdict {  // (n) each
  Vector reward;
  Flags failed, terminated;
  Eigen::Array<std::int64_t, Eigen::Dynamic, 1> ending;  // an Ending
  Matrix told;  // (r, n): the terms, then by the names of judged()
  bool finite;  // the rewards
};

// what `judge` reads, in this order, and the name by which it tells it: of the ending the cost
[[nodiscard]] const std::vector<std::pair<std::string, std::string>>& judged();

// values: (n, m), judged() its last columns; worst: (n) the worst excess [rad] of each at its last
// step, 0 for an episode that begins, updated. Throws Error for arrays of another size.
[[nodiscard]] Verdict judge(const ConstMatrixRef& values, const Claims& claims, VectorRef worst);

}  // namespace hurcules

// How far a target may be led from the value that a task measures.
#pragma once

#include <algorithm>
#include <limits>
#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/base/types.hpp"

namespace hurcules {

// From a fifth of the lead on the target goes slower, so that a robot at the end of its reach stops;
// a velocity that leads back is never held.
class MaxLead {
 public:
  // throws Error unless it is > 0; inf: anywhere
  void set(double most, const std::string& task) {
    require(most > 0.0, "max_lead of '" + task + "' wants a positive distance, inf for none");
    most_ = most;
  }
  [[nodiscard]] double value() const { return most_; }
  // of a velocity of the target at this error, value - target: 0 to 1
  [[nodiscard]] double share(const ConstVectorRef& error, const ConstVectorRef& velocity) const {
    const double slack = 1.25 * (1.0 - error.norm() / most_);
    const bool leads = error.dot(velocity) < 0.0;  // away from the value
    return leads && slack < 1.0 ? std::max(0.0, slack) : 1.0;
  }

 private:
  double most_ = std::numeric_limits<double>::infinity();
};

}  // namespace hurcules

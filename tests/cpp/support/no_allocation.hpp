// Counts every allocation of a scope, in all threads: of ours, Eigen's, MuJoCo's and the standard
// library's.
#pragma once

#include <cstddef>

namespace hurcules_test {

// all that this process has made so far
std::size_t allocations();

class NoAllocation {
 public:
  NoAllocation() = default;
  NoAllocation(const NoAllocation&) = delete;
  NoAllocation& operator=(const NoAllocation&) = delete;

  [[nodiscard]] std::size_t count() const { return allocations() - before_; }

 private:
  std::size_t before_ = allocations();
};

}  // namespace hurcules_test

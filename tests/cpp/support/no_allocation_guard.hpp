// Counts every allocation of a scope: operator new, MuJoCo's own, and Eigen's (which end the test).
//
// One file of each test program includes no_allocation.hpp, which replaces operator new.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <cstdlib>
#include <new>

namespace hurcules_test {

inline std::size_t& allocations() {
  static std::size_t count = 0;
  return count;
}

class NoAllocation {
 public:
  NoAllocation() : before_(allocations()) {
    mju_user_malloc = [](std::size_t size) -> void* {
      ++allocations();
      return std::aligned_alloc(64, (size + 63) / 64 * 64);
    };
    Eigen::internal::set_is_malloc_allowed(false);
  }
  ~NoAllocation() {
    Eigen::internal::set_is_malloc_allowed(true);
    mju_user_malloc = nullptr;
  }
  NoAllocation(const NoAllocation&) = delete;
  NoAllocation& operator=(const NoAllocation&) = delete;

  [[nodiscard]] std::size_t count() const { return allocations() - before_; }

 private:
  std::size_t before_;
};

}  // namespace hurcules_test

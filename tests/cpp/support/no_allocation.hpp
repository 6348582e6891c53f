// Counts every allocation of a scope: operator new, MuJoCo's own, and Eigen's (which end the test).
//
// It replaces operator new, so one file of each test program includes it.
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

// not inlined: the compiler would see malloc and delete as a mismatched pair
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++hurcules_test::allocations();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

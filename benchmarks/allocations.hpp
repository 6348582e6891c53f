// Counts every allocation of a program, whoever makes it, by standing in front of the C library's.
// One file of the program includes it. Under a sanitizer, which stands there itself, nothing
// counts.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdlib>

namespace hurcules_benchmark {

inline std::size_t& allocations() {
  static std::size_t count = 0;
  return count;
}

}  // namespace hurcules_benchmark

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) noexcept {
  ++hurcules_benchmark::allocations();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++hurcules_benchmark::allocations();
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  ++hurcules_benchmark::allocations();
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++hurcules_benchmark::allocations();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  ++hurcules_benchmark::allocations();
  *memory = __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}
}
#endif

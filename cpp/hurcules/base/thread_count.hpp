// How many threads share jobs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <thread>

#include "hurcules/base/error.hpp"

namespace hurcules {

// wanted: 0 for one a processor; no more than there are jobs. Throws Error for less than 0.
[[nodiscard]] inline std::size_t thread_count(int wanted, std::size_t jobs) {
  require(wanted >= 0,
          "threads must be positive, or 0 for one a processor, got " + std::to_string(wanted));
  const std::size_t count = wanted > 0 ? static_cast<std::size_t>(wanted)
                                       : std::max(1u, std::thread::hardware_concurrency());
  return std::min(count, jobs);
}

}  // namespace hurcules

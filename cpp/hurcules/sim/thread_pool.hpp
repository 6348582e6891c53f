// Threads that wait for jobs; the caller's is one of them.
//
// A forked child has none of its parent's threads: the first job there starts them anew.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <memory>

namespace hurcules {

class ThreadPool {
 public:
  // threads >= 1, the caller's among them
  explicit ThreadPool(std::size_t threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] std::size_t threads() const { return threads_; }
  // job(i) for each i < n, once each, in any order; throws what the first failing one threw
  void run(std::size_t n, const std::function<void(std::size_t)>& job);

 private:
  class Workers;

  std::size_t threads_;
  std::unique_ptr<Workers> workers_;
  pid_t process_;  // that the workers live in
};

}  // namespace hurcules

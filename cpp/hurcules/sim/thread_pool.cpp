#include "hurcules/sim/thread_pool.hpp"

#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace hurcules {

class ThreadPool::Workers {
 public:
  explicit Workers(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) threads_.emplace_back([this] { wait_for_jobs(); });
  }
  ~Workers() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void run(std::size_t n, const std::function<void(std::size_t)>& job) {
    {
      const std::lock_guard lock(mutex_);
      job_ = &job;
      n_ = n;
      next_ = 0;
      thrown_ = nullptr;
      busy_ = threads_.size();
      ++round_;
    }
    wake_.notify_all();
    take_jobs();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  // one after the other, until none is left
  void take_jobs() {
    for (std::size_t i = next_++; i < n_; i = next_++) {
      try {
        (*job_)(i);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!thrown_) thrown_ = std::current_exception();
      }
    }
  }
  void wait_for_jobs() {
    std::size_t round = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return ends_ || round_ != round; });
        if (ends_) return;
        round = round_;
      }
      take_jobs();
      {
        const std::lock_guard lock(mutex_);
        --busy_;
      }
      done_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const std::function<void(std::size_t)>* job_ = nullptr;
  std::size_t n_ = 0, round_ = 0, busy_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::exception_ptr thrown_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

ThreadPool::ThreadPool(std::size_t threads)
    : threads_(threads), workers_(std::make_unique<Workers>(threads - 1)), process_(getpid()) {}

// what waits for threads that a child never had would wait for ever: it is left
ThreadPool::~ThreadPool() {
  if (process_ != getpid()) static_cast<void>(workers_.release());
}

void ThreadPool::run(std::size_t n, const std::function<void(std::size_t)>& job) {
  if (process_ != getpid()) {
    static_cast<void>(workers_.release());
    workers_ = std::make_unique<Workers>(threads_ - 1);
    process_ = getpid();
  }
  workers_->run(n, job);
}

}  // namespace hurcules

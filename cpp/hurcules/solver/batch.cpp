#include "hurcules/solver/batch.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "hurcules/base/error.hpp"
#include "hurcules/base/thread_count.hpp"

namespace hurcules {

namespace {

// the problems, given out one by one
class Queue {
 public:
  Queue(std::span<const BatchProblem> problems, const SolverOptions& options, const BatchDone& done)
      : problems_(problems), options_(options), done_(done) {}

  // until nothing is left or something was thrown
  void work() {
    try {
      std::optional<Solver> solver;
      for (std::size_t i = next_++; i < problems_.size(); i = next_++) {
        make_cold(solver, i);
        static_cast<void>(solver->solve_views(problems_[i].levels));
        done_(i, *solver);
      }
    } catch (...) {
      next_ = problems_.size();
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void make_cold(std::optional<Solver>& solver, std::size_t i) const {
    const Index unknowns = problems_[i].unknowns;
    if (solver && solver->unknowns() == unknowns) {
      solver->reset();
      return;
    }
    try {
      solver.emplace(unknowns, options_);
    } catch (const Error& error) {
      throw Error("problem " + std::to_string(i) + ": " + error.what());
    }
  }

  std::span<const BatchProblem> problems_;
  const SolverOptions& options_;
  const BatchDone& done_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr thrown_;
};

}  // namespace

void solve_batch(std::span<const BatchProblem> problems, const BatchOptions& options,
                 const BatchDone& done) {
  const std::size_t threads = thread_count(options.threads, problems.size());
  static_cast<void>(Solver(1, options.solver));  // throws on wrong options
  Queue queue(problems, options.solver, done);
  {
    // the caller's thread is one of them
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < threads; ++i) others.emplace_back([&queue] { queue.work(); });
    queue.work();
  }
  queue.rethrow();
}

std::vector<Solution> solve_batch(std::span<const BatchProblem> problems,
                                  const BatchOptions& options) {
  std::vector<Solution> solutions(problems.size());
  solve_batch(problems, options, [&solutions](std::size_t i, const Solver& solver) {
    solutions[i] = solver.solution();
  });
  return solutions;
}

}  // namespace hurcules

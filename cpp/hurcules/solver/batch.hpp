// Many independent hierarchies on threads. Each is solved cold, so the answers have the bits that a
// new solver gives, whatever the number of threads.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "hurcules/solver/solver.hpp"

namespace hurcules {

// one hierarchy; its numbers must stay where they are until the batch is done
struct BatchProblem {
  Index unknowns = 0;
  HierarchyView levels;
};

struct BatchOptions {
  SolverOptions solver = {};
  int threads = 0;  // 0: one a processor
};

// called once a problem, on the thread that solved it
using BatchDone = std::function<void(std::size_t problem, const Solver& solver)>;

// Throws Error on options or unknowns that no solver takes, and what `done` throws; bad numbers are
// a status.
void solve_batch(std::span<const BatchProblem> problems, const BatchOptions& options,
                 const BatchDone& done);
[[nodiscard]] std::vector<Solution> solve_batch(std::span<const BatchProblem> problems,
                                                const BatchOptions& options = {});

}  // namespace hurcules

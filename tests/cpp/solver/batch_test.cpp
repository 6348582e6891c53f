// Strategy: a batch gives the bits of a loop of new solvers, for any number of threads and for
// problems of several sizes; what goes wrong in a thread comes out on the caller's.
#include "hurcules/solver/batch.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/expect.hpp"
#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using hurcules_test::contains;
using hurcules_test::error_text;
using hurcules_test::RandomHierarchy;

// hierarchies of two sizes, and views of them
struct Problems {
  explicit Problems(int count) {
    for (int i = 0; i < count; ++i) {
      RandomHierarchy random(static_cast<unsigned>(i));
      hierarchies.push_back(random.conflicting(8 + 3 * (i % 2), 0.1));
    }
    for (const Hierarchy& hierarchy : hierarchies) {
      views.emplace_back();
      for (const Level& level : hierarchy) views.back().push_back(view(level));
    }
    for (const auto& levels : views) problems.push_back({levels[0].rows(), levels});
  }

  std::vector<Hierarchy> hierarchies;
  std::vector<std::vector<LevelView>> views;
  std::vector<BatchProblem> problems;
};

TEST(Batch, HasTheBitsOfALoopOfNewSolvers) {
  const Problems set(60);
  for (int threads : {0, 1, 2, 5, 100}) {
    const auto solutions = solve_batch(set.problems, {.solver = {}, .threads = threads});
    ASSERT_EQ(solutions.size(), set.problems.size());
    for (std::size_t i = 0; i < solutions.size(); ++i) {
      Solver solver(set.problems[i].unknowns);
      const Solution& alone = solver.solve(set.hierarchies[i]);
      EXPECT_EQ(solutions[i].x, alone.x) << i;
      EXPECT_EQ(solutions[i].changes, alone.changes) << i;
      EXPECT_EQ(solutions[i].optimality, alone.optimality) << i;
    }
  }
}

TEST(Batch, OfNothingIsNothing) {
  EXPECT_TRUE(solve_batch({}).empty());
}

TEST(Batch, BadNumbersAreAStatusOfTheirProblemAlone) {
  Problems set(6);
  set.hierarchies[3][1].A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const auto solutions = solve_batch(set.problems);
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    EXPECT_EQ(solutions[i].status, i == 3 ? SolverStatus::InvalidInput : SolverStatus::Solved);
  }
}

TEST(Batch, ErrorsOfAThreadComeOut) {
  Problems set(20);
  set.problems[7].unknowns = 0;
  EXPECT_TRUE(contains(error_text([&] { static_cast<void>(solve_batch(set.problems)); }),
                       "problem 7: a solver needs at least one unknown"));
  set.problems.resize(5);
  const BatchOptions magic{.solver = {.method = "magic"}};
  EXPECT_TRUE(contains(error_text([&] { static_cast<void>(solve_batch(set.problems, magic)); }),
                       "'magic' does not exist"));
  const BatchOptions negative{.solver = {}, .threads = -1};
  EXPECT_TRUE(contains(error_text([&] { static_cast<void>(solve_batch(set.problems, negative)); }),
                       "threads must be positive"));
}

}  // namespace
}  // namespace hurcules

// Strategy: levels with rho = 0 that ask for more rows than they have directions, as a posture of a
// whole robot does: under a box, other limits and equality rows, some with inequality rows of their
// own, some with a weak direction. Every answer is proven, right by the judge, and found again from
// its own working set, by each set of kernels. What such a level does to small ones is not tested
// here: the classes of hierarchies have those.
#include <gtest/gtest.h>

#include "hurcules/solver/kernels/kernels.hpp"
#include "hurcules/solver/solver.hpp"
#include "support/answers_by_level.hpp"
#include "support/hierarchy_classes.hpp"
#include "support/no_allocation.hpp"
#include "support/optimality_judge.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

constexpr double kRight = 1e-9;

// more rows than the directions that they span
Level large_level(Draw& draw, Index n) {
  const Index rank = draw.integer(16, n / 2 + 8), rows = rank + draw.integer(1, rank);
  Matrix directions = draw.unit_rows(rank, n);
  if (draw.chance(0.3)) {
    directions.row(1) = directions.row(0) + draw.power(-6.0, -2.0) * directions.row(1);
  }
  Matrix A = Matrix::NullaryExpr(rows, rank, [&] { return draw.normal(); }) * directions;
  A.rowwise().normalize();
  Level level = equality(A, 2.0 * draw.vector(rows), 0.0);
  if (draw.chance(0.5)) return level;
  for (Index i = 0; i < rows; i += 5) level.upper[i] += draw.uniform(0.0, 1.0);
  return level;
}

Hierarchy with_large_level(unsigned long long seed) {
  Draw draw(seed);
  const Index n = draw.integer(24, 44);
  Hierarchy levels = {box(n, draw.uniform(0.2, 2.0))};
  if (draw.chance(0.5)) {
    // few unknowns have limits
    for (Index i = 0; i < n; ++i) {
      if (draw.chance(0.7)) levels[0].lower[i] = -(levels[0].upper[i] = kNoLimit);
    }
  }
  const Index above = draw.integer(0, 8);
  if (above > 0) levels.push_back(equality(draw.unit_rows(above, n), draw.vector(above), 0.0));
  if (draw.chance(0.5)) levels.push_back(mixed_level(draw, n, 0.0));
  levels.push_back(large_level(draw, n));
  if (draw.chance(0.5)) levels.push_back(mixed_level(draw, n, draw.choose({0.0, 0.1})));
  return levels;
}

class SolverLargeLevel : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!kernels::choose(GetParam())) GTEST_SKIP() << "this machine has no " << GetParam();
  }
  void TearDown() override { kernels::choose(before_.c_str()); }

 private:
  std::string before_ = kernels::chosen->name;
};

TEST_P(SolverLargeLevel, IsProvenAndRight) {
  for (unsigned long long seed = 1; seed <= 100; ++seed) {
    const Hierarchy levels = with_large_level(seed);
    Solver solver(unknowns_of(levels));
    const Solution& solution = solver.solve(levels);
    EXPECT_EQ(solution.status, SolverStatus::Solved) << "seed " << seed;
    const auto answers = answers_by_level(levels, unknowns_of(levels));
    EXPECT_LE(OptimalityJudge(levels).judge(answers).worst(), kRight) << "seed " << seed;
  }
}

TEST_P(SolverLargeLevel, IsFoundAgainFromItsSetWithoutAnAllocation) {
  for (unsigned long long seed = 1; seed <= 100; ++seed) {
    const Hierarchy levels = with_large_level(seed);
    Solver solver(unknowns_of(levels));
    const Vector x = solver.solve(levels).x;
    const NoAllocation none;
    const Solution& solution = solver.solve(levels);
    EXPECT_EQ(none.count(), 0U) << "seed " << seed;
    EXPECT_EQ(solution.status, SolverStatus::Solved) << "seed " << seed;
    const double size = std::max(1.0, x.lpNorm<Eigen::Infinity>());
    EXPECT_LE((solution.x - x).lpNorm<Eigen::Infinity>(), 1e-7 * size) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, SolverLargeLevel, ::testing::Values("baseline", "avx2"));

}  // namespace
}  // namespace hurcules

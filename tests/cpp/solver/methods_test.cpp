// Strategy: what every method has to keep, whatever it answers, stamped over all of them: any
// input, finite answers that describe themselves, snapshots, warm starts, allocation. Then the
// cascade against the default. What Algorithm 1 answers: the claims (Python, claims_*).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hurcules/solver/method.hpp"
#include "hurcules/solver/solver.hpp"
#include "support/no_allocation.hpp"
#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using hurcules_test::RandomHierarchy;

constexpr double kInf = std::numeric_limits<double>::infinity();

class EveryMethod : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] Solver make(Index unknowns) const {
    return Solver(unknowns, {.method = GetParam()});
  }
};

// x, violations and working set of a solution say the same
void expect_consistent(const Hierarchy& levels, const Solution& solution) {
  ASSERT_TRUE(solution.x.allFinite());
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const Level& level = levels[k];
    const Vector value = level.bounds ? solution.x : Vector(level.A * solution.x);
    const Vector wanted = value - value.cwiseMax(level.lower).cwiseMin(level.upper);
    EXPECT_LT((wanted - solution.violations[k]).lpNorm<Eigen::Infinity>(), 1e-11);
  }
  for (const ActiveRow& row : solution.working_set) {
    const Level& level = levels[row.level];
    const double limit = row.side == Side::Upper ? level.upper[row.row] : level.lower[row.row];
    EXPECT_LT(std::abs(limit), kInfinity);
    EXPECT_LE(row.level, row.held_by);
    EXPECT_GE(row.multiplier, 0.0);
  }
  EXPECT_LE(solution.final_levels, static_cast<int>(levels.size()));
  if (solution.status == SolverStatus::Solved) {
    EXPECT_EQ(solution.final_levels, static_cast<int>(levels.size()));
    EXPECT_LT(solution.optimality, 1e-9);
  }
}

TEST_P(EveryMethod, SolutionsDescribeThemselves) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Hierarchy levels = RandomHierarchy(seed).conflicting(12, seed % 2 ? 0.1 : 0.0);
    Solver solver = make(12);
    expect_consistent(levels, solver.solve(levels));
    const auto multipliers = solver.multipliers();
    for (std::size_t k = 0; k < multipliers.size(); ++k) {
      ASSERT_EQ(multipliers[k].size(), k + 1);
      for (std::size_t j = 0; j <= k; ++j) {
        ASSERT_EQ(multipliers[k][j].size(), levels[j].rows());
        EXPECT_TRUE(multipliers[k][j].allFinite());
      }
    }
  }
}

TEST_P(EveryMethod, TakesOneSidedRowsBoundsAnywhereAndEmptyLevels) {
  RandomHierarchy random(3);
  Hierarchy levels = {random.interval(3, 6, 0.1),
                      random.equality(2, 6, 0.1),
                      make_bounds(Vector::Constant(6, -0.3), Vector::Constant(6, 0.3)),
                      Level{.A = Matrix(0, 6), .lower = {}, .upper = {}},
                      random.equality(2, 6, 0.0),
                      make_bounds(Vector::Constant(6, -0.1), Vector::Constant(6, kInf))};
  levels[0].upper[0] = kInf;
  levels[0].lower[1] = -1e20;
  levels[0].lower[2] = -kInf;
  levels[0].upper[2] = kInf;
  levels[4].A.row(1).setZero();
  Solver solver = make(6);
  const Solution& solution = solver.solve(levels);
  EXPECT_NE(solution.status, SolverStatus::InvalidInput);
  expect_consistent(levels, solution);
  EXPECT_GE(solution.factorizations, 5);
  EXPECT_EQ(make(6).solve({}).x, Vector::Zero(6));
}

TEST_P(EveryMethod, BadNumbersAndShapesAreAStatus) {
  const auto good = [] { return RandomHierarchy(1).conflicting(12, 0.1); };
  std::vector<Hierarchy> bad(5, good());
  bad[0][2].lower[0] = std::nan("");
  bad[1][1].A(0, 0) = std::nan("");
  bad[2][2].lower[0] = bad[2][2].upper[0] + 1.0;
  bad[3][1].A = Matrix::Ones(3, 11);
  bad[4][1].upper = Vector::Ones(2);
  Solver solver = make(12);
  for (const Hierarchy& levels : bad) {
    EXPECT_EQ(solver.solve(levels).status, SolverStatus::InvalidInput);
    EXPECT_EQ(solver.solution().x, Vector::Zero(12));
    EXPECT_TRUE(solver.solution().working_set.empty());
    EXPECT_TRUE(solver.multipliers().empty());
  }
  EXPECT_NE(solver.solve(good()).status, SolverStatus::InvalidInput);
}

TEST_P(EveryMethod, HugeAndTinyNumbersEndFinite) {
  for (const double size : {1e-300, 1e-150, 1e100, 1e150, 1e300}) {
    for (const double rho : {0.0, 0.1}) {
      RandomHierarchy random(5);
      Hierarchy levels = random.conflicting(4, rho);
      levels[1].A *= size;
      levels[2].A.row(0) *= 1.0 / size;
      levels[3].lower *= std::min(size, 1e19);
      levels[3].upper = levels[3].lower;
      Solver solver = make(4);
      EXPECT_TRUE(solver.solve(levels).x.allFinite()) << size;
      EXPECT_FALSE(std::isnan(solver.solution().optimality)) << size;
    }
  }
}

TEST_P(EveryMethod, ASnapshotContinuesWithTheSameBits) {
  Hierarchy levels = RandomHierarchy(4).conflicting(12, 0.1);
  Solver a = make(12), b = make(12);
  (void)a.solve(levels);
  std::vector<double> numbers;
  StateWriter writer(numbers);
  a.save(writer);
  StateReader reader(numbers);
  b.restore(reader);
  EXPECT_TRUE(reader.at_end());
  levels[1].lower.array() += 0.01;
  levels[1].upper.array() += 0.01;
  EXPECT_EQ(a.solve(levels).x, b.solve(levels).x);
  EXPECT_EQ(a.solution().changes, b.solution().changes);
}

TEST_P(EveryMethod, ResetMakesTheNextSolveCold) {
  const Hierarchy levels = RandomHierarchy(7).conflicting(12, 0.1);
  Solver solver = make(12);
  const Vector cold = solver.solve(levels).x;
  const int changes = solver.solution().changes;
  (void)solver.solve(levels);
  solver.reset();
  EXPECT_EQ(solver.solve(levels).x, cold);
  EXPECT_EQ(solver.solution().changes, changes);
}

TEST_P(EveryMethod, ALimitThatGoesAwayIsForgotten) {
  // held in the first solve, absent in the second, which has the same pattern otherwise
  Solver solver = make(1);
  const Level goal{.A = Matrix{{1.0}}, .lower = Vector{{5.0}}, .upper = Vector{{5.0}}};
  const auto limit = [](double upper) { return make_bounds(Vector{{-1.0}}, Vector{{upper}}); };
  EXPECT_NEAR(solver.solve({limit(1.0), goal}).x[0], 1.0, 1e-14);
  EXPECT_NEAR(solver.solve({limit(kInf), goal}).x[0], 5.0, 1e-12);
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn(method_names()), name_of);

TEST(Methods, AllButTheCascadeAllocateNothingOnceSized) {
  for (const std::string& name : method_names()) {
    if (name == "cascade") continue;
    Hierarchy levels = RandomHierarchy(6).conflicting(12, 0.1);
    Solver solver(12, {.method = name});
    solver.reserve(levels);
    for (int tick = 0; tick < 20; ++tick) {
      levels[1].lower.array() += 0.05;
      levels[1].upper.array() += 0.05;
      const hurcules_test::NoAllocation none;
      (void)solver.solve(levels);
      EXPECT_EQ(none.count(), 0u) << name;
    }
  }
}

TEST(Methods, TheCascadeAgreesWithTheDefault) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Hierarchy levels = RandomHierarchy(seed).conflicting(9, seed % 3 ? 0.1 : 0.0);
    Solver ours(9), cascade(9, {.method = "cascade"});
    const Vector difference = ours.solve(levels).x - cascade.solve(levels).x;
    EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-7) << "seed " << seed;
    EXPECT_EQ(cascade.solution().status, SolverStatus::Solved) << "seed " << seed;
  }
}

TEST(Methods, TheLimitOfIterationsKeepsTheBestPointSeen) {
  // the endless cycle of R21: the answer is the point of the cycle that violates the levels least
  const Vector y2 = Vector::Constant(2, -2.0), y3 = Vector{{-2.0, 2.0}};
  const Matrix eye = Matrix::Identity(4, 4), J2 = Matrix{{1, 0, 1, 2}, {1, -0.1, 1.2, 2}};
  const Matrix J3 = Matrix{{-2, 2, -1, -2}, {-2, 2, 1, 2}};
  const Vector half = Vector::Constant(4, 0.5);
  const Hierarchy levels = {{.A = eye, .lower = -half, .upper = half, .rho = 0.1},
                            {.A = J2, .lower = y2, .upper = y2, .rho = 0.1},
                            {.A = J3, .lower = y3, .upper = y3, .rho = 0.1}};
  Solver solver(4, {.method = "dls_hqp", .max_iterations = 12});
  for (int tick = 0; tick < 3; ++tick) {
    const Solution& solution = solver.solve(levels);
    EXPECT_EQ(solution.status, SolverStatus::IterationLimit);
    EXPECT_EQ(solution.changes, 11);
    EXPECT_LE(solution.violations[0].norm(), 0.0);
    EXPECT_LT(solution.final_levels, 3);
  }
}

}  // namespace
}  // namespace hurcules

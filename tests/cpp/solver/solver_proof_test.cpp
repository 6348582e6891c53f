// Strategy: a small run of benchmarks/solver_proof.cpp. Every class of hierarchies at every
// regularisation is Solved with a residual of at most 1e-9, and the answer is optimal by a judge
// that knows the definition (solver.md §1) and nothing of the solver; negative controls show that
// the judge tells wrong from right. Not tested: agreement with another solver
// (test_solver_oracle.py).
#include <gtest/gtest.h>

#include "hurcules/solver/solver.hpp"
#include "support/answers_by_level.hpp"
#include "support/each_problem.hpp"
#include "support/optimality_judge.hpp"

namespace hurcules {
namespace {
using namespace hurcules_test;

class SolverProof : public EachClass {};

TEST_P(SolverProof, EveryAnswerIsSolvedAndProven) {
  for (const double rho : kRegularisations) {
    each_problem(60, {rho}, [](const Hierarchy& levels, Draw&) {
      Solver solver(unknowns_of(levels));
      const Solution& solution = solver.solve(levels);
      EXPECT_EQ(to_string(solution.status), "solved");
      EXPECT_TRUE(solution.x.allFinite());
      EXPECT_LE(solution.optimality, kProven);
      EXPECT_EQ(solution.final_levels, static_cast<int>(levels.size()));
    });
  }
}

TEST_P(SolverProof, EveryAnswerIsOptimalByTheDefinitionAlone) {
  for (const double rho : kRegularisations) {
    each_problem(20, {rho}, [](const Hierarchy& levels, Draw&) {
      const Verdict verdict =
          OptimalityJudge(levels).judge(answers_by_level(levels, unknowns_of(levels)));
      EXPECT_LE(verdict.feasibility, kProven);
      EXPECT_LE(verdict.stationarity, kProven);
      EXPECT_LE(verdict.smallest, kProven);
    });
  }
}

HURCULES_FOR_EACH_CLASS(SolverProof);

// Found by the bulk run: these ended elsewhere. Where rho = 1e-9 the step was up to 25 % too long,
// in the other thin cones x was off by 8e-3, in near_singular by 0.02 to 3.1 (by arithmetic of 130
// digits, benchmarks/exact_referee.py).
struct Found {
  const char* name;
  double rho;
  unsigned long long seed;
};
constexpr Found kFound[] = {
    {"thin_cones", 1e-9, 5121},    {"thin_cones", 1e-9, 4903},    {"thin_cones", 1e-9, 3927},
    {"thin_cones", 1e-9, 1148},    {"thin_cones", 1e-9, 3596},    {"repeats", 1e-9, 2779},
    {"thin_cones", 0.1, 849},      {"thin_cones", 0.0, 849},      {"near_singular", 1e-6, 2091},
    {"near_singular", 1e-7, 2091}, {"near_singular", 1e-8, 2434}, {"near_singular", 1e-9, 2434},
    {"near_singular", 0.0, 2434},  {"near_singular", 1e-7, 5935}, {"near_singular", 1e-8, 5935},
    {"near_singular", 1e-9, 5935}, {"near_singular", 0.0, 5935},
};

TEST(SolverProofFound, AnswersThatEndedElsewhereAreProvenNow) {
  for (const Found& found : kFound) {
    SCOPED_TRACE(std::string(found.name) + " " + std::to_string(found.seed));
    for (const HierarchyClass& kind : kHierarchyClasses) {
      if (std::string(kind.name) != found.name) continue;
      Draw draw(found.seed);
      const Hierarchy levels = kind.make(draw, found.rho);
      Solver solver(unknowns_of(levels));
      EXPECT_EQ(to_string(solver.solve(levels).status), "solved");
      EXPECT_LE(solver.solution().optimality, kProven);
      const std::vector<Vector> x = answers_by_level(levels, unknowns_of(levels));
      EXPECT_LE(OptimalityJudge(levels).judge(x).worst(), kProven);
    }
  }
}

Level one_row(Matrix a, double lower, double upper, double rho) {
  return interval(std::move(a), Vector::Constant(1, lower), Vector::Constant(1, upper), rho);
}

// x1 + x2 = 2 with rho = 0 below x1 <= 0.5: (0.5, 1.5)
const Hierarchy kLimited = {one_row(Matrix{{1.0, 0.0}}, -kNoLimit, 0.5, 0.0),
                            one_row(Matrix{{1.0, 1.0}}, 2.0, 2.0, 0.0)};

Verdict judge_limited(double x1, double x2) {
  return OptimalityJudge(kLimited).judge({Vector::Zero(2), Vector{{x1, x2}}});
}

TEST(OptimalityJudge, AcceptsTheAnswer) {
  EXPECT_LT(judge_limited(0.5, 1.5).worst(), 1e-14);
}

TEST(OptimalityJudge, NoticesABrokenLimit) {
  EXPECT_GT(judge_limited(1.0, 1.0).feasibility, 0.3);
}

TEST(OptimalityJudge, NoticesAViolationThatCouldBeSmaller) {
  EXPECT_GT(judge_limited(0.5, 1.4999).stationarity, 1e-5);
}

TEST(OptimalityJudge, NoticesALimitThatPullsInsteadOfPushing) {
  // x1 = x2 = 1 is the smallest step below x1 <= 1; holding x1 at a limit of 0.5 needs no push the
  // other way
  EXPECT_GT(judge_limited(0.2, 1.8).smallest, 0.1);
  const Hierarchy levels = {one_row(Matrix{{1.0, 0.0}}, -kNoLimit, 1.5, 0.0),
                            one_row(Matrix{{1.0, 1.0}}, 2.0, 2.0, 0.0)};
  EXPECT_GT(OptimalityJudge(levels).judge({Vector::Zero(2), Vector{{1.5, 0.5}}}).smallest, 0.1);
  EXPECT_LT(OptimalityJudge(levels).judge({Vector::Zero(2), Vector{{1.0, 1.0}}}).worst(), 1e-14);
}

TEST(OptimalityJudge, NoticesARegularisedLevelThatStopsElsewhere) {
  const Hierarchy levels = {one_row(Matrix{{1.0, 1.0}}, -1.0, -1.0, 0.1)};
  // -1 / (2 + rho^2) each  [T 3.3.38]
  const Vector right = Vector::Constant(2, -1.0 / 2.01);
  EXPECT_LT(OptimalityJudge(levels).judge({right}).worst(), 1e-13);
  EXPECT_GT(OptimalityJudge(levels).judge({1.001 * right}).stationarity, 1e-4);
}

// A row that stands out by s from the one above, of which a bound leaves s e. With x2 at its bound,
// x3 = s e (y - s) / ((s e)^2 + rho^2): a part of 4e-15 of the row decides where x3 goes.
constexpr double kOut = 0x1p-26, kLeft = 0x1p-22, kAsked = 0.01;

Hierarchy weak_row(double rho) {
  return {make_bounds(Vector::Constant(3, -1.0), Vector::Constant(3, 1.0)),
          one_row(Matrix{{1.0, 0.0, 0.0}}, 0.0, 0.0, rho),
          one_row(Matrix{{1.0, kOut, kOut * kLeft}}, kAsked, kAsked, rho)};
}

Vector weak_row_answer(double rho) {
  const double a = kOut * kLeft;
  return Vector{{0.0, 1.0, std::min(1.0, a * (kAsked - kOut) / (a * a + rho * rho))}};
}

TEST(SolverProofFound, TheCoordinateThatABoundLeavesOfAWeakRowIsExact) {
  for (const double rho : {1e-6, 1e-7, 1e-8, 1e-9, 0.0}) {
    Solver solver(3);
    EXPECT_EQ(to_string(solver.solve(weak_row(rho)).status), "solved") << "rho " << rho;
    EXPECT_LE((solver.solution().x - weak_row_answer(rho)).norm(), 1e-10) << "rho " << rho;
  }
}

TEST(OptimalityJudge, NoticesACoordinateThatAWeakRowShouldHaveMoved) {
  const Vector none = Vector::Zero(3);
  for (const double rho : {1e-8, 0.0}) {
    const Hierarchy levels = weak_row(rho);
    EXPECT_LT(OptimalityJudge(levels).judge({none, none, weak_row_answer(rho)}).worst(), 1e-14);
    const Vector stays{{0.0, 1.0, 0.0}};
    EXPECT_GT(OptimalityJudge(levels).judge({none, none, stays}).worst(), 1e-9);
  }
}

}  // namespace
}  // namespace hurcules

// Inputs that once broke a promise, found by fuzzing (tests/fuzz) and by bulk runs
// (benchmarks/solver_proof.cpp), shortened. Each is solved cold and warm, and has to be Solved,
// proven, and optimal by the definition alone. Those whose answers lie far away are in
// solver_far_test.cpp.
#include <gtest/gtest.h>

#include "hurcules/base/error.hpp"
#include "hurcules/solver/solver.hpp"
#include "support/answers_by_level.hpp"
#include "support/draw.hpp"
#include "support/hierarchy_classes.hpp"
#include "support/optimality_judge.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

void expect_solved(const Hierarchy& levels, Index unknowns) {
  Solver solver(unknowns);
  for (const char* start : {"cold", "warm"}) {
    const Solution& solution = solver.solve(levels);
    EXPECT_EQ(to_string(solution.status), "solved") << start;
    EXPECT_LE(solution.optimality, 1e-9) << start;
  }
  const Verdict verdict = OptimalityJudge(levels).judge(answers_by_level(levels, unknowns));
  EXPECT_LE(verdict.feasibility, 1e-9);
  EXPECT_LE(verdict.stationarity, 1e-9);
  EXPECT_LE(verdict.smallest, 1e-9);
}

TEST(SolverFound, AWeakRowTakesXFarAway) {
  // to 6e3, and level 1 from 5 to 5.6e3, and back to 4 from where a quicker way got lost
  expect_solved({interval(Matrix{{3.0, 3.0, 3.0}, {0.0, 0.0, 1e-4}}, Vector{{3.0, 0.5}},
                          Vector{{5.0, 1.0}}, 1e-8)},
                3);
  expect_solved({interval(Matrix{{0.0, 1.0, 3.0, -2.0}}, Vector{{3.0}}, Vector{{5.0}}, 0.0),
                 equality(Matrix{{0.0005, 1.0001, 500.0, 0.25}, {0.001, 2.0, 1000.0, 0.5}},
                          Vector{{-0.5, -2.0}}, 0.0)},
                4);
  expect_solved(
      {interval(Matrix{{0.0, 0.0, 0.001, 1.0, 0.0}}, Vector{{1.9375}}, Vector{{2.9375}}, 0.0),
       make_bounds(Vector{{-kNoLimit, -kNoLimit, -kNoLimit, -kNoLimit, -kNoLimit}},
                   Vector{{kNoLimit, kNoLimit, 2.0 + 1e-14, -999.999, kNoLimit}}),
       equality(Matrix{{0.001, 0.001, 0.001, 0.001, 0.001}}, Vector{{0.001}}, 0.0)},
      5);
}

TEST(SolverFound, RoundingBehindAWeakRowIsNoDirection) {
  // beside the bound x3 >= 0.5 both rows ask for the sum of x4 .. x7; x once was 6e14
  for (const double weak : {1e-3, 1e-2, 1e-1}) {
    Matrix A = Matrix::Zero(2, 7);
    A.rightCols(5).setConstant(weak);
    A(0, 2) = -1.8125;
    Vector lower = Vector::Constant(7, -kNoLimit);
    lower[2] = 0.5;
    const Hierarchy levels = {make_bounds(lower, Vector::Constant(7, kNoLimit)),
                              equality(A, Vector{{weak, weak}}, 0.0)};
    expect_solved(levels, 7);
    // both violations of opposite signs and one size
    Solver solver(7);
    const Vector violation = solver.solve(levels).violations[1];
    EXPECT_NEAR(violation.sum(), 0.0, 1e-9) << weak;
  }
}

TEST(SolverFound, ABoundBelowPullsAgainstAOneSidedBoundAbove) {
  const Hierarchy levels = {
      make_bounds(Vector{{0.25, 0.5, -kNoLimit}}, Vector{{0.25, 1.5, -0.75}}),
      make_bounds(Vector{{-0.75, -kNoLimit, -0.5}}, Vector{{-0.75, 1.25, -0.25}})};
  expect_solved(levels, 3);
  Solver solver(3);
  EXPECT_LE((solver.solve(levels).x - Vector{{0.25, 0.5, -0.75}}).norm(), 1e-12);
}

TEST(SolverFound, ABoundHoldsAgainstTwoViolatedRowsOfOneDirection) {
  expect_solved({make_bounds(Vector{{-2.0}}, Vector{{2.0}}),
                 interval(Matrix{{2.0}, {2.0}}, Vector{{-7.0, -7.0}}, Vector{{-7.0, -3.0}}, 0.1)},
                1);
  expect_solved({make_bounds(Vector{{-2.0}}, Vector{{2.0}}),
                 interval(Matrix{{2.0}, {2.0}}, Vector{{-7.0, -3.0}}, Vector{{-7.0, -2.0}}, 0.1)},
                1);
}

TEST(SolverFound, ParallelRowsWithTinyRegularisationStayOnTheirLine) {
  const Matrix a{{-2.0, -2.0, 2.0, 4.0}};
  Matrix A(3, 4);
  A << a, a, -0.5 * a;
  for (const double rho : {1e-1, 1e-3, 1e-5, 1e-8, 1e-9, 0.0}) {
    const Hierarchy levels = {
        interval(A, Vector{{6.0, -14.0, -7.0}}, Vector{{6.0, -14.0, -6.0}}, rho)};
    expect_solved(levels, 4);
    Solver solver(4);
    const Vector x = solver.solve(levels).x, along = a.transpose().normalized();
    EXPECT_LE((x - along.dot(x) * along).norm(), 1e-12) << "rho " << rho;
  }
}

TEST(SolverFound, AWeakRowBesideAStrongLimitIsMet) {
  // 0.001 x1 = 0.001 below nothing, with -2 x1 + 0.001 x2 >= 2 in the same level: both can be met
  expect_solved({interval(Matrix{{-2.0, 0.001}, {0.001, 0.0}}, Vector{{2.0, 0.001}},
                          Vector{{kNoLimit, 0.001}}, 0.0)},
                2);
  expect_solved({interval(Matrix{{-1000.0, -1.0}, {0.001, 0.001}}, Vector{{0.001, 0.001}},
                          Vector{{kNoLimit, 0.001}}, 0.0)},
                2);
}

TEST(SolverFound, OwnRowsThatRegularisationAloneBreaksCount) {
  // both rows of a pair are violated by amounts of rho^2
  expect_solved({interval(Matrix{{2.0}, {-2.0}}, Vector{{1.0, -1.0}}, Vector{{3.0, -1.0}}, 1e-5)},
                1);
  expect_solved({interval(Matrix{{1.0}, {1.0}}, Vector{{3.0, 3.0}}, Vector{{4.0, 3.0}}, 1e-5)}, 1);
  expect_solved(
      {interval(Matrix{{0.001}, {1000.0}}, Vector{{0.004, 1000.0}}, Vector{{1.004, 1000.0}}, 1e-9)},
      1);
  expect_solved({interval(Matrix{{0.001}, {0.001}, {0.001}}, Vector{{0.001, 0.001, 0.001}},
                          Vector{{0.001 + 1e-14, 0.001, 0.001}}, 1e-7)},
                1);
}

TEST(SolverFound, TwoNearlyParallelLimitsInConflict) {
  expect_solved({interval(Matrix{{2.0, 1.9619140625}, {6.0, 5.8858421874999998}},
                          Vector{{3.0, 0.0}}, Vector{{3.5, 1.0}}, 0.0)},
                2);
}

TEST(SolverFound, AWeakEqualityBesideALimitWithTinyRegularisation) {
  expect_solved({interval(Matrix{{278.2129685317737, 1565.6117451807434},
                                 {1.3243626947064973, 7.3961667753724463}},
                          Vector{{-115304.7805787222, -201.31391881575274}},
                          Vector{{-115304.7805787222, kNoLimit}}, 1e-9)},
                2);
}

TEST(SolverFound, NearlyEqualRowsInALevelOfLimits) {
  expect_solved(
      {interval(Matrix{{3.0, 3.0, 3.0, 3.0}, {9.0, 9.0, 9.0, 9.0 + 1e-10}}, Vector{{3.0, 3.0}},
                Vector{{5.0, 3.5}}, 1e-8),
       make_bounds(Vector{{0.0, 0.001, 0.001, 0.001}}, Vector{{1.0, 0.001, 0.001, 0.001}})},
      4);
}

TEST(SolverFound, TinyRegularisationOnParallelRowsOfDifferentSize) {
  expect_solved({interval(Matrix{{2.0, 2.0, 2.0}, {0.001, 0.001, 0.001}}, Vector{{-1.5, 0.001}},
                          Vector{{-0.5, 0.001}}, 1e-8)},
                3);
}

TEST(SolverFound, RegularisationLargerThanTheRowsIsProvenToo) {
  expect_solved({make_bounds(Vector{{1.000000001}}, Vector{{1.000000001 + 1e-14}}),
                 equality(Matrix{{0.001}, {0.001}, {0.001}}, Vector{{0.001, 0.001, 0.001}}, 1.0)},
                1);
}

TEST(SolverFound, AWarmSolveEqualsTheColdOneBesideLockedBounds) {
  const Hierarchy levels = {interval(Matrix{{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, -1.0}},
                                     Vector{{-1.0}}, Vector{{-0.999}}, 1.0),
                            make_bounds(Vector{{0.0, 0.0, -1.0, -2.0, 0.0, 0.0, 1.4375, 0.0}},
                                        Vector{{0.0, 1.0, -0.999, -2.0, 0.0, 1.0, 2.4375, 0.0}})};
  expect_solved(levels, 8);
  Solver solver(8);
  const Vector cold = solver.solve(levels).x;
  EXPECT_LE((solver.solve(levels).x - cold).norm(), 1e-9);
}

TEST(SolverFound, AVertexWithManySetsOfMultipliersIsProven) {
  // solver_proof: x was right, but its working set stood for multipliers that prove nothing
  struct Seeded {
    double rho;
    unsigned long long seed;
  };
  for (const Seeded& problem : {Seeded{0.0, 2873}, Seeded{0.0, 3965}, Seeded{1e-6, 3965}}) {
    Draw draw(problem.seed);
    const Hierarchy levels = near_singular(draw, problem.rho);
    expect_solved(levels, unknowns_of(levels));
  }
}

TEST(SolverFound, CopiesOfARowEachMetToRoundingAreNotMetTogether) {
  // every copy is broken by less than counts as broken, by the regularisation of the level above
  const Matrix row{{-0.03, 0.0, 0.0, 0.001, 0.001, 0.5, 0.5}};
  const Level copies = interval(row.replicate(4, 1), Vector::Constant(4, 0.5),
                                Vector::Constant(4, 0.5 + 1e-9), 1e-6);
  expect_solved({copies, copies}, 7);
  expect_solved({copies, copies, copies,
                 equality(Matrix{{3.0, 0.0, 1.0, 1.0, 0.001, 0.001, 0.001},
                                 {0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001}},
                          Vector{{0.001, 0.001}}, 0.0)},
                7);
}

TEST(SolverFound, TinyRegularisationDecidesBetweenTwoUnknownsOfEqualWorth) {
  // rho is 1e-8 below a row of length 2000 that is in conflict
  expect_solved(
      {make_bounds(
           Vector{{0.001, -kNoLimit, 2.0, 0.001, 0.001, -kNoLimit, -kNoLimit, -kNoLimit}},
           Vector{{1.001, -999.999999999, 2.000000001, 1.001, kNoLimit, -998.0, -998.0, 4.0}}),
       equality(Matrix{{-1000.0, -1000.0, -1000.0, -1000.0, 2.0, 0.001, 0.001, -0.001},
                       {0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001}},
                Vector{{0.001, 0.001}}, 1e-8),
       make_bounds(Vector::Constant(8, 0.001), Vector::Constant(8, 0.001))},
      8);
}

TEST(SolverFound, DirectionsOfWeakRowsBehindWeakRowsTurnByBoth) {
  // x is 1.5e5; row 0 of level 2 stands out by 1e-6 of its length, row 2 from that by 1e-3 of its
  // own: 1e-16 in the rows is 1e-7 in their last direction. The judge once counted 1e-10.
  expect_solved(
      {interval(Matrix{{-2.0, 1.0, -1.63916015625, 0.880615234375, -0.5, 0.0, 0.5, -1.0},
                       {-1.0, 3.0, -2.0, -1.43994140625, -0.5, 1.425537109375, 2.0, 0.0},
                       {-0.5, 1.5, -1.0, -0.719970703125, -0.25, 0.7127685546875, 1.0, 0.0}},
                Vector{{-1.815673828125, 2.0, 3.0}},
                Vector{{-1.81567382812499, 2.0009999999999999, 3.0}}, 0.1),
       interval(Matrix{{1.0, -3.0, 2.0, 1.43994140625, 0.5, -1.425537109375, -2.0, 0.0},
                       {0.5, -1.0, -1000.0, -2.0, 1000.0, -2.0, 0.5, -1.0},
                       {-4.0, 2.0, -3.2783203125, 1.76123046875, -0.999, 0.0, 1.0, -2.0}},
                Vector{{-1.845703125, -1.0, 1.882080078125}},
                Vector{{-1.845703125, -1.0, kNoLimit}}, 1e-5),
       equality(Matrix{{-0.4019541015625, 0.805908203125, 805.908203125, 1.61181640625,
                        -805.908203125, 1.61181640625, -0.4029541015625, 0.805908203125},
                       {2.0, 1.09521484375, 0.5, -2.0, -0.5, -2.0, -0.2431640625, -0.32470703125},
                       {1.0, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001}},
                Vector{{0.5, -0.5, 0.001}}, 1e-8)},
      8);
}

TEST(SolverFound, AnInterruptedSolveStaysInsideTheBoundsAbove) {
  const Matrix row{{-1000.0, -1000.0, 30.0, 0.001, 0.001, 0.001, -1000.0, -1000.0}};
  const Vector fixed{{3.0, 0.001, 0.001, 0.001, 1.0, 2.0}};
  Vector lower(8), upper(8);
  lower << fixed, -kNoLimit, -kNoLimit;
  upper << fixed, -998.0, -998.0;
  const Hierarchy limited = {make_bounds(lower, upper),
                             interval(row, Vector{{-kNoLimit}}, Vector{{-1.0}}, 1e-8)};
  const Hierarchy boxes = {make_bounds(Vector{{0.0, 0.0, 0.0, 0.0, 1.0, -0.5, 0.0, 0.0}},
                                       Vector{{0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0}}),
                           make_bounds(Vector{{0.0, 0.0, 0.0, 1.0, -0.5, 0.5, -0.5, 1.0}},
                                       Vector{{0.0, 0.0, 0.0, 1.0, -0.5, kNoLimit, -0.5, 2.0}}),
                           make_bounds(Vector::Zero(8), Vector::Zero(8))};
  for (const Hierarchy& levels : {limited, boxes}) {
    for (int limit = 1; limit <= 10; ++limit) {
      Solver solver(8, {.max_changes = limit});
      const Solution& solution = solver.solve(levels);
      EXPECT_LE(solution.violations[0].lpNorm<Eigen::Infinity>(), 1e-9) << "limit " << limit;
      if (solution.status == SolverStatus::Solved) {
        EXPECT_EQ(solution.final_levels, static_cast<int>(levels.size()));
      }
    }
  }
}

TEST(SolverFound, AnswerAtTheLimitOfChangesIsProvenBeforeItIsDoubted) {
  // the fifth change is the last of the least-distance form, whose multipliers prove nothing here
  const Matrix first{{-0.830810546875, 1.0}, {0.0, 0.0}};
  const Matrix second{{-1.957763671875, 0.0}, {-1.66162109375, 2.0}};
  const Matrix last{{-3.9150493741035461, 0.0}, {0.80615234375, 1.0}, {2.0, -0.541015625}};
  const Hierarchy levels = {
      interval(first, Vector{{3.0, 2.0}}, Vector{{3.001, 4.0}}, 0.1),
      interval(second, Vector{{1.0, -1.0}}, Vector{{kNoLimit, -0.999}}, 1.0),
      interval(last, Vector{{2.0, 1.0, -0.0869140625}},
               Vector{{2.0000000000000102, kNoLimit, -0.086914062499989994}}, 0.1)};
  for (int limit = 1; limit <= 10; ++limit) {
    Solver solver(2, {.max_changes = limit});
    const SolverStatus status = solver.solve(levels).status;
    EXPECT_TRUE(status == SolverStatus::Solved || status == SolverStatus::IterationLimit) << limit;
  }
}

TEST(SolverFound, SidesBeyondInfinityAreRefusedBySolveAsByCheck) {
  const Hierarchy no_upper = {make_bounds(Vector{{1e300}}, Vector{{kNoLimit}})};
  const Hierarchy at_infinity = {equality(Matrix{{1.0}}, Vector{{-1e20}}, 0.0)};
  for (const Hierarchy& levels : {no_upper, at_infinity}) {
    EXPECT_THROW(check(levels, 1), Error);
    Solver solver(1);
    EXPECT_EQ(to_string(solver.solve(levels).status), "invalid input");
  }
}

TEST(SolverFound, AHugeRowIsNeverSolvedWithoutAProof) {
  for (const double huge : {1e100, 1e155, 1e200, 1e300}) {
    for (const double rho : {0.1, 0.0}) {
      const Hierarchy levels = {make_bounds(Vector{{-1.0, -1.0}}, Vector{{1.0, 1.0}}),
                                equality(Matrix{{huge, 1.0}}, Vector{{1e19}}, rho),
                                equality(Matrix{{1.0, huge}}, Vector{{-1.0}}, rho)};
      Solver solver(2);
      const Solution& solution = solver.solve(levels);
      EXPECT_TRUE(solution.x.allFinite()) << huge;
      if (solution.status == SolverStatus::Solved) {
        EXPECT_LE(solution.optimality, 1e-9) << huge;
      }
    }
  }
}

}  // namespace
}  // namespace hurcules

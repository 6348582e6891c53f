// Inputs found by fuzzing (tests/fuzz) whose answers lie far away, x of 1e6 to 1e12, or whose rows
// stand out from others by 1e-6 to 1e-10 of their length. What is called Solved has to be optimal
// by the definition alone, cold and warm; where precision is lost the status says so.
#include <gtest/gtest.h>

#include "hurcules/solver/solver.hpp"
#include "support/answers_by_level.hpp"
#include "support/draw.hpp"
#include "support/optimality_judge.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

// solved: whether it has to be, or may say that it is not proven
void expect_honest(const Hierarchy& levels, Index unknowns, bool solved) {
  Solver solver(unknowns);
  bool judged = false;
  for (const char* start : {"cold", "warm"}) {
    const Solution& solution = solver.solve(levels);
    const bool proven = solution.status == SolverStatus::Solved;
    EXPECT_TRUE(solution.x.allFinite()) << start;
    EXPECT_EQ(proven, solution.optimality <= 1e-9) << start;
    EXPECT_TRUE(proven || !solved) << start << ": " << to_string(solution.status);
    judged |= proven;
  }
  if (!judged) return;
  const Verdict verdict = OptimalityJudge(levels).judge(answers_by_level(levels, unknowns));
  EXPECT_LE(verdict.feasibility, 1e-9);
  EXPECT_LE(verdict.stationarity, 1e-9);
  EXPECT_LE(verdict.smallest, 1e-9);
}

TEST(SolverFar, LimitsThatAreNearlyOppositeDoNotTakeXToInfinity) {
  expect_honest({interval(Matrix{{-1000.0, -1000.0, 2.0, 0.001, 0.001, 0.0, 2.0, -1000.0}},
                          Vector{{-kNoLimit}}, Vector{{-998.0}}, 1e-07),
                 interval(Matrix{{-2999.999, -3000.0, 6.0, 0.003, 0.003, 0.0, 6.0, -3000.0}},
                          Vector{{0.048095703125}}, Vector{{1.048095703125}}, 1e-08),
                 interval(Matrix{{0.001, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
                                 {0.001, 0.001, 2.0, 2.0, -1000.0, -1000.0, 2.0, -1000.0},
                                 {2.0, -1000.0, -1000.0, 0.0, 1.999755859375, -1.75, 0.001, 0.001},
                                 {0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001}},
                          Vector{{0.001, -kNoLimit, 0.001, 0.001}},
                          Vector{{0.001, -998.0, 0.001, 0.001}}, 0.0)},
                8, true);
}

TEST(SolverFar, AStepAlongNearlyOppositeLimitsIsNotCalledTheSmallest) {
  expect_honest(
      {interval(Matrix{{-1000.0, -1000.0, -1000.0, -1000.0}}, Vector{{-kNoLimit}}, Vector{{-998.0}},
                1e-08),
       interval(Matrix{{-3000.0, -2999.999, -3000.0, -3000.0}}, Vector{{0.0}}, Vector{{1e-09}},
                1e-08),
       make_bounds(Vector{{-kNoLimit, -1000.0, -kNoLimit, -kNoLimit}},
                   Vector{{-998.0, -1000.0, -998.0, -998.0}}),
       equality(Matrix{{-1000.0, -1000.0, 1.960693359375, -0.001}}, Vector{{0.0}}, 1e-08),
       make_bounds(Vector{{-1.35595703125, 3.0, 0.5, 1.000000001}},
                   Vector{{0.64404296875, kNoLimit, 0.50000000000001, 1.0000000020000002}})},
      4, true);
}

TEST(SolverFar, AnOwnRowMetToRoundingDoesNotPullAtTheStep) {
  expect_honest(
      {interval(Matrix{{0.0, 1.999755859375, 1.999755859375, 1.999755859375},
                       {0.0, 3.87989741563797, 3.87989741563797, 3.87999741563797},
                       {-1000.0, -1000.0, -1000.0, -1000.0}},
                Vector{{1.999755859375, -kNoLimit, -kNoLimit}},
                Vector{{1.999755860375, -998.0, 0.001000001}}, 0.0),
       make_bounds(Vector{{1.937255859375, 3.0, 1.999755859375, 1.999755859375}},
                   Vector{{1.937255860375, 3.000000001, 1.999755860375, 1.999755860375}}),
       make_bounds(Vector{{1.999755859375, -0.5, -kNoLimit, 1.9375}},
                   Vector{{1.999755860375, 0.5, 1.999755860375, 2.4375}}),
       make_bounds(Vector{{0.5, -0.5, 0.001, 0.001}}, Vector{{0.500000001, 0.5, 0.001, 0.001}})},
      4, true);
}

TEST(SolverFar, ARowAboveOfAThousandthTakesXFarAway) {
  expect_honest(
      {interval(Matrix{{-1000.0, -1000.0, 0.0, 0.0, 0.0, 0.001, 2.0, 1.999755859375}},
                Vector{{-kNoLimit}}, Vector{{2.9375}}, 1e-07),
       make_bounds(Vector{{2.0, -kNoLimit, -kNoLimit, -kNoLimit, -kNoLimit, -kNoLimit, 2.0, 0.001}},
                   Vector{{2.0, -998.0, -998.0, -998.0, 4.0, 1e-09, 2.000000001, 1.001}}),
       equality(Matrix{{-1000.0, -1000.0, 2.0, 2.0, 2.0, -1000.0, 0.001, 0.0}}, Vector{{2.0}},
                1e-08),
       interval(Matrix{{-1000.0, 2.0, 2.0, -1000.0, 0.001, 0.001, 0.001, 0.001},
                       {0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001}},
                Vector{{0.001, 0.001}}, Vector{{1.001, 0.001}}, 1e-08)},
      8, true);
}

TEST(SolverFar, AFarAnswerBelowAWeakRowIsOptimal) {
  expect_honest(
      {make_bounds(Vector{{3.0, 1.0, 1.9375, 0.001, 0.001, -kNoLimit, -kNoLimit, -kNoLimit}},
                   Vector{{3.0, 1.0, 2.4375, 0.001, kNoLimit, -998.0, -998.0, -998.0}}),
       interval(Matrix{{0.001, 0.001, 0.001, 0.999999999999, -1000.0, -1000.0, -1.0, 0.0}},
                Vector{{-kNoLimit}}, Vector{{5.0}}, 1e-08),
       interval(Matrix{{1.0, 1.999755859375, 0.001, -0.001, 0.001, 0.001, 1.000000001, 0.001},
                       {0.0, 0.001, 1000.0, 0.0, 0.001, 0.0, 0.001, 0.001}},
                Vector{{2.0, 0.001}}, Vector{{kNoLimit, 0.001}}, 0.0001),
       make_bounds(Vector{{0.001, 0.001, 0.001, 0.001, 0.001, -kNoLimit, -kNoLimit, -kNoLimit}},
                   Vector{{0.001, 0.001, 0.001, 0.001, 0.001, -998.0, -998.0, -998.0}})},
      8, true);
}

TEST(SolverFar, NearlyOppositeLimitsLeaveNoWayButRounding) {
  // exactly nothing but x2 may move; limits kept to 3e-14 would leave x2 a play of 270
  expect_honest(
      {interval(Matrix{{0.0, 1.0, 0.5, -1000.0},
                       {0.001, 3.0, 1.5, -3000.0},
                       {-1.5703125, 0.0, -2.0, -0.001}},
                Vector{{-kNoLimit, 0.001, 0.001}}, Vector{{-998.0, kNoLimit, 1.001}}, 0.01),
       make_bounds(Vector{{0.001, 0.001, 1.0, 0.001}}, Vector{{kNoLimit, kNoLimit, 1.0, 1.001}}),
       make_bounds(Vector{{1.9619140625, 0.001, 0.001, 0.001}},
                   Vector{{2.9619140625, kNoLimit, kNoLimit, 0.001}})},
      4, true);
}

TEST(SolverFar, NearlyEqualRowsOverThreeLevels) {
  expect_honest(
      {interval(Matrix{{-1000.0, -1000.0, -1000.0, -1000.0}}, Vector{{-kNoLimit}}, Vector{{-998.0}},
                1e-08),
       interval(Matrix{{-2999.999, -3000.0, -3000.0, -3000.0}}, Vector{{0.007568359375}},
                Vector{{0.507568359375}}, 1e-08),
       interval(Matrix{{-8999.997, -9000.0, -9000.0, -8999.9999}}, Vector{{-2.0}}, Vector{{0.0}},
                0.0001),
       interval(Matrix{{1.0, 0.5, 3.0, 0.0}}, Vector{{1.0}}, Vector{{1.000000001}}, 0.0),
       make_bounds(Vector{{0.0, -0.001, 0.001, 0.001}}, Vector{{0.0, 0.999, 0.001, 0.001}}),
       make_bounds(Vector{{0.001, 0.744384765625, 3.0, 0.001}},
                   Vector{{0.501, kNoLimit, 3.0, 0.002}})},
      4, true);
}

TEST(SolverFar, ForcesOfTenToTheTwentyHideNothing) {
  expect_honest(
      {interval(Matrix{{-1000.0, -1000.0, 0.0, 0.0, 0.0, 0.001, 2.0, 1.999755859375}},
                Vector{{-kNoLimit}}, Vector{{2.9375}}, 1e-07),
       make_bounds(Vector{{0.001, -kNoLimit, -kNoLimit, -kNoLimit, -kNoLimit, 2.0, 1.0, 1.0}},
                   Vector{{0.001, -998.0, -999.999999999, -998.0, -998.0, 4.0, 1.0, 1.0}}),
       interval(Matrix{{1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0},
                       {1.0, 1.0, 1.0, 2.0, -1000.0, -1000.0, 0.001, 0.0},
                       {1.947998046875, 1.947998046875, 1.947998046875, 3.89599609375,
                        -1947.998046875, -1947.998046875, 0.001947998046875, 0.0}},
                Vector{{1.0, 0.001, 0.0}}, Vector{{1.0, 0.001, 1.0}}, 1e-06),
       equality(Matrix{{0.001, 0.001, 0.0, 0.001, 0.001, 0.001, 0.001, 0.001}}, Vector{{0.001}},
                0.1)},
      8, true);
}

TEST(SolverFar, ForcesOfTenToTheTwentyProveNothing) {
  // rows 3e-8 apart, one above its lower and one below its upper side: they balance any force
  const Matrix first{{1.43408203125, 3.0, 0.0, 0.0, 1.531005859375, 1.0, -1000.0},
                     {4.30224609375, 9.0, 0.0, 0.0, 4.5931175781249998, 3.0, -3000.0}};
  const Vector lower{
      {-kNoLimit, -1.3779296875, 0.5, -kNoLimit, 0.999999999999, 1.9892578125, -kNoLimit}};
  const Vector upper{
      {0.78076171975, -1.37792968749999, 0.5, -0.499, 1.999999999999, 3.9892578125, 4.0}};
  const Hierarchy levels = {
      interval(first, Vector{{1.999755859375, 2.0}}, Vector{{1.9997558603750001, 2.001}}, 1e-8),
      make_bounds(lower, upper),
      interval(Matrix{{2.0, 2.0, -2.0, -2.0, -2.0, 0.5, 2.0}}, Vector{{-kNoLimit}}, Vector{{4.0}},
               1e-8),
      interval(Matrix{{0.5, -2.0, -0.5, -0.5, -0.5, -0.5, -0.5}}, Vector{{-0.5}},
               Vector{{-0.49999999999999001}}, 0.1)};
  expect_honest(levels, 7, true);
}

TEST(SolverFar, NearlyParallelRowsInThreeLevels) {
  expect_honest(
      {interval(Matrix{{1.999755859375, 1.0, -1.0, 1.999755859375, 1.999755859375, 2.0},
                       {-1.0, 1.999755859375, 1.999755859375, 2.0, 3.0, 3.0},
                       {-3.0, 5.999267578125, 5.999267578125, 6.0, 9.0, 9.000001}},
                Vector{{1.0, 3.0, 3.0}}, Vector{{1.5, 5.0, 5.0}}, 0.001),
       interval(
           Matrix{{-8.999999, 17.997802734375, 17.997802734375, 18.0, 27.0, 27.000003},
                  {-17.99780073461914, 35.9912114739418, 35.9912114739418, 35.99560547875,
                   53.993408203125, 53.99341420239258},
                  {17.999998, -35.99560546875, -35.99560546875, -36.0, -54.0, -54.000005999999}},
           Vector{{3.0, 3.0, 0.0}}, Vector{{5.0, 5.0, kNoLimit}}, 1e-08),
       interval(
           Matrix{
               {53.999994, -107.98681640625, -107.98681640625, -108.0, -162.0, -162.000016999997},
               {-9.0, 17.997802734375, 17.997802734375, 18.0, 27.0, 27.000004},
               {-27.0, 53.993408203125, 53.993408203125, 54.0, 81.0, 81.000013},
               {-17.99780073461914, 35.9912114739418, 35.9912114739418, 35.99560546875,
                53.993408203125, 53.993415202392576}},
           Vector{{3.0, 3.0, -kNoLimit, 3.0}}, Vector{{5.0, 5.0, -0.312744139625, 4.0}}, 1e-06),
       equality(Matrix{{0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
                       {0.001, 0.001, 0.001, 0.001, 0.001, 0.001},
                       {0.001, 0.001, 0.001, 0.001, 0.001, 0.001},
                       {0.001, 0.001, 0.001, 0.001, 0.001, 0.001}},
                Vector{{0.001, 0.001, 0.001, 0.001}}, 0.0001)},
      6, false);
}

TEST(SolverFar, AnOwnRowThatStandsOutBy3em11IsNotCalledSolved) {
  // below the rank tolerance, yet the level moves along it, to x of 1e7
  const Hierarchy levels = {
      interval(Matrix{{-1.0, 1.0, 1.0, -1000.0}, {-2.0, 2.0, 2.0, -2000.0}}, Vector{{0.5, -0.5}},
               Vector{{0.501, -0.5}}, 1e-3),
      interval(Matrix{{-6.0, 6.0, 6.0, -5999.9999}, {0.0547, 0.0547, 0.0547, 0.0547}},
               Vector{{3.0, 0.0547}}, Vector{{3.001, 0.0547}}, 1e-7)};
  expect_honest(levels, 4, false);
}

TEST(SolverFar, AWeakRowBehindAWeakRowIsNotCalledSolved) {
  // 1e-5 of the first row is its own, and the second, an equality, takes nearly all of that: what
  // is left is below the rank tolerance, yet the level moves along it, to x of 2e9
  const Hierarchy levels = {
      equality(Matrix{{0.5, 1.0, -1000.0, -2.0, -1.0, -2.0, 3.0}}, Vector{{1.662353515625}}, 1e-4),
      interval(Matrix{{0.044921875, 0.09084375, -89.84375, -0.1796875, -0.08984375, -0.1796875,
                       0.26953125},
                      {0.0, -1000.0, 0.0, 0.001, 0.001, 0.001, 0.001},
                      {0.001, 0.001, 0.001, 0.001, 0.001, 0.001, 0.001}},
               Vector{{-kNoLimit, 0.001, 0.001}}, Vector{{-2.0, 0.001, 0.001}}, 0.0),
      make_bounds(Vector{{0.001, 0.001, 2.0, 2.0, -kNoLimit, 0.001, 0.0}},
                  Vector{{0.001, 0.001, 2.0, 2.000000001, 1.001, 0.001, 0.0}})};
  expect_honest(levels, 7, false);
}

TEST(SolverFar, ALimitOnARowThatStandsOutBy1em12SaysThatItIsNotMet) {
  // to meet both x is 4e11, where rounding of x alone is more than the limits are apart
  expect_honest(
      {interval(
           Matrix{{-1.0, -0.150390625, 1.366943359375}, {0.5, 0.5, 0.0}, {1.0 - 1e-12, 1.0, 0.0}},
           Vector{{1.536865234375, 0.5, 0.7470703125}},
           Vector{{1.537865234375, 0.50000000000001, 0.7470703125}}, 0.0),
       make_bounds(Vector{{30.0, -0.5, -1.0}}, Vector{{31.0, -0.5, -0.999999999}})},
      3, false);
}

}  // namespace
}  // namespace hurcules

// Strategy: balance and distance by hand on a cart with a bob and on the twin, and their Jacobians
// against central differences at random configurations. Not tested: what a stack does with them
// (control/inequalities_test.cpp).
#include <cmath>

#include "hurcules/tasks/balance_task.hpp"
#include "hurcules/tasks/distance_task.hpp"
#include "support/expect.hpp"
#include "support/no_allocation_guard.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

Matrix square(double half) {
  return (Matrix(4, 2) << half, half, -half, half, -half, -half, half, -half).finished();
}

// largest difference between a task's Jacobian and central differences
double jacobian_error(Robot& robot, Task& task) {
  const double h = 1e-6;
  const Vector q = robot.configuration();
  task.update(robot);
  const Matrix J = task.jacobian();
  double worst = 0.0;
  for (Index i = 0; i < robot.size(); ++i) {
    const Vector step = h * Vector::Unit(robot.size(), i);
    robot.set_configuration(q + step);
    task.update(robot);
    const Vector ahead = task.error();
    robot.set_configuration(q - step);
    task.update(robot);
    const Vector slope = (ahead - task.error()) / (2.0 * h);
    worst = std::max(worst, (slope - J.col(i)).cwiseAbs().maxCoeff());
  }
  robot.set_configuration(q);
  return worst;
}

TEST(BalanceTask, MeasuresFromEachSideInwards) {
  Robot robot(load_model_text(kPendulum));
  robot.set_configuration(Eigen::Vector2d(0.2, 0.0));  // 4 kg at x = 0.2
  BalanceTask balance("balance", robot, {.polygon = square(0.5), .margin = 0.1});
  const Vector wanted = (Vector(4) << 0.5, 0.7, 0.5, 0.3).finished();
  EXPECT_TRUE(near(balance.error(), wanted, 1e-12));
  EXPECT_EQ(balance.lower()[0], 0.1);
  const Matrix other = square(0.5).colwise().reverse();  // the other turn: the same sides
  BalanceTask reversed("balance", robot, {.polygon = other});
  EXPECT_NEAR(reversed.error().minCoeff(), 0.3, 1e-12);
}

TEST(BalanceTask, JacobianAndDriftEqualDifferences) {
  Robot robot(load_model_text(kTwin));
  BalanceTask balance("balance", robot, {.polygon = square(0.5), .reference = "base"});
  for (unsigned seed = 0; seed < 10; ++seed) {
    RandomMotion random(seed);
    random.move(robot);
    EXPECT_LT(jacobian_error(robot, balance), tolerance(1e-6)) << "seed " << seed;
    const Vector q = robot.configuration(), v = random.vector(robot.size(), 1.0);
    robot.set_velocity(v);
    balance.update(robot);
    const Vector drift = balance.drift();
    const double h = 1e-5;
    robot.set_configuration(q + h * v);
    balance.update(robot);
    const Vector ahead = balance.jacobian() * v;
    robot.set_configuration(q - h * v);
    balance.update(robot);
    EXPECT_TRUE(near((ahead - balance.jacobian() * v) / (2.0 * h), drift, 1e-5)) << "seed " << seed;
    robot.set_velocity(Vector::Zero(robot.size()));
  }
}

TEST(BalanceTask, RefusesPolygonsThatAreNone) {
  Robot robot(load_model_text(kPendulum));
  const auto text = [&](const Matrix& polygon) {
    return error_text([&] { BalanceTask("b", robot, {.polygon = polygon}); });
  };
  EXPECT_TRUE(contains(text(square(0.5).topRows(2)), "3 or more"));
  const Matrix dent = (Matrix(4, 2) << 0, 0, 1, 0, 0.1, 0.1, 0, 1).finished();
  EXPECT_TRUE(contains(text(dent), "convex"));
}

TEST(DistanceTask, IsTheGapBetweenTwoBalls) {
  Robot robot(load_model_text(kTwin));
  // leg_l at y = 0.2 and leg_r at -0.2, balls of 0.05 on each
  DistanceTask apart("apart", robot, {.pairs = {{"leg_l", "leg_r"}}, .margin = 0.1, .most = 1.0});
  EXPECT_NEAR(apart.error()[0], 0.4 - 0.1, 1e-9);
  DistanceTask far("far", robot, {.pairs = {{"leg_l", "head"}}, .margin = 0.1, .most = 0.2});
  EXPECT_EQ(far.error()[0], 0.2);
  EXPECT_EQ(far.jacobian().norm(), 0.0);
}

TEST(DistanceTask, JacobianEqualsDifferencesApartAndInEachOther) {
  Robot robot(load_model_text(kTwin));
  DistanceTask task("d", robot,
                    {.pairs = {{"fa_l", "trunk"},
                               {"fa_r", "fa_l"},
                               {"up_l", "head"},
                               {"leg_l", "fa_r"},
                               {"fa_l", "ball"}},
                     .margin = 0.1,
                     .most = 5.0});
  int inside = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomMotion random(seed);
    random.move(robot);
    EXPECT_LT(jacobian_error(robot, task), tolerance(1e-5)) << "seed " << seed;
    task.update(robot);
    inside += (task.error().array() < 0.0).any() ? 1 : 0;
  }
  // a ball moved into another one
  robot.set_keyframe("");
  Vector qpos = robot.qpos();
  qpos.head<3>() = robot.position(robot.frame("hand_l")) + Vector3(0.02, 0.03, 0.25);
  robot.set_qpos(qpos);
  EXPECT_LT(jacobian_error(robot, task), tolerance(1e-5));
  task.update(robot);
  EXPECT_LT(task.error()[4], 0.0);
}

TEST(DistanceTask, AllocatesNothingInAnUpdate) {
  Robot robot(load_model_text(kTwin));
  DistanceTask apart("apart", robot, {.pairs = {{"leg_l", "leg_r"}}});
  BalanceTask balance("balance", robot, {.polygon = square(0.5)});
  const NoAllocation guard;
  apart.update(robot);
  balance.update(robot);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(DistanceTask, RefusesWhatCannotBe) {
  Robot robot(load_model_text(kTwin));
  const auto text = [&](const DistanceTaskOptions& options) {
    return error_text([&] { DistanceTask("d", robot, options); });
  };
  EXPECT_TRUE(contains(text({}), "at least one pair"));
  EXPECT_TRUE(contains(text({.pairs = {{"leg_l", "lge"}}}), "'lge' does not exist"));
  EXPECT_TRUE(contains(text({.pairs = {{"leg_l", "hand_l"}}}), "is neither"));
  EXPECT_TRUE(contains(text({.pairs = {{"leg_l", "leg_r"}}, .margin = 1.0}), "margin"));
}

}  // namespace

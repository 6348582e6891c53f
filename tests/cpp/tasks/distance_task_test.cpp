// Strategy: what the task finds beside MuJoCo's own distances of all pairs, at random postures and
// along a path (the list of what is near must lose nothing); its gradient beside differences; which
// pairs are found on a chain whose answer a hand can give; an obstacle that moves. Not tested here:
// what controllers do with it (tests/python/test_collision.py).
#include "hurcules/tasks/distance_task.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "hurcules/robot/object_names.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/random_motion.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// two arms of three links beside each other, over a floor; a post and a ball that moves
constexpr const char* kArms = R"(
<mujoco>
  <compiler angle="radian"/>
  <default><joint range="-2 2" limited="true"/><geom type="capsule" size="0.05"/></default>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 1"/>
    <geom name="post" type="box" size="0.1 0.1 0.4" pos="0.9 0 0.4"/>
    <geom name="picture" type="box" size="0.1 0.1 0.1" pos="0.5 0 0.6" contype="0" conaffinity="0"/>
    <body name="ball" pos="2 0 1"><freejoint/><geom name="ball" type="sphere" size="0.1"/></body>
    <body name="left" pos="0 0.3 0.8">
      <geom name="l0" type="sphere" size="0.1"/>
      <body name="l_upper"><joint name="l1" axis="0 0 1"/><joint name="l2" axis="0 1 0"/>
        <geom name="l1" fromto="0.15 0 0 0.4 0 0"/>
        <body name="l_lower" pos="0.45 0 0"><joint name="l3" axis="0 1 0"/>
          <geom name="l2" fromto="0.1 0 0 0.3 0 0"/>
          <body name="l_hand" pos="0.4 0 0"><joint name="l4" axis="0 0 1"/>
            <geom name="l3" type="box" size="0.05 0.1 0.02" pos="0.1 0 0"/></body></body></body>
    </body>
    <body name="right" pos="0 -0.3 0.8">
      <body name="r_upper"><joint name="r1" axis="0 0 1"/><joint name="r2" axis="0 1 0"/>
        <geom name="r1" fromto="0.15 0 0 0.4 0 0"/>
        <body name="r_lower" pos="0.45 0 0"><joint name="r3" axis="0 1 0"/>
          <geom name="r2" fromto="0.1 0 0 0.4 0 0"/></body></body>
    </body>
  </worldbody>
  <contact><exclude body1="l_lower" body2="r_upper"/></contact>
</mujoco>)";

using Names = std::vector<std::pair<std::string, std::string>>;

Names names_of(const DistanceTask& task, const Robot& robot) {
  Names names;
  for (const GeomPair& pair : task.pairs())
    names.emplace_back(geom_name(*robot.model(), pair.first),
                       geom_name(*robot.model(), pair.second));
  return names;
}

bool has(const Names& names, const std::string& a, const std::string& b) {
  return std::find(names.begin(), names.end(), std::pair(a, b)) != names.end() ||
         std::find(names.begin(), names.end(), std::pair(b, a)) != names.end();
}

class Distances : public testing::Test {
 protected:
  // of every pair of the task, by MuJoCo alone
  std::vector<double> all_distances(const DistanceTask& task, double most) {
    std::copy(robot_.qpos().begin(), robot_.qpos().end(), data_->qpos);
    mj_kinematics(robot_.model().get(), data_.get());
    std::vector<double> distances;
    for (const GeomPair& pair : task.pairs())
      distances.push_back(mj_geomDistance(robot_.model().get(), data_.get(), pair.first,
                                          pair.second, most, nullptr));
    return distances;
  }

  Robot robot_{load_model_text(kArms), {"l1", "l2", "l3", "l4", "r1", "r2", "r3"}};
  std::unique_ptr<mjData, void (*)(mjData*)> data_{mj_makeData(robot_.model().get()),
                                                   mj_deleteData};
};

TEST_F(Distances, PairsAreThoseThatCanComeNear) {
  const Names own = names_of(self_collision(robot_), robot_);
  EXPECT_TRUE(has(own, "l3", "r2"));   // hand against the other arm
  EXPECT_TRUE(has(own, "l0", "r2"));   // and against a shoulder
  EXPECT_TRUE(has(own, "l1", "l3"));   // two links further
  EXPECT_FALSE(has(own, "l1", "l2"));  // neighbours
  EXPECT_FALSE(has(own, "l2", "r1"));  // excluded by the model
  for (const auto& [first, second] : own) {
    EXPECT_NE(first, "picture");
    EXPECT_NE(first, "floor");
    EXPECT_NE(second, "ball");
  }
  const Names around = names_of(obstacles(robot_), robot_);
  EXPECT_TRUE(has(around, "l3", "floor"));
  EXPECT_TRUE(has(around, "r2", "post"));
  EXPECT_FALSE(has(around, "l0", "floor"));  // which no coordinate moves
  EXPECT_FALSE(has(around, "l3", "ball"));   // which is not fixed
  EXPECT_FALSE(has(around, "l3", "picture"));
  EXPECT_TRUE(has(names_of(obstacles(robot_, {"ball"}, {.most = 1.5}), robot_), "l3", "ball"));
  EXPECT_EQ(own, names_of(self_collision(robot_), robot_));  // the same seed
}

TEST_F(Distances, NothingNearIsLostAlongAPath) {
  const CollisionOptions options{.most = 0.2, .rows = 40};
  DistanceTask task = self_collision(robot_, options);
  RandomMotion random(3);
  std::size_t rows = 0;
  for (int leg = 0; leg < 30; ++leg) {
    const Vector from = robot_.configuration(), to = random.configuration(robot_);
    for (int i = 1; i <= 40; ++i) {
      robot_.set_configuration(from + (to - from) * i / 40.0);
      task.update(robot_);
      const std::vector<double> wanted = all_distances(task, options.most);
      std::vector<double> found(wanted.size(), options.most);
      for (Index row = 0; row < task.rows(); ++row) {
        if (task.pair(row) < 0) continue;
        const auto pair = static_cast<std::size_t>(task.pair(row));
        if (task.is_kept(row)) {
          ASSERT_GE(task.error()[row], wanted[pair] - 0.05 * std::abs(wanted[pair]) - 1e-9);
          continue;
        }
        found[pair] = task.error()[row];
        ++rows;
      }
      // a pair is measured anew when it has moved by a twentieth of its distance
      for (std::size_t k = 0; k < wanted.size(); ++k)
        ASSERT_NEAR(found[k], std::min(wanted[k], options.most), 0.05 * std::abs(wanted[k]) + 1e-9)
            << leg << " " << i;
    }
  }
  EXPECT_GT(rows, 500U) << "the path was not near anything";
}

TEST_F(Distances, NamedPairsKeepHalfOfWhatThereIsAsThoseThatWereFound) {
  // the left forearm is 0.2 m from the post, and the margin larger
  const CollisionOptions options{.margin = 0.35, .most = 0.6, .rows = 40};
  const DistanceTask found = obstacles(robot_, {}, options);
  const Names names = names_of(found, robot_);
  DistanceTask task("named", robot_, {names, 0.35, 0.6, 40, true});
  EXPECT_EQ(task.error(), found.error());
  EXPECT_EQ(task.jacobian(), found.jacobian());
  EXPECT_TRUE((task.error().array() >= task.lower().array()).all());
  const DistanceTask strict("strict", robot_, {names, 0.35, 0.6, 40});
  EXPECT_LT(strict.error().minCoeff(), 0.35);
}

TEST_F(Distances, TheNearestHaveARow) {
  DistanceTask few = self_collision(robot_, {.most = 0.4, .rows = 2});
  RandomMotion random(4);
  for (int i = 0; i < 200; ++i) {
    robot_.set_configuration(random.configuration(robot_));
    few.update(robot_);
    std::vector<double> wanted = all_distances(few, 0.4);
    std::sort(wanted.begin(), wanted.end());
    Vector found = few.error();
    std::sort(found.begin(), found.end());
    // 5 mm nearer, or no reason to change rows; what did not move is not measured anew
    EXPECT_NEAR(found[0], std::min(wanted[0], 0.4), 5.1e-3);
    EXPECT_NEAR(found[1], std::min(wanted[1], 0.4), 5.1e-3);
  }
}

TEST_F(Distances, JacobianEqualsDifferenceOfDistance) {
  RandomMotion random(5);
  constexpr double kStep = 1e-4;
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const Vector q = random.configuration(robot_);
    robot_.set_configuration(q);
    const DistanceTask task = obstacles(robot_, {"ball"}, {.most = 0.5, .rows = 40});
    for (Index k = 0; k < q.size(); ++k) {
      robot_.set_configuration(q + kStep * Vector::Unit(q.size(), k));
      const std::vector<double> ahead = all_distances(task, 1.0);
      robot_.set_configuration(q - kStep * Vector::Unit(q.size(), k));
      const std::vector<double> behind = all_distances(task, 1.0);
      for (Index row = 0; row < task.rows(); ++row) {
        // deep inside each other MuJoCo's nearest points are those of another face
        if (task.pair(row) < 0 || task.error()[row] < 0.01) continue;
        const auto pair = static_cast<std::size_t>(task.pair(row));
        const double wanted = (ahead[pair] - behind[pair]) / (2.0 * kStep);
        EXPECT_NEAR(task.jacobian()(row, k), wanted, 5e-3) << i << " " << row;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 500);
}

TEST_F(Distances, AnObstacleIsWhereItIsSaidToBeAndComes) {
  DistanceTask task("ball", robot_, {.pairs = {{"l_hand", "ball"}}, .most = 0.9});
  EXPECT_EQ(task.error()[0], 0.9);
  BodyMotion motion;
  motion.pose.p = {1.35, 0.3, 0.8};
  motion.linear = {-0.2, 0.0, 0.0};
  task.set_obstacle(robot_, "ball", motion);
  task.update(robot_);
  EXPECT_NEAR(task.error()[0], 1.35 - 0.1 - 1.0, 1e-9);  // the hand ends at 0.45 + 0.4 + 0.15
  EXPECT_NEAR(task.velocity_des()[0], 0.2, 1e-6);        // so fast must it be led away to stay off
  std::vector<double> state;
  StateWriter writer(state);
  task.save(writer);
  task.clear_obstacles();
  task.update(robot_);
  EXPECT_EQ(task.error()[0], 0.9);
  StateReader reader(state);
  task.restore(reader);
  EXPECT_TRUE(reader.at_end());
  task.update(robot_);
  EXPECT_NEAR(task.error()[0], 0.25, 1e-9);
  EXPECT_TRUE(
      contains(error_text([&] { task.set_obstacle(robot_, "l_hand", {}); }), "coordinates"));
  EXPECT_TRUE(contains(error_text([&] { task.set_obstacle(robot_, "right", {}); }), "in no pair"));
}

TEST_F(Distances, WhatIsSaidOfAnObstacleCountsMoreThanWhatIsSeen) {
  DistanceTask task = obstacles(robot_, {"ball"}, {.most = 0.9});
  const int ball = robot_.frame("ball").id;
  EXPECT_EQ(task.loose_bodies(robot_), std::vector<int>{ball});  // neither floor nor arms
  EXPECT_FALSE(task.obstacle(ball).has_value());
  const auto at = [](double x) {
    BodyMotion motion;
    motion.pose.p = {x, 0.3, 0.8};
    return motion;
  };
  const auto place = [&] { return task.obstacle(ball).value().pose.p.x(); };
  task.see_obstacle(ball, at(1.5));
  EXPECT_EQ(place(), 1.5);
  task.set_obstacle(robot_, "ball", at(1.4));
  task.see_obstacle(ball, at(1.6));
  EXPECT_EQ(place(), 1.4);
  std::vector<double> state;
  StateWriter writer(state);
  task.save(writer);
  task.clear_obstacles();
  task.see_obstacle(ball, at(1.6));
  EXPECT_EQ(place(), 1.6);
  StateReader reader(state);
  task.restore(reader);
  task.see_obstacle(ball, at(1.6));
  EXPECT_EQ(place(), 1.4);
}

TEST_F(Distances, ATickAllocatesNothingAndASnapshotGoesOnBitForBit) {
  DistanceTask task = self_collision(robot_, {.most = 0.4, .rows = 3});
  RandomMotion random(6);
  const auto go = [&](RandomMotion& motion) {
    Vector seen = Vector::Zero(3);
    for (int i = 0; i < 20; ++i) {
      robot_.set_configuration(motion.configuration(robot_));
      const NoAllocation guard;
      task.update(robot_);
      EXPECT_EQ(guard.count(), 0U);
      seen += task.error();
    }
    return seen;
  };
  (void)go(random);
  std::vector<double> state;
  StateWriter writer(state);
  task.save(writer);
  RandomMotion one(7), two(7);
  const Vector first = go(one);
  const std::unique_ptr<Task> copy = task.clone();
  StateReader reader(state);
  task.restore(reader);
  EXPECT_EQ(go(two), first);
  EXPECT_EQ(task.error(), copy->error());
}

TEST_F(Distances, WrongNumbersAreErrors) {
  EXPECT_TRUE(
      contains(error_text([&] { (void)self_collision(robot_, {.margin = 0.2}); }), "margin"));
  EXPECT_TRUE(contains(error_text([&] { (void)self_collision(robot_, {.rows = 0}); }), "rows"));
  EXPECT_TRUE(
      contains(error_text([&] { (void)self_collision(robot_, {.postures = 0}); }), "postures"));
  EXPECT_TRUE(contains(error_text([&] { (void)obstacles(robot_, {"bal"}); }), "'bal'"));
  EXPECT_TRUE(
      contains(error_text([&] { (void)obstacles(robot_, {"left"}); }), "part of the robot"));
  EXPECT_TRUE(contains(
      error_text([&] { DistanceTask("d", robot_, {.pairs = {{"l1", "nobody"}}}); }), "nobody"));
}

// a plate over a floor, tilted to each of its corners in turn
TEST(FlatFaces, KeepTheCornersThatWereNearest) {
  Robot robot(load_model_text(R"(<mujoco><worldbody>
      <geom name="floor" type="plane" size="1 1 1"/>
      <body><joint name="z" type="slide" axis="0 0 1"/><joint name="x" axis="1 0 0"/>
        <joint name="y" axis="0 1 0"/><geom name="plate" type="box" size="0.05 0.05 0.01"/></body>
      </worldbody></mujoco>)"),
              {"z", "x", "y"});
  robot.set_configuration(Vector3(0.05, 0.03, 0.04));
  DistanceTask task("floor", robot, {.pairs = {{"plate", "floor"}}, .margin = 0.01, .most = 0.3});
  ASSERT_EQ(task.rows(), 4);
  // heights of the lower four corners, sorted; tilts are about x, then about the turned y
  const auto heights = [](const Vector3& q) {
    std::vector<double> found;
    for (const double x : {-0.05, 0.05})
      for (const double y : {-0.05, 0.05})
        found.push_back(q[0] + std::sin(q[1]) * y +
                        std::cos(q[1]) * (-std::sin(q[2]) * x - std::cos(q[2]) * 0.01));
    std::sort(found.begin(), found.end());
    return found;
  };
  const auto rows = [&] {
    std::vector<double> found;
    for (Index row = 0; row < 4; ++row)
      if (task.pair(row) >= 0) found.push_back(task.error()[row]);
    std::sort(found.begin(), found.end());
    return found;
  };
  Vector3 q;
  std::size_t seen = 0;
  for (const auto& [x, y] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}, {1, 1}}) {
    q = Vector3(0.05, 0.03 * x, 0.04 * y);
    robot.set_configuration(q);
    task.update(robot);
    const std::vector<double> found = rows();
    EXPECT_EQ(found.size(), std::min<std::size_t>(++seen, 4));
    EXPECT_NEAR(found.front(), heights(q).front(), 1e-9);
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(rows()[i], heights(q)[i], 1e-9);

  // each row says how its corner moves
  const Matrix J = task.jacobian();
  const Vector e = task.error();
  const Vector3 move(-1e-6, 2e-6, -1e-6);
  robot.set_configuration(q + move);
  task.update(robot);
  for (Index row = 0; row < 4; ++row)
    EXPECT_NEAR(task.error()[row] - e[row], J.row(row) * move, 1e-10);

  // a snapshot holds them
  std::vector<double> state;
  StateWriter writer(state);
  task.save(writer);
  const std::vector<double> before = rows();
  robot.set_configuration(Vector3(1.0, 0.0, 0.0));
  task.update(robot);
  EXPECT_TRUE(rows().empty());
  robot.set_configuration(q + move);
  StateReader reader(state);
  task.restore(reader);
  task.update(robot);
  EXPECT_EQ(rows(), before);

  // what has turned away is no support any more
  robot.set_configuration(Vector3(0.05, 0.6, 0.0));
  task.update(robot);
  for (Index row = 0; row < 4; ++row) {
    if (task.pair(row) < 0) continue;
    EXPECT_LT(task.error()[row], rows().front() + 0.02);
  }
}

TEST(SelfCollision, ARobotWithoutPairsHasATaskThatAsksForNothing) {
  const Robot robot(load_model_text(R"(<mujoco><worldbody><body>
      <joint name="j"/><geom size="0.1"/></body></worldbody></mujoco>)"));
  const DistanceTask task = self_collision(robot);
  EXPECT_EQ(task.rows(), 1);
  EXPECT_EQ(task.jacobian().norm(), 0.0);
  EXPECT_GT(task.error()[0], task.lower()[0]);
}

}  // namespace

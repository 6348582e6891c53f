// Strategy: a hand held still stands for a robot that is blocked; what its target does meanwhile and
// afterwards follows from the shares and rates alone.
#include "hurcules/control/yielding_targets.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "hurcules/tasks/gaze_task.hpp"
#include "hurcules/tasks/pose_task.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kRate = 4.0, kDt = 1e-3;

class BlockedHand : public testing::Test {
 protected:
  BlockedHand() {
    hand_.set_target(wanted_);
    yielding_.forget();
  }
  void run(bool slowed, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kDt); ++i) {
      hand_.update(robot_);
      yielding_.update(slowed, kRate, kDt);
    }
    hand_.update(robot_);
  }

  Robot robot_{load_model_text(kTwin)};
  PositionTask hand_{"hand", robot_, "hand_l"};
  Vector value_ = hand_.value();
  Vector wanted_ = value_ + Vector3(0.3, 0.0, -0.1);
  YieldingTargets yielding_{{&hand_}};
};

TEST_F(BlockedHand, ATargetGoesToTheRobotAsFastAsTheLawAndComesBack) {
  run(true, 0.5);
  const double left = std::pow(1.0 - kRate * kDt, 500);  // of the way
  EXPECT_TRUE(near(hand_.target(), value_ + left * (wanted_ - value_), 1e-12));
  run(false, 0.45);  // it waits
  EXPECT_TRUE(near(hand_.target(), value_ + left * (wanted_ - value_), 1e-12));
  run(false, 10.0);
  EXPECT_TRUE(near(hand_.target(), wanted_, 1e-12));
  EXPECT_TRUE(hand_.velocity_des().isZero(0.0));
}

TEST_F(BlockedHand, WhatSomebodyMovesStaysThere) {
  run(true, 0.5);
  run(false, 1.0);
  const Vector elsewhere = value_ + Vector3(0.0, 0.2, 0.0);
  hand_.set_target(elsewhere);
  run(false, 5.0);
  EXPECT_EQ(hand_.target(), elsewhere);
}

TEST_F(BlockedHand, ATargetThatIsLedGivesWayAndStays) {
  hand_.advance(Vector3(0.1, 0.0, 0.0), kDt);
  run(true, 0.5);
  const Vector there = hand_.target();
  EXPECT_LT((there - value_).norm(), (wanted_ - value_).norm());
  hand_.advance(Vector3::Zero(), kDt);
  run(false, 5.0);
  EXPECT_EQ(hand_.target(), there);
}

TEST_F(BlockedHand, GoesOnWithTheSameBitsFromAState) {
  run(true, 0.5);
  run(false, 0.8);
  std::vector<double> state;
  StateWriter writer(state);
  hand_.save(writer);
  yielding_.save(writer);
  run(false, 0.5);
  const Vector there = hand_.target();
  run(false, 0.5);
  StateReader reader(state);
  hand_.restore(reader);
  yielding_.restore(reader);
  run(false, 0.5);
  EXPECT_EQ(hand_.target(), there);
}

TEST(YieldingTargets, OfAPoseThePositionOfAGazeThePoint) {
  Robot robot(load_model_text(kTwin));
  PoseTask hand("hand", robot, "hand_l");
  GazeTask gaze("gaze", robot, "hand_r");
  const Matrix3 turned = hand.orientation() * Eigen::AngleAxisd(0.4, Vector3::UnitY()).matrix();
  const Vector3 place = hand.position() + Vector3(0.2, 0.0, 0.0);
  const Vector3 seen = gaze.target() + Vector3(0.0, 0.3, 0.2);
  hand.set_target(place, turned);
  gaze.set_target(seen);
  YieldingTargets yielding({&hand, &gaze});
  const auto run = [&](bool slowed, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      hand.update(robot);
      gaze.update(robot);
      yielding.update(slowed, kRate, kDt);
    }
  };
  run(true, 500);
  EXPECT_LT((hand.target_position() - hand.position()).norm(), 0.03);
  EXPECT_EQ(hand.target_orientation(), turned);
  EXPECT_GT((gaze.target() - seen).norm(), 0.05);
  run(false, 10'000);
  EXPECT_TRUE(near(hand.target_position(), place, 1e-12));
  EXPECT_TRUE(near(gaze.target(), seen, 1e-12));
}

}  // namespace

// Strategy: an arm of two links in a plane whose hand is wanted where the first link cannot pass. By
// hand the hand is in reach of another posture; the controller ends at a limit, the search finds the
// posture (its place checked against the sines), the detour leads there and the hand arrives.
#include "hurcules/control/detour.hpp"

#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/control/tasks.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// the first link turns by 2.6 rad to either side, the second by 2.5
constexpr const char* kTwoLinks = R"(<mujoco><compiler angle="radian"/><worldbody>
<body><joint name="shoulder" axis="0 0 1" range="-2.6 2.6"/>
<geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03"/>
<body pos="0.5 0 0"><joint name="elbow" axis="0 0 1" range="-2.5 2.5"/>
<geom type="capsule" fromto="0 0 0 0.45 0 0" size="0.03"/><site name="hand" pos="0.5 0 0"/></body>
</body></worldbody><actuator><motor joint="shoulder"/><motor joint="elbow"/></actuator></mujoco>)";
constexpr double kTick = 0.005, kInfinity = std::numeric_limits<double>::infinity();

Vector3 hand_at(double shoulder, double elbow) {
  return {0.5 * std::cos(shoulder) + 0.5 * std::cos(shoulder + elbow),
          0.5 * std::sin(shoulder) + 0.5 * std::sin(shoulder + elbow), 0.0};
}

class DetourOfAnArm : public testing::Test {
 protected:
  DetourOfAnArm() {
    robot_.set_configuration(Eigen::Vector2d(2.5, 0.1));
    hand_.hold(robot_);
    hand_.set_target(hand_at(-2.4, -0.2));
  }
  // what was decided, in so many seconds
  std::vector<std::string> run(Detour& detour, double seconds) {
    std::vector<std::string> decisions;
    for (int i = 0; i < std::lround(seconds / kTick); ++i) {
      controller_.step(robot_);
      if (detour.look(robot_, controller_.velocity(), kTick))
        controller_.set_stack(detour.on_the_way() ? detour.way() : detour.direct());
      if (!detour.decision().empty()) decisions.push_back(detour.decision());
    }
    return decisions;
  }

  Robot robot_{load_model_text(kTwoLinks)};
  PositionTask hand_{"hand", robot_, "hand"};
  VelocityController controller_{robot_, {.dt = kTick}};
};

// 0.3 m beyond an arm of 1 m, where the first link cannot turn on to
TEST_F(DetourOfAnArm, GoesWhereAHandOutOfReachIsNearerAndThenRests) {
  hand_.set_target(1.3 * hand_at(-2.5, 0.0));
  Detour detour(robot_, {}, {hand_});
  controller_.set_stack(detour.direct());
  const std::vector<std::string> decisions = run(detour, 60.0);
  ASSERT_EQ(decisions.size(), 2);
  EXPECT_NE(decisions.front().find("goes round by another posture, nearer by "), std::string::npos);
  EXPECT_NEAR((robot_.position(robot_.frame("hand")) - 1.3 * hand_at(-2.5, 0.0)).norm(), 0.3, 1e-3);
  EXPECT_LT(controller_.velocity().norm(), 1e-3);
}

TEST_F(DetourOfAnArm, StaysWhereNearerIsNotWanted) {
  hand_.set_target(1.3 * hand_at(-2.5, 0.0));
  Detour detour(robot_, {}, {hand_}, {}, {.nearer = kInfinity});
  controller_.set_stack(detour.direct());
  const std::vector<std::string> decisions = run(detour, 60.0);
  ASSERT_EQ(decisions.size(), 1);
  EXPECT_TRUE(decisions.front().ends_with("descents finds a posture for all targets"));
}

TEST_F(DetourOfAnArm, ASearchFindsTheOtherPostureAndLeavesTheRobot) {
  const Vector before = robot_.configuration();
  const Posture found = inverse_kinematics(robot_, Stack({StackLevel(hand_)}));
  EXPECT_TRUE(found.reached);
  EXPECT_LE(found.error, 1e-4);
  EXPECT_GE(found.reaching, 1);
  const Vector& q = found.configuration;
  EXPECT_NEAR((hand_at(q[0], q[1]) - hand_at(-2.4, -0.2)).norm(), 0.0, 2e-4);
  EXPECT_LT(q.cwiseAbs()[0], 2.6 + 1e-12);
  EXPECT_EQ(robot_.configuration(), before);
  const Posture again = inverse_kinematics(robot_, Stack({StackLevel(hand_)}));
  EXPECT_EQ(again.configuration, found.configuration);
}

TEST_F(DetourOfAnArm, ASearchInStepsIsTheSameAndFollowsTheTarget) {
  const Stack stack({StackLevel(hand_)});
  PostureSearch search(robot_, stack);
  EXPECT_THROW(static_cast<void>(search.best()), Error);
  while (search.advance(7)) {
  }
  EXPECT_EQ(search.best().configuration, inverse_kinematics(robot_, stack).configuration);
  hand_.set_target(hand_at(2.0, 0.5));
  search.begin(robot_);
  while (search.advance(7)) {
  }
  EXPECT_EQ(search.best().starts, 1);
  const Vector q = search.best().configuration;
  EXPECT_NEAR((hand_at(q[0], q[1]) - hand_at(2.0, 0.5)).norm(), 0.0, 2e-4);
}

TEST_F(DetourOfAnArm, TheHandArrivesByAnotherPosture) {
  controller_.set_stack(Stack({StackLevel(hand_)}));
  for (int i = 0; i < 2000; ++i) controller_.step(robot_);
  hand_.update(robot_);
  EXPECT_GT(hand_.error().norm(), 0.05);  // by itself it rests here

  Detour detour(robot_, {}, {StackLevel(hand_)});
  controller_.set_stack(detour.direct());
  const std::vector<std::string> decisions = run(detour, 15.0);
  ASSERT_EQ(decisions.size(), 2U);
  EXPECT_EQ(decisions[0], "hand: 0.43 m short; goes round by another posture");
  EXPECT_EQ(decisions[1], "the posture is reached; the targets rule again");
  hand_.update(robot_);
  EXPECT_LT(hand_.error().norm(), 1e-4);
}

TEST_F(DetourOfAnArm, OutOfReachItSearchesOnce) {
  hand_.set_target(Vector3(0.0, 1.4, 0.0));
  Detour detour(robot_, {}, {StackLevel(hand_)}, {}, {.search = {.starts = 4}});
  controller_.set_stack(detour.direct());
  const std::vector<std::string> decisions = run(detour, 20.0);
  ASSERT_EQ(decisions.size(), 1U);
  EXPECT_EQ(
      decisions[0],
      "hand: 0.4 m short; none of 4 descents finds a posture for all targets, or a nearer one");
  EXPECT_LT(controller_.velocity().norm(), 1e-3);
}

TEST_F(DetourOfAnArm, WhatIsNoneIsRefused) {
  EXPECT_TRUE(
      contains(error_text([&] { Detour(robot_, {StackLevel(hand_)}, {}); }), "at least one task"));
  EXPECT_TRUE(contains(
      error_text([&] { Detour(robot_, {StackLevel(hand_)}, {StackLevel(hand_)}); }), "twice"));
  EXPECT_TRUE(contains(
      error_text([&] { Detour(robot_, {}, {StackLevel(hand_)}, {}, {.rate = 0.0}); }), "rate"));
  EXPECT_TRUE(contains(
      error_text([&] { Detour(robot_, {}, {StackLevel(hand_)}, {}, {.tolerance = -1.0}); }),
      "tolerance"));
  Detour detour(robot_, {}, {StackLevel(hand_)});
  EXPECT_TRUE(contains(error_text([&] { detour.look(robot_, Vector::Zero(3), kTick); }),
                       "2 finite numbers, got 3"));
}

}  // namespace

// Strategy: the text and the shape of stacks written with the operators, and what is refused.
#include "hurcules/control/stack.hpp"

#include "hurcules/control/tasks.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class Stacks : public testing::Test {
 protected:
  Robot robot_{load_model_text(kArm)};
  JointLimits joint_{"joint", robot_};
  PositionTask hand_{"hand", robot_, "tip"};
  GazeTask gaze_{"gaze", robot_, "eye"};
  PostureTask posture_{"posture", robot_};
};

TEST_F(Stacks, ReadAsTheThesisWritesThem) {
  const Stack stack = joint_ < hand_ < gaze_ < posture_;
  EXPECT_EQ(stack.text(), "joint < hand < gaze < posture");
  ASSERT_EQ(stack.levels().size(), 4U);
  EXPECT_EQ(stack.levels()[2].tasks.front(), &gaze_);
}

TEST_F(Stacks, APlusPutsTasksOnOneLevel) {
  const Stack stack = joint_ < hand_ + gaze_ < posture_;
  EXPECT_EQ(stack.text(), "joint < hand + gaze < posture");
  EXPECT_EQ(stack.levels()[1].tasks, (std::vector<Task*>{&hand_, &gaze_}));
}

TEST_F(Stacks, LevelsHaveTheThesisRegularisationUnlessTheySayOtherwise) {
  const StackLevel own("own", {&gaze_}, 0.02);
  const Stack stack = joint_ < StackLevel(hand_) < own;
  EXPECT_EQ(stack.levels()[1].rho, 0.1);
  EXPECT_EQ(stack.levels()[2].rho, 0.02);
}

TEST_F(Stacks, RefuseATaskThatStandsTwice) {
  const std::string text = error_text([&] { (void)(joint_ < hand_ < joint_); });
  EXPECT_TRUE(contains(text, "'joint' stands twice")) << text;
}

TEST_F(Stacks, WantLimitsFirstAndAlone) {
  JointLimits other("other", robot_);
  EXPECT_EQ((joint_ < hand_).levels()[0].limits, &joint_);
  EXPECT_TRUE(contains(error_text([&] { (void)(hand_ < joint_); }), "come first in a stack"));
  EXPECT_TRUE(contains(error_text([&] { (void)(joint_ < other); }), "at most one level"));
  EXPECT_TRUE(contains(error_text([&] { (void)(StackLevel(joint_) + hand_); }), "alone"));
}

TEST_F(Stacks, RefuseLevelsWithoutTasksAndBadRegularisation) {
  EXPECT_TRUE(contains(error_text([] { StackLevel("empty", {}); }), "at least one task"));
  EXPECT_TRUE(contains(error_text([&] { StackLevel("bad", {&hand_}, -1.0); }), "rho"));
  EXPECT_TRUE(contains(error_text([] { StackLevel("null", {nullptr}); }), "null"));
}

TEST_F(Stacks, RefuseToJoinLevelsOfDifferentRegularisation) {
  const StackLevel soft("soft", {&hand_}, 0.5);
  EXPECT_TRUE(contains(error_text([&] { (void)(soft + gaze_); }), "different rho"));
}

}  // namespace

// Strategy: an arm of two joints whose every case can be drawn on paper: within reach nothing is
// said; out of reach, at a limit, behind another task, the words and the lengths of the diagnostics; the
// singular value of its stretched posture.
#include "hurcules/control/level_diagnostics.hpp"

#include <cmath>

#include "hurcules/control/tasks.hpp"
#include "hurcules/control/velocity_controller.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// upper and lower arm of 0.5 m in a plane
constexpr const char* kElbow = R"(
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="upper">
      <joint name="SH" axis="0 0 1" range="-1 1" limited="true"/><geom size="0.1" mass="1"/>
      <body name="lower" pos="0.5 0 0">
        <joint name="EL" axis="0 0 1" range="-2.5 2.5" limited="true"/><geom size="0.1" mass="1"/>
        <site name="tip" pos="0.5 0 0"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="SH"/><motor joint="EL"/></actuator>
</mujoco>)";

class Notes : public testing::Test {
 protected:
  Notes() {
    robot_.set_configuration(Vector{{0.6, 0.9}});
    for (Task* task : std::initializer_list<Task*>{&hand_, &posture_}) task->hold(robot_);
  }
  std::vector<LevelDiagnostics> settle(const Stack& stack, int ticks = 6000) {
    controller_.set_stack(stack);
    for (int i = 0; i < ticks; ++i) {
      controller_.compute(robot_);
      Vector q = robot_.configuration();
      controller_.integrate(q);
      robot_.set_configuration(q);
    }
    return controller_.diagnostics(robot_);
  }
  static PositionTaskOptions plane() {
    PositionTaskOptions options;
    options.axes = Matrix3::Identity().topRows(2);
    return options;
  }

  Robot robot_{load_model_text(kElbow)};
  JointLimits limits_{"limits", robot_};
  PositionTask hand_{"left hand", robot_, "tip", plane()};
  PostureTask posture_{"posture", robot_};
  VelocityController controller_{robot_, {.enforce_limits = false}};
};

TEST_F(Notes, SayNothingWhereAllIsWell) {
  hand_.set_target(Vector{{0.5, 0.5}});
  const std::vector<LevelDiagnostics> diagnostics = settle(limits_ < hand_);
  ASSERT_EQ(diagnostics.size(), 2U);
  EXPECT_TRUE(diagnostics[0].shortfalls.empty());
  EXPECT_TRUE(diagnostics[1].shortfalls.empty());
}

TEST_F(Notes, NameTheLimitThatHoldsATaskBack) {
  // the tip on the y axis, 0.8 m away, wants the shoulder at pi/2 - acos(0.8) = 0.93 or 2.2:
  // within; at 0.5 m behind it wants 1.5 or more: the shoulder stops at 1
  hand_.set_target(Vector{{-0.3, 0.8}});
  const std::vector<LevelDiagnostics> diagnostics = settle(limits_ < hand_);
  ASSERT_EQ(diagnostics[1].shortfalls.size(), 1U);
  const Shortfall& left = diagnostics[1].shortfalls[0];
  EXPECT_EQ(left.held_by, std::vector<std::string>{"SH upper limit"}) << left.text();
  EXPECT_TRUE(contains(left.text(), "left hand: ")) << left.text();
  EXPECT_TRUE(contains(left.text(), " m short, held by SH upper limit")) << left.text();
  // the best tip: from the elbow at (0.5 cos 1, 0.5 sin 1) 0.5 m towards the target
  const double distance = std::hypot(-0.3 - 0.5 * std::cos(1.0), 0.8 - 0.5 * std::sin(1.0));
  EXPECT_NEAR(left.short_by, std::abs(distance - 0.5), 2e-3);
}

TEST_F(Notes, NameTheTaskAboveThatTakesTheDirections) {
  hand_.set_target(Vector{{0.5, 0.5}});
  const std::vector<LevelDiagnostics> diagnostics = settle(limits_ < hand_ < posture_);
  ASSERT_EQ(diagnostics[2].shortfalls.size(), 1U);
  EXPECT_EQ(diagnostics[2].shortfalls[0].held_by,
            std::vector<std::string>{"tasks above (left hand)"});
  EXPECT_TRUE(
      contains(diagnostics[2].shortfalls[0].text(), " rad short, held by tasks above (left hand)"));
}

TEST_F(Notes, GiveNoUnitToWhatHasNoneOfItsOwn) {
  ManipulabilityTask wide("wide", robot_, "tip", {.axes = plane().axes});
  wide.set_target(Vector{{1.0}});  // 0.25 m^2 at most
  const LevelDiagnostics note = settle(limits_ < wide)[1];
  ASSERT_EQ(note.shortfalls.size(), 1U);
  EXPECT_EQ(note.shortfalls[0].unit, "");
  EXPECT_TRUE(contains(note.shortfalls[0].text(), "wide: 0.75")) << note.shortfalls[0].text();
  EXPECT_FALSE(contains(note.shortfalls[0].text(), "  ")) << note.shortfalls[0].text();
}

TEST_F(Notes, TellHowNearTheStretchedArmIsToSingularity) {
  const double before = settle(Stack({hand_}), 1)[0].smallest_singular_value;
  hand_.set_target(Vector{{1.2, 0.0}});  // beyond its 1 m
  const LevelDiagnostics note = settle(Stack({hand_}), 20000)[0];
  // at (0.6, 0.9): product 0.25 sin 0.9, sum of squares 0.75 + 0.5 cos 0.9
  EXPECT_NEAR(before, 0.1936, 1e-3);
  EXPECT_LT(note.smallest_singular_value, 0.06);
  EXPECT_LT(note.manipulability, 0.06);
  ASSERT_EQ(note.shortfalls.size(), 1U);
  EXPECT_NEAR(note.shortfalls[0].short_by, 0.2, 0.02);
  EXPECT_EQ(note.shortfalls[0].held_by, std::vector<std::string>{"a singular posture"});
}

}  // namespace

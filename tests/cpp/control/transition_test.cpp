// Strategy: stacks changed while the seven-joint arm moves, at random and by name: a task added,
// removed, reordered. No change of joint speed above what max_acceleration allows, with limits or
// without; limits kept; the new stack alone rules in the end.
#include <cmath>

#include "hurcules/control/tasks.hpp"
#include "hurcules/control/velocity_controller.hpp"
#include "support/expect.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class Transition : public testing::Test {
 protected:
  Transition() {
    robot_.set_keyframe("home");
    for (Task* task : std::initializer_list<Task*>{&hand_, &gaze_, &posture_}) task->hold(robot_);
  }
  void tick(VelocityController& controller) {
    const Vector before = controller.velocity();
    controller.compute(robot_);
    jump_ = std::max(jump_, (controller.velocity() - before).cwiseAbs().maxCoeff());
    Vector q = robot_.configuration();
    controller.integrate(q);
    robot_.set_configuration(q);
  }
  // largest change of speed over a second after `next` takes over from the hand in motion
  double jump_to(const Stack& next, double transition) {
    // a law that does not jump without an acceleration limit
    VelocityController controller(robot_, {.max_acceleration = INFINITY,
                                           .transition = transition,
                                           .law = Law::Thesis,
                                           .solver = {.handover = Handover::Smooth}});
    robot_.set_keyframe("home");
    for (Task* task : std::initializer_list<Task*>{&hand_, &gaze_, &posture_}) task->hold(robot_);
    controller.set_stack(hand_ < posture_);
    for (int i = 0; i < 500; ++i) {
      hand_.advance(Vector3(0.2, 0.1, -0.1), 1e-3);
      tick(controller);
    }
    controller.set_stack(next);
    jump_ = 0.0;
    for (int i = 0; i < 1000; ++i) tick(controller);
    return jump_;
  }

  Robot robot_{load_model_text(kArm)};
  JointLimits joint_{"joint", robot_};
  PositionTask hand_{"hand", robot_, "tip"};
  GazeTask gaze_{"gaze", robot_, "eye"};
  PostureTask posture_{"posture", robot_};
  double jump_ = 0.0;
};

TEST_F(Transition, ATaskAddedRemovedOrReorderedDoesNotJump) {
  for (const Stack& next : {hand_ < gaze_ < posture_, Stack({posture_}), posture_ < hand_,
                            gaze_ < hand_, joint_ < posture_}) {
    const double without = jump_to(next, 0.0), with = jump_to(next, 0.2);
    SCOPED_TRACE(next.text());
    // the fade alone moves 1.5 / 0.2 s of the difference, 0.75 % a tick; the rest is the motion that
    // the new stack makes by itself; 0.02 is what 20 rad/s^2 allow
    EXPECT_LT(with, std::max(0.1 * without, 0.02));
  }
  EXPECT_GT(jump_to(Stack({posture_}), 0.0), 0.1);
}

TEST_F(Transition, EndsWithTheNewStackAlone) {
  VelocityController controller(robot_), fresh(robot_);
  controller.set_stack(joint_ < hand_ < posture_);
  for (int i = 0; i < 400; ++i) {
    hand_.advance(Vector3(0.2, 0.0, 0.0), 1e-3);
    tick(controller);
  }
  controller.set_stack(joint_ < gaze_ < posture_);
  for (int i = 0; i < 250; ++i) tick(controller);
  fresh.set_stack(controller.stack());
  fresh.take_over(controller.velocity());
  VelocityController still(robot_, {.transition = 0.0});
  still.set_stack(controller.stack());
  still.take_over(controller.velocity());
  controller.compute(robot_);
  still.compute(robot_);
  EXPECT_TRUE(near(controller.velocity(), still.velocity(), 1e-9));
}

TEST_F(Transition, KeepsLimitsThroughStacksThatChangeAtRandom) {
  RandomMotion random(5);
  for (const std::string& name : robot_.coordinate_names()) joint_.set_max_velocity(name, 1.5);
  const std::vector<Stack> stacks = {joint_ < hand_ < posture_, joint_ < gaze_ < hand_,
                                     joint_ < posture_, joint_ < hand_ < gaze_ < posture_};
  VelocityController controller(robot_);
  controller.set_stack(stacks[0]);
  Vector hand(3), posture(robot_.size());
  for (int i = 0; i < 6000; ++i) {
    if (i % 70 == 0) {
      hand = random.vector(3, 2.0);
      posture = random.vector(robot_.size(), 4.0);
      controller.set_stack(stacks[static_cast<std::size_t>(random.uniform(0.0, 3.999))]);
    }
    hand_.advance(hand, 1e-3);
    posture_.advance(posture, 1e-3);
    jump_ = 0.0;
    tick(controller);
    const Vector& q = robot_.configuration();
    ASSERT_LE((q - joint_.upper()).maxCoeff(), 0.0) << "tick " << i;
    ASSERT_GE((q - joint_.lower()).minCoeff(), 0.0) << "tick " << i;
    ASSERT_LE(controller.velocity().cwiseAbs().maxCoeff(), 1.5) << "tick " << i;
    ASSERT_LE(jump_, 20.0 * 1e-3 * (1.0 + 1e-6)) << "tick " << i;
  }
}

TEST_F(Transition, ARestoredOneGoesOnWithTheSameBits) {
  VelocityController controller(robot_), other(robot_);
  controller.set_stack(joint_ < hand_ < posture_);
  hand_.set_target(hand_.target() + Vector3(0.3, 0.0, 0.1));
  for (int i = 0; i < 100; ++i) tick(controller);
  controller.set_stack(joint_ < gaze_ < posture_);
  other.set_stack(controller.stack());
  for (int i = 0; i < 50; ++i) tick(controller);
  std::vector<double> state;
  StateWriter writer(state);
  controller.save(writer);
  StateReader reader(state);
  other.restore(reader);
  EXPECT_EQ(other.compute(robot_), controller.compute(robot_));
}

}  // namespace

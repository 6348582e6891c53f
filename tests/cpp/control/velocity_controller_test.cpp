// Strategy: the rows that tasks become, written out by hand; then the seven-joint arm chased by
// random commands for thousands of ticks: limits, velocity and acceleration hold at each of them,
// nothing is allocated, a restored controller gives the same bits; an arm of two joints through a
// singularity: no jump.
#include "hurcules/control/velocity_controller.hpp"

#include <cmath>
#include <memory>

#include "hurcules/control/tasks.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class Controller : public testing::Test {
 protected:
  Controller() {
    robot_.set_keyframe("home");
    for (Task* task : std::initializer_list<Task*>{&hand_, &gaze_, &posture_}) {
      task->hold(robot_);
    }
    for (const std::string& name : robot_.coordinate_names()) joint_.set_max_velocity(name, 1.5);
    controller_.set_stack(joint_ < hand_ < gaze_ < posture_);
  }
  // one tick: q* moves by what the controller says
  void tick(VelocityController& controller) {
    controller.compute(robot_);
    Vector q = robot_.configuration();
    controller.integrate(q);
    robot_.set_configuration(q);
  }

  Robot robot_{load_model_text(kArm)};
  JointLimits joint_{"joint", robot_};
  PositionTask hand_{"hand", robot_, "tip"};
  GazeTask gaze_{"gaze", robot_, "eye"};
  PostureTask posture_{"posture", robot_};
  VelocityController controller_{robot_};
};

TEST_F(Controller, MakesOneLevelOfEachOfTheStack) {
  const Hierarchy& hierarchy = controller_.hierarchy();
  ASSERT_EQ(hierarchy.size(), 4U);
  EXPECT_TRUE(hierarchy[0].bounds);
  EXPECT_EQ(hierarchy[0].rho, 0.0);
  EXPECT_EQ(hierarchy[1].rho, 0.1);
  EXPECT_EQ(hierarchy[1].rows(), 3);
  EXPECT_EQ(hierarchy[3].A.cols(), robot_.size());
}

TEST_F(Controller, StepsTheRobotAsItsPartsDo) {
  Robot other{load_model_text(kArm)};
  other.set_configuration(robot_.configuration());
  hand_.set_target(hand_.value() + Vector3(0.3, 0.1, -0.2));
  VelocityController whole{other};
  whole.set_stack(controller_.stack());
  for (int i = 0; i < 300; ++i) {
    tick(controller_);
    EXPECT_EQ(whole.step(other), robot_.configuration());
    EXPECT_EQ(other.configuration(), robot_.configuration());
  }
}

TEST_F(Controller, AsksEqualityTasksForTheirFeedForwardMinusGainTimesError) {
  VelocityController thesis(robot_, {.law = Law::Thesis});
  thesis.set_stack(joint_ < hand_ < gaze_ < posture_);
  hand_.advance(Vector3(0.1, -0.2, 0.05), 0.1);  // the target is 100 ms ahead
  thesis.measure(robot_);
  const Vector wanted = hand_.velocity_des() - 5.0 * hand_.error();  // [T 4.3.2]
  EXPECT_GT(hand_.error().norm(), 0.01);
  EXPECT_TRUE(near(thesis.hierarchy()[1].lower, wanted, 1e-14));
  EXPECT_EQ(thesis.hierarchy()[1].lower, thesis.hierarchy()[1].upper);
  EXPECT_EQ(thesis.hierarchy()[1].A, hand_.jacobian());
}

TEST_F(Controller, AsksIntervalTasksToReachTheirNearerSide) {
  hand_.set_interval(Vector3(-0.1, -INFINITY, -0.2), Vector3(0.3, 0.2, INFINITY));
  controller_.measure(robot_);
  const Level& level = controller_.hierarchy()[1];
  EXPECT_TRUE(near(Vector3(level.lower[0], level.upper[0], level.upper[1]), Vector3(-0.5, 1.5, 1.0),
                   1e-14));
  EXPECT_LE(level.lower[1], -kInfinity);
  EXPECT_GE(level.upper[2], kInfinity);
}

TEST_F(Controller, TracksAMovingTargetWithoutLag) {
  for (int i = 0; i < 2000; ++i) {
    hand_.advance(Vector3(0.02, 0.03, -0.01), 1e-3);
    tick(controller_);
  }
  hand_.update(robot_);
  // the regularisation keeps it a little behind: rho^2 / sigma^2 of v / K
  EXPECT_LT(hand_.error().norm(), 1e-3);
  EXPECT_EQ(controller_.solution().status, SolverStatus::Solved);
}

TEST_F(Controller, NeverLeavesALimitWhateverIsCommanded) {
  RandomMotion random(7);
  const double dt = controller_.options().dt;
  Vector hand(3), gaze(2), posture(robot_.size()), last = controller_.velocity();
  for (int i = 0; i < 8000; ++i) {
    if (i % 50 == 0) {  // commands that the arm cannot follow
      hand = random.vector(3, 3.0);
      gaze = random.vector(2, 3.0);
      posture = random.vector(robot_.size(), 5.0);
    }
    hand_.advance(hand, dt);
    gaze_.advance(gaze, dt);
    posture_.advance(posture, dt);
    tick(controller_);
    const Vector& velocity = controller_.velocity();
    const Vector& q = robot_.configuration();
    ASSERT_LE((q - joint_.upper()).maxCoeff(), 0.0) << "tick " << i;
    ASSERT_GE((q - joint_.lower()).minCoeff(), 0.0) << "tick " << i;
    ASSERT_LE(velocity.cwiseAbs().maxCoeff(), 1.5) << "tick " << i;
    ASSERT_LE((velocity - last).cwiseAbs().maxCoeff(), 20.0 * dt * (1.0 + 1e-6)) << "tick " << i;
    ASSERT_NE(controller_.solution().status, SolverStatus::InvalidInput) << "tick " << i;
    last = velocity;
  }
}

TEST_F(Controller, SlowsDownBeforeALimitAndStaysThere) {
  const Index j = 3;
  Vector push = Vector::Zero(robot_.size());
  push[j] = 1.0;
  VelocityController alone(robot_);
  alone.set_stack(joint_ < posture_);
  for (int i = 0; i < 4000; ++i) {
    posture_.advance(push, 1e-3);
    const double distance = joint_.upper()[j] - robot_.configuration()[j];
    tick(alone);
    ASSERT_LE(alone.velocity()[j], distance / alone.options().horizon + 1e-12) << "tick " << i;
  }
  EXPECT_NEAR(robot_.configuration()[j], joint_.upper()[j], 1e-9);
  EXPECT_EQ(alone.active_limits()[j], 1);
  // pulled back it leaves at once
  posture_.hold(robot_);
  posture_.advance(-push, 1e-3);
  tick(alone);
  EXPECT_EQ(alone.active_limits()[j], 0);
  EXPECT_LT(alone.velocity()[j], 0.0);
}

TEST_F(Controller, GivesWayToAPushFasterThanItAcceleratesButNeverBeyondALimit) {
  const Index j = 3;
  VelocityBounds window = {Vector::Constant(robot_.size(), -kInfinity),
                           Vector::Constant(robot_.size(), kInfinity)};
  EXPECT_FALSE(controller_.scale_velocity(window));
  window.lower[j] = 0.7;  // pushed up, at once
  controller_.compute(robot_);
  EXPECT_TRUE(controller_.scale_velocity(window));
  EXPECT_EQ(controller_.velocity()[j], 0.7);
  for (int i = 0; i < 3000; ++i) {
    controller_.compute(robot_);
    controller_.scale_velocity(window);
    Vector q = robot_.configuration();
    controller_.integrate(q);
    robot_.set_configuration(q);
    ASSERT_LE(q[j], joint_.upper()[j]) << "tick " << i;
  }
  EXPECT_NEAR(robot_.configuration()[j], joint_.upper()[j], 1e-9);
}

// a robot that stops at once at what its motors lack tips over: docs/control.md, Blocked robots
TEST_F(Controller, SlowsDownWithinItsAccelerationWhereAMotorLacksTorque) {
  VelocityControllerOptions options;
  options.law = Law::Arrive;
  options.max_acceleration = 5.0;
  VelocityController arriving(robot_, options);
  arriving.set_stack(controller_.stack());
  hand_.set_target(hand_.value() + Vector3(0.3, 0, 0));
  for (int i = 0; i < 100; ++i) tick(arriving);
  const VelocityBounds still = {Vector::Zero(robot_.size()), Vector::Zero(robot_.size())};
  Vector before = arriving.velocity();
  ASSERT_GT(before.cwiseAbs().maxCoeff(), 0.05);
  const double change = options.max_acceleration * options.dt;
  int ticks = 0;
  for (; before.cwiseAbs().maxCoeff() > 0.0 && ticks < 1000; ++ticks) {
    arriving.compute(robot_);
    EXPECT_TRUE(arriving.scale_velocity(still));
    ASSERT_LE((arriving.velocity() - before).cwiseAbs().maxCoeff(), change * (1.0 + 1e-12));
    before = arriving.velocity();
    Vector q = robot_.configuration();
    arriving.integrate(q);
    robot_.set_configuration(q);
  }
  EXPECT_LT(ticks, 1000) << "it never stood";
}

TEST_F(Controller, DrivesACoordinateBackThatIsFoundOutside) {
  joint_.set_range("j4", -0.5, 1.0);  // it stands at 1.2
  for (int i = 0; i < 3000; ++i) {
    const double before = robot_.configuration()[3];
    tick(controller_);
    ASSERT_LE(before - robot_.configuration()[3], 0.2 * 1e-3 + 1e-15) << "tick " << i;
  }
  EXPECT_LE(robot_.configuration()[3], 1.0 + 1e-9);
}

TEST_F(Controller, GoesOnAtTheVelocityOfTheControllerBefore) {
  for (int i = 0; i < 200; ++i) {
    hand_.advance(Vector3(0.3, 0, 0), 1e-3);
    tick(controller_);
  }
  VelocityController next(robot_);
  next.set_stack(joint_ < posture_);
  next.take_over(controller_.velocity());
  next.compute(robot_);
  const double change = (next.velocity() - controller_.velocity()).cwiseAbs().maxCoeff();
  EXPECT_GT(controller_.velocity().cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LE(change, 20.0 * 1e-3 * (1.0 + 1e-9));
}

TEST_F(Controller, WantsAStackAndNumbersForAllCoordinates) {
  VelocityController bare(robot_);
  EXPECT_TRUE(contains(error_text([&] { bare.compute(robot_); }), "wants a stack"));
  Vector q = Vector::Zero(2);
  EXPECT_TRUE(contains(error_text([&] { controller_.integrate(q); }), "each coordinate"));
  EXPECT_TRUE(contains(error_text([&] { controller_.take_over(q); }), "take_over wants"));
}

TEST_F(Controller, AllocatesNothingInATick) {
  RandomMotion random(3);
  const Vector command = random.vector(3, 2.0);
  Vector q = robot_.configuration();
  tick(controller_);
  const NoAllocation guard;
  for (int i = 0; i < 300; ++i) {
    hand_.advance(command, 1e-3);
    controller_.compute(robot_);
    controller_.integrate(q);
    robot_.set_configuration(q);
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST_F(Controller, ARestoredOneGivesTheSameBits) {
  const auto run = [&](VelocityController& controller) {
    for (int i = 0; i < 300; ++i) {
      hand_.advance(Vector3(0.5, 0.3, -0.4), 1e-3);
      tick(controller);
    }
  };
  run(controller_);
  std::vector<double> state, task;
  StateWriter writer(state), task_writer(task);
  controller_.save(writer);
  hand_.save(task_writer);
  const Vector q = robot_.configuration();
  run(controller_);
  const Vector first = robot_.configuration();

  VelocityController other(robot_);
  other.set_stack(controller_.stack());
  StateReader reader(state), task_reader(task);
  other.restore(reader);
  hand_.restore(task_reader);
  robot_.set_configuration(q);
  run(other);
  EXPECT_EQ(robot_.configuration(), first);
}

TEST_F(Controller, RefusesOptionsThatCannotBe) {
  const auto text = [&](VelocityControllerOptions options) {
    return error_text([&] { VelocityController(robot_, options); });
  };
  EXPECT_TRUE(contains(text({.dt = 0.0}), "dt"));
  EXPECT_TRUE(contains(text({.horizon = 1e-4}), "at least one control period"));
  EXPECT_TRUE(contains(text({.max_acceleration = -1.0}), "max_acceleration"));
  EXPECT_TRUE(contains(text({.gain = NAN}), "gain"));
}

TEST_F(Controller, RefusesAStackOfAnotherRobot) {
  Robot other(load_model_text(kTwin));
  PostureTask foreign("foreign", other);
  const std::string text = error_text([&] { controller_.set_stack(joint_ < foreign); });
  EXPECT_TRUE(contains(text, "'foreign' is for 13 coordinates, the robot has 7")) << text;
}

// two hinges that turn in a plane; stretched along x, neither moves the tip along x
constexpr const char* kElbow = R"(
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="upper">
      <joint name="j1" axis="0 0 1"/><geom size="0.1" mass="1"/>
      <body name="lower" pos="0.5 0 0">
        <joint name="j2" axis="0 0 1"/><geom size="0.1" mass="1"/>
        <site name="tip" pos="0.5 0 0"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="j1"/><motor joint="j2"/></actuator>
</mujoco>)";

// largest change of qdot* a tick, while the arm is led through its stretched posture
double largest_change(const VelocityControllerOptions& options, double step) {
  Robot robot(load_model_text(kElbow));
  PositionTask along_x("x", robot, "tip", {.axes = Matrix3::Identity().topRows(1)});
  PostureTask posture("posture", robot);
  robot.set_configuration(Vector{{0.6, 0.9}});
  for (Task* task : std::initializer_list<Task*>{&along_x, &posture}) task->hold(robot);
  VelocityController controller(robot, options);
  controller.set_stack(along_x < posture);
  Vector last;
  double largest = 0.0;
  const int ticks = static_cast<int>(std::lround(0.1 / step));
  for (int i = -ticks; i <= ticks; ++i) {
    robot.set_configuration(Vector{{i * step, 0.5 * i * step}});
    const Vector& now = controller.compute(robot);
    if (last.size() > 0) largest = std::max(largest, (now - last).norm());
    last = now;
  }
  return largest;
}

TEST(ControllerAtASingularity, DoesNotJumpUnlessItIsToldTo) {
  // the direction goes over gradually: a tenth of the step, a tenth of the change
  const VelocityControllerOptions smooth{
      .enforce_limits = false, .law = Law::Thesis, .solver = {.handover = Handover::Smooth}};
  const double fine = largest_change(smooth, 1e-4), coarse = largest_change(smooth, 1e-3);
  EXPECT_LT(fine, 0.12 * coarse);
  EXPECT_LT(fine, 0.05);
  // strict, the posture gets it all at once in the one tick that is stretched
  const VelocityControllerOptions strict{.enforce_limits = false, .law = Law::Thesis};
  EXPECT_GT(largest_change(strict, 1e-4), 1.0);
  EXPECT_GT(largest_change(strict, 1e-5), 1.0);
}

}  // namespace

// Strategy: the seven-joint arm as a robot that follows exactly, its tip lowered onto a plane that
// gives way like a spring: contact entered without a jump of joint speed and with the thesis' jump
// (K12, K17), the force reached by both controllers (K04, K15), kept while the tip slides, learnt
// stiffness, stop at f_max (K13), lost sensor, same bits, no allocation. The laws themselves:
// tasks/force_law_test.cpp; servos and physics: sim/force_physics_test.cpp.
#include "hurcules/tasks/force_task.hpp"

#include <cmath>
#include <limits>

#include "hurcules/control/acceleration_controller.hpp"
#include "hurcules/control/tasks.hpp"
#include "hurcules/control/velocity_controller.hpp"
#include "support/accelerated_motion.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kPeriod = 1e-3;

ForceTaskOptions first_order(double C, double G, double blend = 0.1) {
  ForceTaskOptions options;
  options.gains.compliance = C;
  options.environment = G;
  options.blend = blend;
  return options;
}

// The arm over a plane 2 cm below its tip.
struct Press {
  explicit Press(const ForceTaskOptions& options, double stiffness = 1e4)
      : force("force", robot, "tip", options), G(stiffness) {
    robot.set_keyframe("home");
    for (Task* task : std::initializer_list<Task*>{&across, &force, &posture}) task->hold(robot);
    floor = robot.position(tip).z() - 0.02;
    velocity.set_stack(stack());
  }
  static PositionTaskOptions plane_axes() {
    PositionTaskOptions options;
    options.axes = Matrix3::Identity().topRows(2);
    return options;
  }
  [[nodiscard]] Stack stack() {
    return joint < StackLevel("hand", {&across, &force}, 0.01) < posture;
  }
  [[nodiscard]] double reading() const {
    return G * std::min(0.0, robot.position(tip).z() - floor);
  }
  // largest change of a joint speed in a tick [rad/s]
  void tick(double approach) {
    force.advance(Vector::Constant(1, approach), kPeriod);
    force.sense(robot, lost ? std::numeric_limits<double>::quiet_NaN() : reading());
    const Vector before = velocity.velocity();
    velocity.compute(robot);
    jump = std::max(jump, (velocity.velocity() - before).cwiseAbs().maxCoeff());
    Vector q = robot.configuration();
    velocity.integrate(q);
    robot.set_configuration(q);
  }
  void run(int ticks, double approach = -0.02) {
    for (int i = 0; i < ticks; ++i) tick(approach);
  }

  Robot robot{load_model_text(kArm)};
  Frame tip = robot.frame("tip");
  JointLimits joint{"joint", robot};
  PositionTask across{"across", robot, "tip", plane_axes()};
  ForceTask force;
  PostureTask posture{"posture", robot};
  VelocityController velocity{robot, {.max_acceleration = INFINITY}};
  double G, floor = 0.0, jump = 0.0;
  bool lost = false;
};

TEST(ForceTask, InTheAirItIsAPositionTask) {
  Press press(first_order(1e-3, 1e4));
  press.run(500);
  EXPECT_EQ(press.force.state(), ContactState::Free);
  EXPECT_NEAR(press.robot.position(press.tip).z(), press.floor + 0.01, 2e-4);
  EXPECT_NEAR(press.force.target()[0], press.floor + 0.01, 1e-12);
}

TEST(ForceTask, ReachesTheForceAndKeepsItWithoutError) {
  // K04, K12, K15: entered at 2.5 N, then -5 N with 1 / (C G) = 0.1 s
  Press press(first_order(1e-3, 1e4));
  press.run(3000);
  EXPECT_EQ(press.force.state(), ContactState::Contact);
  EXPECT_NEAR(press.reading(), -5.0, 1e-3);
  // and with 7 N
  press.force.set_force(-7.0);
  press.run(2000);
  EXPECT_NEAR(press.reading(), -7.0, 1e-3);
}

TEST(ForceTask, EntersContactWithoutAJumpWhereTheThesisJumps) {
  // K17 at C = 0.05: the hand comes at 0.02 m/s and is asked for -0.05 * 2.5 = -0.125 m/s at once
  Press smooth(first_order(0.05, 1e3, 0.1), 1e3), jumping(first_order(0.05, 1e3, 0.0), 1e3);
  smooth.run(900);
  jumping.run(900);
  smooth.jump = jumping.jump = 0.0;  // behind the start of the motion
  smooth.run(1500);
  jumping.run(1500);
  EXPECT_NEAR(smooth.reading(), -5.0, 0.02);
  EXPECT_NEAR(jumping.reading(), -5.0, 0.02);
  EXPECT_GT(jumping.jump, 0.1);
  EXPECT_LT(smooth.jump, 0.1 * jumping.jump);
}

TEST(ForceTask, KeepsTheForceWhileTheTipSlides) {
  Press press(first_order(1e-3, 1e4));
  press.run(3000);
  double worst = 0.0;
  const double start = press.robot.position(press.tip).x();
  for (int i = 0; i < 2000; ++i) {
    press.across.advance(Eigen::Vector2d(0.05, 0.0), kPeriod);
    press.tick(0.0);
    worst = std::max(worst, std::abs(press.reading() + 5.0));
  }
  EXPECT_GT(press.robot.position(press.tip).x() - start, 0.08);
  EXPECT_LT(worst, 0.3);
}

TEST(ForceTask, LearnsTheStiffnessAndSettlesAsFastOnSoftAndStiffGround) {
  for (const double G : {1e3, 1e4, 1e5}) {
    ForceTaskOptions options = first_order(0.1, 0.0);
    options.max_rate = 20.0;
    options.contact.f_max = 500.0;  // 20 mm/s for half of the blend on 1e5 N/m
    options.stiffness.step = 5e-6;
    options.blend = 0.02;
    Press press(options, G);
    press.run(4000, -0.01);
    EXPECT_NEAR(press.reading(), -5.0, 0.05) << G;
    EXPECT_NEAR(press.force.stiffness(), G, 0.2 * G) << G;
  }
}

// the blend leads the frame on, but no further than to the force that is wanted, 5 N, and what one
// period at the speed of approach adds to it, 5 N: a reading is one period old
TEST(ForceTask, ABlendIsNoImpactOfItsOwn) {
  Press press(first_order(3e-4, 1e5), 1e5);
  double most = 0.0;
  for (int i = 0; i < 2000; ++i) {
    press.tick(-0.05);
    most = std::max(most, -press.reading());
  }
  EXPECT_LT(most, 10.0);
  EXPECT_NEAR(press.reading(), -5.0, 0.05);
}

TEST(ForceTask, StopsAboveTheLargestForceUntilReset) {
  // K13: so fast that 1e5 N/m are pressed beyond 20 N in one period
  ForceTaskOptions options = first_order(1e-4, 1e5);
  options.contact.f_max = 20.0;
  Press press(options, 1e5);
  press.run(1000, -0.35);
  EXPECT_EQ(press.force.state(), ContactState::Stopped);
  const double force = press.reading();
  press.run(1000, -0.05);
  EXPECT_NEAR(press.reading(), force, 1.0);
  EXPECT_LT(press.velocity.velocity().cwiseAbs().maxCoeff(), 1e-3);
  // it lets itself be led away, and only away
  press.run(1000, 0.05);
  EXPECT_EQ(press.force.state(), ContactState::Stopped);
  EXPECT_EQ(press.reading(), 0.0);
  press.force.reset(press.robot);
  press.run(10, 0.0);
  EXPECT_EQ(press.force.state(), ContactState::Free);
}

TEST(ForceTask, HoldsItsPlaceWhenTheSensorIsLost) {
  Press press(first_order(1e-3, 1e4));
  press.run(2000);
  press.lost = true;
  press.run(200);
  EXPECT_EQ(press.force.state(), ContactState::SensorLost);
  const double place = press.robot.position(press.tip).z();
  press.run(1000);
  EXPECT_NEAR(press.robot.position(press.tip).z(), place, 1e-5);
  press.lost = false;
  press.run(100);
  EXPECT_EQ(press.force.state(), ContactState::SensorLost);  // until reset
}

TEST(ForceTask, KeepsAForceBelowTheOneThatMakesContact) {
  Press press(first_order(1e-3, 1e4));
  press.force.set_force(-0.8);
  press.run(2000);
  EXPECT_NEAR(press.reading(), -0.8, 0.01);
  for (int i = 0; i < 2000; ++i) {
    press.tick(-0.02);
    ASSERT_EQ(press.force.state(), ContactState::Contact) << "tick " << i;
  }
  EXPECT_NEAR(press.reading(), -0.8, 0.01);
}

// readings that change 40 times and then keep their bits while the frame moves by 5 mm
ContactState kept_after(double step) {
  ContactMonitor monitor({}, "monitor");
  for (int i = 0; i < 40; ++i) monitor.look(-5.0 - step * (i % 7), 0.0);
  ContactState state = ContactState::Free;
  for (int i = 0; i < 50; ++i) state = monitor.look(-5.0, 1e-4 * i);
  return state;
}

TEST(ForceTask, AReadingInStepsIsNoLostSensor) {
  EXPECT_EQ(kept_after(0.05), ContactState::Contact);
  EXPECT_EQ(kept_after(0.0317e-3), ContactState::SensorLost);  // noise, then the same bits
  ContactMonitor stuck({}, "stuck");
  ContactState state = ContactState::Free;
  for (int i = 0; i < 50; ++i) state = stuck.look(-5.0, 1e-4 * i);
  EXPECT_EQ(state, ContactState::SensorLost);
}

TEST(ForceTask, LeavesTheGroundByMotionAlone) {
  // [T Fig. 5.6 (i)]
  Press press(first_order(1e-3, 1e4));
  press.run(2000);
  press.force.enable(false);
  press.run(1000, 0.02);
  EXPECT_EQ(press.force.state(), ContactState::Free);
  EXPECT_NEAR(press.robot.position(press.tip).z(), press.floor + 0.02, 1e-3);
  EXPECT_LT(press.jump, 0.2);
}

// the same by accelerations
struct AccelerationPress : Press {
  AccelerationPress(const ForceTaskOptions& options, double stiffness)
      : Press(with_motion_law(options), stiffness), controller(robot) {
    // the velocity controller of Press refuses these laws: it was given them by a loop that it
    // takes
    force_law = std::make_unique<ForceTask>("force", robot, "tip", options);
    force_law->hold(robot);
    controller.set_stack(joint < StackLevel("hand", {&across, force_law.get()}, 0.01) < posture);
  }
  static ForceTaskOptions with_motion_law(ForceTaskOptions options) {
    options.gains.loop = ForceLoop::FirstOrder;
    options.environment = 0.0;
    return options;
  }
  void accelerate(int ticks, double approach) {
    Vector q(robot.size()), v(robot.size());
    for (int i = 0; i < ticks; ++i) {
      force_law->advance(Vector::Constant(1, approach), kPeriod);
      force_law->sense(robot, reading());
      controller.compute(robot);
      follow(controller, robot, q, v);
      hardest = std::max(hardest, controller.acceleration().cwiseAbs().maxCoeff());
    }
  }
  AccelerationController controller;
  std::unique_ptr<ForceTask> force_law;
  double hardest = 0.0;
};

ForceTaskOptions second_order(ForceLoop loop, double C, double N = 0.0) {
  ForceTaskOptions options;
  options.gains.loop = loop;
  options.gains.compliance = C;
  options.gains.integral = N;
  options.environment = 1e4;
  options.contact.f_max = 1000.0;
  return options;
}

TEST(ForceTask, TheVelocityLoopReachesTheForceByAccelerations) {
  // K04
  AccelerationPress press(second_order(ForceLoop::Velocity, 1e-4), 1e4);
  press.accelerate(4000, -0.02);
  EXPECT_EQ(press.force_law->state(), ContactState::Contact);
  EXPECT_NEAR(press.reading(), -5.0, 0.01);
  EXPECT_LT(press.hardest, 20.0);
}

TEST(ForceTask, ThePositionLoopStaysOffAndItsIntegralDoesNot) {
  // K02, K03, K06: the reference stops 1 mm in the ground, C G = 1
  AccelerationPress proportional(second_order(ForceLoop::Position, 1e-4), 1e4);
  AccelerationPress integral(second_order(ForceLoop::PositionIntegral, 1e-4, 5e-4), 1e4);
  for (AccelerationPress* press : {&proportional, &integral}) {
    press->accelerate(1050, -0.02);
    press->accelerate(6000, 0.0);
    EXPECT_EQ(press->force_law->state(), ContactState::Contact);
  }
  // f = (C G f_d - G r) / (1 + C G), r = 1 mm above the reference
  EXPECT_NEAR(proportional.reading(), (-5.0 - 10.0) / 2.0, 0.05);
  EXPECT_NEAR(integral.reading(), -5.0, 0.05);
}

TEST(ForceTask, TorquesCarryWhatIsRead) {
  Robot robot(load_model_text(kArm));
  robot.set_keyframe("home");
  ForceTask force("force", robot, "tip");
  AccelerationController controller(robot);
  controller.set_stack(Stack({force}));
  force.sense(robot, 0.0);
  controller.compute(robot);
  Vector without(robot.size()), with(robot.size());
  controller.torque(robot, without);
  force.sense(robot, -4.0);
  ASSERT_EQ(force.state(), ContactState::Contact);
  controller.torque(robot, with);
  // the tip presses down with 4 N
  Matrix J(3, robot.size());
  robot.position_jacobian(robot.frame("tip"), J);
  EXPECT_TRUE(near(with - without, -4.0 * J.row(2).transpose(), 1e-12));
}

TEST(ForceTask, AccelerationLawsAreNothingForAVelocityController) {
  Press press(first_order(1e-3, 1e4));
  ForceTask other("other", press.robot, "tip", second_order(ForceLoop::Velocity, 1e-4));
  const std::string text = error_text([&] { press.velocity.set_stack(press.joint < other); });
  EXPECT_TRUE(contains(text, "'other' commands accelerations")) << text;
}

TEST(ForceTask, AllocatesNothingInATick) {
  Press press(first_order(1e-3, 1e4));
  press.run(1100);
  Vector q = press.robot.configuration();
  const Vector approach = Vector::Constant(1, -0.02);
  const NoAllocation guard;
  for (int i = 0; i < 300; ++i) {
    press.force.advance(approach, kPeriod);
    press.force.sense(press.robot, press.reading());
    press.velocity.compute(press.robot);
    press.velocity.integrate(q);
    press.robot.set_configuration(q);
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST(ForceTask, AllocatesNothingWhileAnotherTaskIsOutOfReach) {
  Press press(first_order(1e-3, 1e4));
  press.across.set_target(press.across.target() + Eigen::Vector2d(1.5, 0.0));
  press.run(1100);
  const NoAllocation guard;
  for (int i = 0; i < 300; ++i) {
    press.force.sense(press.robot, press.reading());
    press.velocity.compute(press.robot);
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST(ForceTask, ReckonsWithThePeriodOfItsController) {
  Press press(first_order(1e-3, 1e4));
  VelocityController slow(press.robot, {.dt = 5e-3});
  const std::string text = error_text([&] { slow.set_stack(press.stack()); });
  EXPECT_TRUE(contains(text, "period of 0.001 s, its controller has 0.005 s")) << text;
}

TEST(ForceTask, ARestoredOneGivesTheSameBits) {
  Press press(first_order(1e-3, 0.0));
  press.run(1150);  // in the middle of the blend
  std::vector<double> state, control;
  StateWriter writer(state), control_writer(control);
  press.force.save(writer);
  press.velocity.save(control_writer);
  const Vector q = press.robot.configuration();
  press.run(500);
  const Vector first = press.robot.configuration();
  StateReader reader(state), control_reader(control);
  press.force.restore(reader);
  press.velocity.restore(control_reader);
  press.robot.set_configuration(q);
  press.run(500);
  EXPECT_EQ(press.robot.configuration(), first);
}

TEST(ForceTask, RefusesWhatCannotBe) {
  Robot robot(load_model_text(kArm));
  const auto text = [&](const ForceTaskOptions& options) {
    return error_text([&] { ForceTask("z", robot, "tip", options); });
  };
  EXPECT_TRUE(contains(text(first_order(0.05, 1e5)), "stable up to an environment of 2e+04 N/m"));
  ForceTaskOptions options = first_order(1e-3, 1e4);
  options.force_des = -200.0;
  EXPECT_TRUE(contains(text(options), "below f_max"));
  options = first_order(1e-3, 1e4);
  options.axis.setZero();
  EXPECT_TRUE(contains(text(options), "axis"));
  options = first_order(1e-3, 1e4, -1.0);
  EXPECT_TRUE(contains(text(options), "blend"));
  EXPECT_TRUE(contains(error_text([&] { ForceTask("z", robot, "tpi"); }), "'tpi' does not exist"));
}

}  // namespace

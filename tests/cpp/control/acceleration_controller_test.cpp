// Strategy: the rows that tasks become, written out by hand; the seven-joint arm chased by random
// commands for thousands of ticks: limits hold at each of them (R26), nothing is allocated, a
// restored controller gives the same bits; the velocity controller as its limit of high damping;
// torque bounds against the inverse dynamics; an arm that reaches beyond its length (K08).
#include "hurcules/control/acceleration_controller.hpp"

#include <cmath>

#include "hurcules/control/tasks.hpp"
#include "hurcules/control/velocity_controller.hpp"
#include "support/accelerated_motion.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class Acceleration : public testing::Test {
 protected:
  Acceleration() {
    robot_.set_keyframe("home");
    for (Task* task : std::initializer_list<Task*>{&hand_, &gaze_, &posture_}) {
      task->hold(robot_);
    }
    for (const std::string& name : robot_.coordinate_names()) joint_.set_max_velocity(name, 1.5);
    controller_.set_stack(joint_ < hand_ < gaze_ < posture_);
  }
  // one tick: q* and qdot* move by what the controller says
  void tick(AccelerationController& controller) {
    controller.compute(robot_);
    follow(controller, robot_, q_, v_);
  }

  Robot robot_{load_model_text(kArm)};
  JointLimits joint_{"joint", robot_};
  PositionTask hand_{"hand", robot_, "tip"};
  GazeTask gaze_{"gaze", robot_, "eye"};
  PostureTask posture_{"posture", robot_};
  AccelerationController controller_{robot_};
  Vector q_, v_;
};

TEST_F(Acceleration, AsksForFeedForwardDampingStiffnessAndDrift) {
  AccelerationController thesis(robot_, {.rest = 0.0, .law = Law::Thesis});
  thesis.set_stack(controller_.stack());
  RandomMotion random(1);
  robot_.set_velocity(random.vector(robot_.size(), 1.0));
  const Vector3 target = hand_.target() + Vector3(0.1, -0.05, 0.02);
  hand_.set_reference(target, Vector3(0.1, -0.2, 0.05), Vector3(1.0, 2.0, -3.0));
  thesis.measure(robot_);
  const Vector rate = hand_.jacobian() * robot_.velocity() - hand_.velocity_des();
  const Vector wanted =
      -20.0 * rate - 100.0 * hand_.error() + Vector3(1.0, 2.0, -3.0) - hand_.drift();  // [T 5.3.17]
  EXPECT_GT(hand_.drift().norm(), 1e-3);
  EXPECT_TRUE(near(thesis.hierarchy()[1].lower, wanted, 1e-12));
  EXPECT_EQ(thesis.hierarchy()[1].lower, thesis.hierarchy()[1].upper);
  EXPECT_EQ(thesis.hierarchy()[1].A, hand_.jacobian());
}

TEST_F(Acceleration, TracksATrajectoryThatIsFedForward) {
  AccelerationControllerOptions options;
  AccelerationController exact(robot_, options);
  exact.set_stack(joint_ < StackLevel("hand", {&hand_}, 0.0) < posture_);
  const Vector3 start = hand_.target();
  double worst = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double t = 1e-3 * i, a = 0.05, w = 2.0;
    const Vector3 way(a, 0.5 * a, -a);
    hand_.set_reference(start + way * (1.0 - std::cos(w * t)), way * w * std::sin(w * t),
                        way * w * w * std::cos(w * t));
    tick(exact);
    if (i > 1000) worst = std::max(worst, hand_.error().norm());
  }
  // nothing but what the trajectory's jerk moves within a tick: jerk dt / (2 K), 1.1 um
  EXPECT_LT(worst, 1e-5);
}

TEST_F(Acceleration, AnErrorVanishesAsTheGainsSay) {
  // [T 5.3.15] with K = 100, L = 20: critically damped, (1 + 10 t) exp(-10 t)
  AccelerationControllerOptions options;
  options.law = Law::Thesis;
  AccelerationController alone(robot_, options);
  alone.set_stack(Stack({StackLevel("hand", {&hand_}, 0.0)}));
  hand_.set_target(hand_.target() + Vector3(0.01, 0.02, -0.01));
  for (int i = 0; i < 200; ++i) tick(alone);
  hand_.update(robot_);
  const double expected = (1.0 + 10.0 * 0.2) * std::exp(-10.0 * 0.2);
  EXPECT_NEAR(hand_.error().norm() / std::sqrt(6e-4), expected, 5e-3);
}

TEST_F(Acceleration, BecomesVelocityControlWhereDampingIsHigh) {
  // L -> inf, K = 5 L: dg/dt = -5 g, the gain of the velocity controller
  AccelerationControllerOptions options;
  options.damping = 500.0;
  options.stiffness = 2500.0;
  options.max_acceleration = INFINITY;
  AccelerationController fast(robot_, options);
  fast.set_stack(
      Stack({StackLevel("hand", {&hand_}, 0.0), StackLevel("posture", {&posture_}, 0.0)}));
  VelocityController velocity(robot_);
  velocity.set_stack(fast.stack());
  const Vector start = robot_.configuration();
  const auto target = [&](int i) { return Vector3(0.1 * std::sin(2e-3 * i), 5e-5 * i, 0.0); };
  const Vector3 origin = hand_.target();
  std::vector<Vector> first;
  for (int i = 0; i < 1000; ++i) {
    hand_.set_target(origin + target(i));
    tick(fast);
    first.push_back(robot_.configuration());
  }
  robot_.set_configuration(start);
  double worst = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    hand_.set_target(origin + target(static_cast<int>(i)));
    velocity.compute(robot_);
    Vector q = robot_.configuration();
    velocity.integrate(q);
    robot_.set_configuration(q);
    worst = std::max(worst, (q - first[i]).cwiseAbs().maxCoeff());
  }
  EXPECT_GT((first.back() - start).norm(), 0.1);
  // behind by 1 / L = 2 ms at up to 0.5 rad/s
  EXPECT_LT(worst, 2e-3);
}

TEST_F(Acceleration, NeverLeavesALimitWhateverIsCommanded) {
  RandomMotion random(7);
  const double dt = controller_.options().dt;
  Vector hand(3), gaze(2), posture(robot_.size());
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
    ASSERT_LE((q_ - joint_.upper()).maxCoeff(), 0.0) << "tick " << i;
    ASSERT_GE((q_ - joint_.lower()).minCoeff(), 0.0) << "tick " << i;
    ASSERT_LE(v_.cwiseAbs().maxCoeff(), 1.5 + 1e-12) << "tick " << i;
    ASSERT_LE(controller_.acceleration().cwiseAbs().maxCoeff(), 20.0) << "tick " << i;
    ASSERT_NE(controller_.solution().status, SolverStatus::InvalidInput) << "tick " << i;
  }
}

TEST_F(Acceleration, KeepsTorquesWithinTheirLimits) {
  TorqueLimits torque("torque", robot_);
  EXPECT_EQ(torque.upper()[0], 50.0);  // 5 N m through a gear of 10
  const Vector limit = (Vector(7) << 50, 60, 8, 15, 2, 2, 1).finished();
  torque.set_interval(-limit, limit);
  // speeds without a bound ask for more
  AccelerationController dynamic(
      robot_, {.rest = 0.0, .law = Law::Thesis, .solver = {.handover = Handover::Smooth}});
  dynamic.set_stack(Stack({joint_, StackLevel("torque", {&torque}, 0.0), hand_, posture_}));
  RandomMotion random(11);
  Vector tau(robot_.size()), hand(3);
  int held = 0;
  double excess = 0.0, braking = 0.0;
  for (int i = 0; i < 6000; ++i) {
    if (i % 200 == 0) hand = random.vector(3, 1.5);
    hand_.advance(hand, 1e-3);
    const bool limits_first = dynamic.active_limits().cwiseAbs().sum() > 0;
    dynamic.compute(robot_);
    dynamic.torque(robot_, tau);
    ASSERT_LE((tau.cwiseAbs() - limit).maxCoeff(), 0.0) << "tick " << i;
    robot_.inverse_dynamics(dynamic.acceleration(), tau);  // what the rows alone keep
    const double over = (tau.cwiseAbs() - limit).maxCoeff();
    (limits_first || dynamic.active_limits().cwiseAbs().sum() > 0 ? braking : excess) =
        std::max(limits_first ? braking : excess, over);
    if (over > -1e-9) ++held;
    follow(dynamic, robot_, q_, v_);
    ASSERT_LE((q_ - joint_.upper()).maxCoeff(), 0.0) << "tick " << i;
    ASSERT_GE((q_ - joint_.lower()).minCoeff(), 0.0) << "tick " << i;
  }
  EXPECT_GT(held, 100);  // the limits were met
  EXPECT_LT(excess, 1e-6);
}

TEST_F(Acceleration, ArrivesBelowTorqueLimits) {
  TorqueLimits torque("torque", robot_);
  const Vector limit = (Vector(7) << 50, 60, 20, 15, 4, 4, 2).finished();
  torque.set_interval(-limit, limit);
  Vector tau(robot_.size());
  for (const bool first : {true, false}) {
    AccelerationController dynamic(robot_);
    dynamic.set_stack(first ? Stack({joint_, torque, hand_, posture_})
                            : Stack({joint_, hand_, torque, posture_}));
    hand_.set_target(hand_.target() + Vector3(0.0, 0.05, first ? 0.05 : -0.05));
    for (int i = 0; i < 4000; ++i) {
      tick(dynamic);
      robot_.inverse_dynamics(dynamic.acceleration(), tau);
      ASSERT_LE((tau.cwiseAbs() - limit).maxCoeff(), 1e-6) << "tick " << i;
    }
    hand_.update(robot_);
    EXPECT_LT(hand_.error().norm(), 1e-4);
  }
}

TEST_F(Acceleration, SpeedFadesWhereTheArmIsOutstretched) {
  // K08: the hand is led beyond its reach; speeds and accelerations stay small, and fall
  AccelerationControllerOptions options;
  options.rest = 0.0;
  options.law = Law::Thesis;
  options.solver.handover = Handover::Smooth;
  options.max_acceleration = INFINITY;  // nothing but the regularisation bounds them
  AccelerationController reach(robot_, options);
  reach.set_stack(Stack({hand_, posture_}));
  double fastest = 0.0, hardest = 0.0;
  for (int i = 0; i < 8000; ++i) {
    hand_.advance(Vector3(0.1, 0.0, 0.0), 1e-3);
    tick(reach);
    fastest = std::max(fastest, v_.cwiseAbs().maxCoeff());
    hardest = std::max(hardest, reach.acceleration().cwiseAbs().maxCoeff());
  }
  EXPECT_GT(hand_.error().norm(), 0.1);  // it is out of reach
  EXPECT_LT(fastest, 2.0);
  EXPECT_LT(hardest, 20.0);
  EXPECT_LT(v_.cwiseAbs().maxCoeff(), 0.2);
}

TEST_F(Acceleration, AllocatesNothingInATick) {
  TorqueLimits torque("torque", robot_);
  AccelerationController dynamic(robot_);
  dynamic.set_stack(Stack({joint_, StackLevel("torque", {&torque}, 0.0), hand_, posture_}));
  Vector tau(robot_.size());
  tick(dynamic);
  const Vector3 command(0.4, -0.2, 0.3);
  const NoAllocation guard;
  for (int i = 0; i < 300; ++i) {
    hand_.advance(command, 1e-3);
    dynamic.compute(robot_);
    dynamic.torque(robot_, tau);
    dynamic.integrate(q_, v_);
    robot_.set_configuration(q_);
    robot_.set_velocity(v_);
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST_F(Acceleration, ARestoredOneGivesTheSameBits) {
  const auto run = [&](AccelerationController& controller) {
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
  const Vector q = robot_.configuration(), v = robot_.velocity();
  run(controller_);
  const Vector first = robot_.configuration();

  AccelerationController other(robot_);
  other.set_stack(controller_.stack());
  StateReader reader(state), task_reader(task);
  other.restore(reader);
  hand_.restore(task_reader);
  robot_.set_configuration(q);
  robot_.set_velocity(v);
  run(other);
  EXPECT_EQ(robot_.configuration(), first);
}

TEST_F(Acceleration, RefusesOptionsThatCannotBe) {
  const auto text = [&](AccelerationControllerOptions options) {
    return error_text([&] { AccelerationController(robot_, options); });
  };
  EXPECT_TRUE(contains(text({.dt = 0.0}), "dt"));
  EXPECT_TRUE(contains(text({.stiffness = -1.0}), "stiffness"));
  EXPECT_TRUE(contains(text({.damping = 0.0}), "damping"));
  EXPECT_TRUE(contains(text({.dt = 0.05}), "too high for a control period"));
  EXPECT_TRUE(contains(text({.horizon = 1e-4}), "at least one control period"));
  EXPECT_TRUE(contains(text({.max_acceleration = -1.0}), "max_acceleration"));
  EXPECT_TRUE(contains(text({.rest = -1.0}), "rest"));
}

TEST_F(Acceleration, TorqueLimitsAreNothingForAVelocityController) {
  TorqueLimits torque("torque", robot_);
  VelocityController velocity(robot_);
  const std::string text = error_text([&] { velocity.set_stack(joint_ < torque); });
  EXPECT_TRUE(contains(text, "'torque' commands accelerations")) << text;
}

}  // namespace

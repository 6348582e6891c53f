// Strategy: what the law asks for, by hand; then arms of two and three joints in a plane that start
// straight, and are sent where they can go and where they cannot. What must hold: a place within
// reach is reached and kept, one beyond is approached as near as the geometry says, everything
// comes to rest, and no velocity changes faster than the acceleration limit. Whole robots:
// benchmarks/arrival.py.
#include <cmath>

#include "hurcules/control/acceleration_controller.hpp"
#include "hurcules/control/tasks.hpp"
#include "hurcules/control/velocity_controller.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// links of 0.5 m; straight along x at zero
constexpr const char* kPlanarArm = R"(
<mujoco>
  <compiler angle="radian"/>
  <default><joint axis="0 0 1" range="-2.5 2.5" limited="true"/><geom size="0.1" mass="1"/></default>
  <worldbody>
    <body>
      <joint name="j1"/><geom/>
      <body pos="0.5 0 0">
        <joint name="j2"/><geom/>
        <site name="elbow"/>
        <body name="forearm" pos="0.5 0 0">
          <joint name="j3"/><geom/>
          <site name="wrist"/>
          <site name="tip" pos="0.5 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>)";
using Vector2 = Eigen::Vector2d;
const Matrix kPlane = Matrix3::Identity().topRows(2);

// What a motion of some seconds was, and where it ended.
struct Motion {
  double hardest = 0.0;  // largest change of velocity over the one that is allowed
  double fastest = 0.0;  // [rad/s] in the last second
};

class Arrival : public testing::TestWithParam<double> {
 protected:
  Motion run(const Stack& stack, Law law = Law::Arrive) {
    VelocityControllerOptions options{.dt = GetParam(), .law = law};
    if (law == Law::Thesis) options.solver.handover = Handover::Smooth;
    VelocityController controller(robot_, options);
    return follow(controller, stack, [&] {
      controller.step(robot_);
      return controller.velocity();
    });
  }
  Motion accelerate(const Stack& stack) {
    AccelerationController controller(robot_, {.dt = GetParam()});
    robot_.set_velocity(Vector::Zero(robot_.size()));
    return follow(controller, stack, [&] {
      controller.compute(robot_);
      Vector q = robot_.configuration(), velocity = robot_.velocity();
      controller.integrate(q, velocity);
      robot_.set_configuration(q);
      robot_.set_velocity(velocity);
      return velocity;
    });
  }

  Robot robot_{load_model_text(kPlanarArm)};
  JointLimits limits_{"limits", robot_};
  PositionTask elbow_{"elbow", robot_, "elbow", {.axes = kPlane}};
  PositionTask wrist_{"wrist", robot_, "wrist", {.axes = kPlane}};
  PositionTask tip_{"tip", robot_, "tip", {.axes = kPlane}};
  PostureTask posture_{"posture", robot_};

 private:
  // ten seconds; `tick` moves the robot by a period and says how fast it is
  template <class Controller, class Tick>
  Motion follow(Controller& controller, const Stack& stack, const Tick& tick) {
    controller.set_stack(stack);
    const double dt = controller.options().dt, most = controller.options().max_acceleration * dt;
    const int ticks = static_cast<int>(std::lround(10.0 / dt));
    Motion motion;
    Vector last = Vector::Zero(robot_.size());
    for (int i = 0; i < ticks; ++i) {
      const Vector now = tick();
      motion.hardest = std::max(motion.hardest, (now - last).cwiseAbs().maxCoeff() / most);
      if (i > ticks * 9 / 10) motion.fastest = std::max(motion.fastest, now.cwiseAbs().maxCoeff());
      last = now;
    }
    for (Task* task : std::initializer_list<Task*>{&elbow_, &wrist_, &tip_, &posture_})
      task->update(robot_);
    return motion;
  }
};

TEST_P(Arrival, ReachesAPlaceFromTheStraightArmAndKeepsIt) {
  tip_.set_target(Vector2(0.6, 0.7));
  const Motion motion = run(limits_ < tip_ < posture_);
  EXPECT_LT(tip_.error().norm(), 1e-6);
  EXPECT_LT(motion.fastest, 0.01);
  EXPECT_LE(motion.hardest, 1.0 + 1e-9);
}

TEST_P(Arrival, ALowerLevelDoesNotHoldATwoJointArmNearlyStraight) {
  // the elbow has to bend by 0.28 rad; the posture below wants it straight
  wrist_.set_target(Vector2(0.7, 0.7));
  const auto miss = [&](Law law) {
    robot_.set_configuration(Vector::Zero(3));
    run(limits_ < wrist_ < posture_, law);
    return wrist_.error().norm();
  };
  EXPECT_LT(miss(Law::Arrive), 1e-6);
  EXPECT_GT(miss(Law::Thesis), 1e-3);
}

TEST_P(Arrival, RestsBeforeAPlaceThatIsOutOfReach) {
  robot_.set_configuration(Vector{{0.5, 0.8, 0.9}});
  tip_.set_target(Vector2(-0.4, 2.4));
  const Motion motion = run(limits_ < tip_ < posture_);
  const double best = Vector2(-0.4, 2.4).norm() - 1.5;
  EXPECT_LT(tip_.error().norm(), best + 2e-3);  // the dead zone: (0.02 S)^2 / 2 of each elbow's c
  EXPECT_LT(motion.fastest, 0.01);
  EXPECT_LE(motion.hardest, 1.0 + 1e-9);
}

TEST_P(Arrival, RestsWhereTwoLevelsWantWhatOneCanHave) {
  // the elbow arrives, the tip is left with one link of 1 m that turns about it
  const Vector2 elbow(0.3, 0.4), tip(1.5, -1.0);
  robot_.set_configuration(Vector{{0.2, 0.5, 0.6}});
  elbow_.set_target(elbow);
  tip_.set_target(tip);
  const Motion motion = run(limits_ < elbow_ < tip_ < posture_);
  EXPECT_LT(elbow_.error().norm(), 1e-6);
  EXPECT_LT(tip_.error().norm(), (tip - elbow).norm() - 1.0 + 2e-3);
  EXPECT_LT(motion.fastest, 0.01);
  EXPECT_LE(motion.hardest, 1.0 + 1e-9);
}

TEST_P(Arrival, RestsAtALimitThatHoldsIt) {
  limits_.set_range("j1", -0.3, 0.3);
  robot_.set_configuration(Vector{{0.0, 0.5, 0.5}});
  tip_.set_target(Vector2(-1.5, 1.5));
  const Motion motion = run(limits_ < tip_ < posture_);
  EXPECT_LE(robot_.configuration()[0], 0.3);
  EXPECT_LT(motion.fastest, 0.01);
  EXPECT_LE(motion.hardest, 1.0 + 1e-9);
}

TEST_P(Arrival, TheStraightArmBendsForAPlaceOnItsOwnLine) {
  tip_.set_target(Vector2(1.2, 0.0));
  const Motion motion = run(limits_ < tip_ < posture_);
  EXPECT_LT(tip_.error().norm(), 1e-6);
  EXPECT_LT(motion.fastest, 0.01);
  EXPECT_LE(motion.hardest, 1.0 + 1e-9);

  robot_.set_configuration(Vector::Zero(3));
  const Motion accelerated = accelerate(limits_ < tip_ < posture_);
  EXPECT_LT(tip_.error().norm(), 1e-6);
  EXPECT_LT(accelerated.fastest, 0.01);
  EXPECT_LE(accelerated.hardest, 1.0 + 1e-9);
}

TEST_P(Arrival, TheStraightArmStaysForAPlaceBeyondItOnItsOwnLine) {
  tip_.set_target(Vector2(1.8, 0.0));
  const Motion motion = run(limits_ < tip_ < posture_);
  EXPECT_LT(tip_.error().norm(), 0.3 + 1e-9);
  EXPECT_EQ(motion.fastest, 0.0);
}

TEST_P(Arrival, ALevelBelowLeavesItsSaddleAsFarAsTheOneAboveAllows) {
  // the elbow holds; the forearm's two links of the second level bend alone
  elbow_.set_target(Vector2(0.5, 0.0));
  tip_.set_target(Vector2(1.2, 0.0));
  const Motion motion = run(limits_ < elbow_ < tip_ < posture_);
  EXPECT_LT(elbow_.error().norm(), 1e-6);
  EXPECT_LT(tip_.error().norm(), 1e-6);
  EXPECT_LT(motion.fastest, 0.01);
}

// a single row vanishes at the end of its reach, and so does all that it could win there
TEST_P(Arrival, OneDirectionAloneLeavesTheStraightArmAndRestsAtItsEnd) {
  PositionTask along("along", robot_, "tip", {.axes = Matrix3::Identity().topRows(1)});
  const auto to = [&](double target, const Vector& start, const auto& move) {
    robot_.set_configuration(start);
    along.update(robot_);
    along.set_target(Vector::Constant(1, target));
    const Motion motion = move(limits_ < along < posture_);
    along.update(robot_);
    EXPECT_LT(motion.fastest, 0.01);
    EXPECT_LE(motion.hardest, 1.0 + 1e-9);
    return std::abs(along.error()[0]);
  };
  const auto by_velocity = [&](const Stack& stack) { return run(stack); };
  const auto by_acceleration = [&](const Stack& stack) { return accelerate(stack); };
  const Vector straight = Vector::Zero(3), bent = Vector{{0.5, 0.8, 0.9}};
  EXPECT_LT(to(1.2, straight, by_velocity), 1e-6);
  EXPECT_LT(to(1.2, straight, by_acceleration), 1e-6);
  EXPECT_LT(to(1.8, bent, by_velocity), 0.3 + 3e-3);
  EXPECT_LT(to(1.8, bent, by_acceleration), 0.3 + 3e-3);
}

TEST_P(Arrival, ByAccelerationsToo) {
  wrist_.set_target(Vector2(0.7, 0.7));
  const Motion near_by = accelerate(limits_ < wrist_ < posture_);
  EXPECT_LT(wrist_.error().norm(), 1e-6);
  EXPECT_LT(near_by.fastest, 0.01);
  EXPECT_LE(near_by.hardest, 1.0 + 1e-9);

  robot_.set_configuration(Vector{{0.5, 0.8, 0.9}});
  tip_.set_target(Vector2(-0.4, 2.4));
  const Motion beyond = accelerate(limits_ < tip_ < posture_);
  EXPECT_LT(tip_.error().norm(), Vector2(-0.4, 2.4).norm() - 1.5 + 2e-3);
  EXPECT_LT(beyond.fastest, 0.01);
  EXPECT_LE(beyond.hardest, 1.0 + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Periods, Arrival, testing::Values(1e-3, 2e-3, 5e-3));

class TaskSpeed : public Arrival {};

TEST_F(TaskSpeed, IsTheGainTimesTheErrorUpToTheMost) {
  Vector lower(2), upper(2);
  tip_.set_target(tip_.value() + Vector2(0.03, -0.04));  // 5 cm at 5 1/s: half of 0.5 m/s
  tip_.update(robot_);
  EXPECT_NEAR(haste(tip_, 5.0, 1e-3), 0.5, 1e-12);
  wanted_rates(tip_, 5.0, 1e-3, 0.5, lower, upper);
  EXPECT_TRUE(near(lower, Vector2(0.15, -0.2), 1e-12));
  EXPECT_EQ(lower, upper);
  tip_.set_target(tip_.value() + Vector2(0.6, -0.8));
  tip_.update(robot_);
  EXPECT_NEAR(haste(tip_, 5.0, 1e-3), 10.0, 1e-12);
  wanted_rates(tip_, 5.0, 1e-3, 10.0, lower, upper);
  EXPECT_TRUE(near(lower, Vector2(0.3, -0.4), 1e-12));
}

TEST_F(TaskSpeed, CorrectsAnErrorInNoLessThanAPeriod) {
  Vector lower(2), upper(2);
  tip_.set_gain(1e5);
  tip_.set_target(tip_.value() + Vector2(3e-4, -4e-4));
  tip_.update(robot_);
  EXPECT_NEAR(haste(tip_, 5.0, 1e-3), 1.0, 1e-9);  // 0.5 mm at 1000 1/s: 0.5 m/s
  wanted_rates(tip_, 5.0, 1e-3, 0.5, lower, upper);
  EXPECT_TRUE(near(lower, Vector2(0.3, -0.4), 1e-9));
}

TEST_F(TaskSpeed, OfAPostureIsBoundedJointByJoint) {
  Vector lower(3), upper(3);
  posture_.set_target(Vector3(2.0, -0.1, 0.0));
  posture_.update(robot_);
  wanted_rates(posture_, 5.0, 1e-3, haste(posture_, 5.0, 1e-3), lower, upper);
  EXPECT_TRUE(near(lower, Vector3(1.0, -0.5, 0.0), 1e-12));
}

TEST_F(TaskSpeed, LeavesAnAbsentSideAndASideThatHoldsBackAsTheyAre) {
  Vector lower(2), upper(2);
  tip_.set_interval(Vector2(1.0, -INFINITY), Vector2(2.0, 0.1));
  wanted_rates(tip_, 5.0, 1e-3, haste(tip_, 5.0, 1e-3), lower, upper);
  EXPECT_NEAR(lower[0], 0.5, 1e-12);   // pushes: bounded
  EXPECT_NEAR(upper[0], 10.0, 1e-12);  // 2 m away
  EXPECT_EQ(lower[1], -INFINITY);
  EXPECT_NEAR(upper[1], 0.5, 1e-12);
}

class Zone : public Arrival {
 protected:
  Zone() { zone_.set_stack(Stack({first_, second_}), 2); }
  PositionTask first_{"first", robot_, "tip"}, second_{"second", robot_, "wrist"};
  DeadZone zone_;
};

const std::vector<double> kGains{1.0, 1.0};  // [1/s]

// levels of two coordinates that ask for y
Hierarchy two_levels(double second_lever) {
  Hierarchy levels(2);
  levels[0].A = (Matrix(1, 2) << 1.0, 0.0).finished();
  levels[0].lower = levels[0].upper = Vector::Constant(1, 0.1);
  levels[1].A = (Matrix(2, 2) << 1.0, 0.0, 0.0, second_lever).finished();
  levels[1].lower = levels[1].upper = Vector2(0.0, 1.0);
  return levels;
}

TEST_F(Zone, ShortensAPullByWhatItCouldWin) {
  const auto share = [&](double lever, double weight, double above) {
    Hierarchy levels = two_levels(lever);
    const std::vector<double> weights{above, weight};
    zone_.apply(weights, kGains, nullptr, nullptr, levels);
    EXPECT_DOUBLE_EQ(levels[1].lower[1], zone_.share(1));
    EXPECT_EQ(levels[1].lower, levels[1].upper);
    return zone_.share(1);
  };
  EXPECT_NEAR(share(0.05, 1.0, 0.0), 1.0 - DeadZone::kZone / 0.05, 1e-12);
  EXPECT_NEAR(share(0.5, 1.0, 1.0), 1.0 - DeadZone::kZoneBelow / 0.5, 1e-12);
  EXPECT_EQ(share(0.01, 1.0, 0.0), 0.0);
  EXPECT_EQ(share(0.01, 0.0, 0.0), 1.0);  // at the target there is none
}

TEST_F(Zone, DoesNotCountWhatTheLevelsAboveHold) {
  Hierarchy levels = two_levels(1.0);
  levels[1].lower = levels[1].upper = Vector2(1.0, 0.0);  // along the row above
  zone_.apply(std::vector<double>{0.0, 1.0}, kGains, nullptr, nullptr, levels);
  EXPECT_EQ(zone_.share(1), 0.0);
}

TEST_F(Zone, CountsAJointTheLessTheNearerItsLimitIs) {
  Robot robot(load_model_text(kPendulum));
  JointLimits limits("limits", robot);
  const auto share = [&](double distance, double towards) {
    robot.set_configuration(Vector2(2.0 - distance, 0.0));  // the slide ends at 2
    limits.update(robot);
    Hierarchy levels = two_levels(1.0);
    levels[0].lower = levels[0].upper = Vector::Constant(1, towards);
    zone_.apply(std::vector<double>{1.0, 0.0}, kGains, &limits, nullptr, levels);
    return zone_.share(0);
  };
  EXPECT_EQ(share(0.0, 1.0), 0.0);
  EXPECT_EQ(zone_.pressed(0, 0), 1);
  EXPECT_NEAR(share(0.01, 1.0), 1.0 - DeadZone::kZone / 0.5, 1e-9);
  EXPECT_NEAR(share(0.5, 1.0), 1.0 - DeadZone::kZone, 1e-12);
  EXPECT_NEAR(share(0.0, -1.0), 1.0 - DeadZone::kZone, 1e-12);  // it leads away
  EXPECT_EQ(zone_.pressed(0, 0), 0);
}

}  // namespace

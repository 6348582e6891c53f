// Strategy: the seven-joint arm by accelerations: the motion that no task holds decays as `rest`
// says, and a hand that is led on beyond its reach comes to rest there and turns at once when its
// target leads it by no more than `max_lead`. The robot's own reach, in the physics: test_end_of_reach.py.
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "hurcules/control/acceleration_controller.hpp"
#include "hurcules/control/tasks.hpp"
#include "support/accelerated_motion.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class EndOfReach : public testing::Test {
 protected:
  EndOfReach() { start(); }
  // at rest, every task at what is
  void start() {
    robot_.set_keyframe("home");
    robot_.set_velocity(Vector::Zero(robot_.size()));
    for (Task* task : std::initializer_list<Task*>{&hand_, &posture_}) task->hold(robot_);
  }
  void tick(AccelerationController& controller) {
    controller.compute(robot_);
    follow(controller, robot_, q_, v_);
  }

  Robot robot_{load_model_text(kArm)};
  JointLimits joint_{"joint", robot_};
  PositionTask hand_{"hand", robot_, "tip"};
  PostureTask posture_{"posture", robot_};
  Vector q_, v_;
};

TEST_F(EndOfReach, WhatNoTaskHoldsBrakesAsRestSays) {
  // three of seven directions are held; a motion of the others alone
  std::vector<double> left;
  for (const double rest : {0.0, 4.0}) {
    AccelerationController free(robot_, {.rest = rest});
    free.set_stack(Stack({hand_}));
    start();
    const Matrix J = hand_.jacobian();
    Vector v = Vector::Constant(robot_.size(), 0.05);
    v -= J.transpose() * (J * J.transpose()).inverse() * J * v;
    robot_.set_velocity(v);
    for (int i = 0; i < 1000; ++i) tick(free);
    left.push_back(v_.norm() / v.norm());
    EXPECT_LT(hand_.error().norm(), 1e-3) << rest;
  }
  EXPECT_NEAR(left[0], 1.0, 0.2);
  EXPECT_NEAR(left[1], std::exp(-4.0), 0.2 * std::exp(-4.0));
}

TEST_F(EndOfReach, AHandOnALeashStopsAtTheEndOfItsReachAndTurnsAtOnce) {
  const auto reach = [&](double max_lead) {
    start();
    hand_.set_max_lead(max_lead);
    AccelerationController controller(robot_, {.rest = 10.0});
    controller.set_stack(joint_ < hand_ < posture_);
    const auto lead = [&](double speed, int ticks) {
      for (int i = 0; i < ticks; ++i) {
        hand_.advance(Vector3(speed, 0.0, 0.0), 1e-3);
        tick(controller);
      }
    };
    lead(0.1, 10000);
    const double outstretched = hand_.value()[0], speed = v_.cwiseAbs().maxCoeff();
    lead(-0.1, 1000);
    return std::array{outstretched - hand_.value()[0], speed};
  };
  const auto [back, speed] = reach(0.01);
  EXPECT_GT(back, 0.05);
  EXPECT_LT(speed, 1e-3);
  EXPECT_LT(reach(INFINITY)[0], 0.01);  // it waits until the target has come back
}

}  // namespace

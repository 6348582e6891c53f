// Strategy: a quadruped on its feet. Mechanics gives what must come out: at rest the forces carry the
// weight, at any acceleration they are the rate of momentum, no force leaves its cone, no torque its
// limit; what the cones forbid is told. Then the stacks that are refused.
#include <mujoco/mujoco.h>

#include "hurcules/control/acceleration_controller.hpp"
#include "hurcules/tasks/center_of_mass_task.hpp"
#include "hurcules/tasks/contact_task.hpp"
#include "hurcules/tasks/orientation_task.hpp"
#include "hurcules/tasks/posture_task.hpp"
#include "support/expect.hpp"
#include "support/quadruped.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kFriction = 0.6;

class Contacts : public testing::Test {
 protected:
  Contacts() {
    robot_.set_keyframe("stand");
    for (const char* const name : {"FL", "FR", "HL", "HR"})
      feet_.push_back(std::make_unique<ContactTask>(name, robot_, std::string(name) + "_shank",
                                                    ContactTaskOptions{.friction = kFriction}));
    com_.hold(robot_);
    trunk_.hold(robot_);
    posture_.hold(robot_);
  }
  StackLevel contacts() {
    std::vector<Task*> tasks;
    for (const auto& foot : feet_) tasks.push_back(foot.get());
    return {"contacts", tasks};
  }
  Vector3 carried(const AccelerationController& controller) const {
    Vector3 sum = Vector3::Zero();
    for (const auto& foot : feet_) sum += controller.contact_force(*foot);
    return sum;
  }
  Vector torque(const AccelerationController& controller) const {
    Vector given(robot_.size());
    controller.torque(robot_, given);
    return given;
  }

  Robot robot_{quadruped(), {}, true};
  std::vector<std::unique_ptr<ContactTask>> feet_;
  CenterOfMassTask com_{"centre of mass", robot_};
  OrientationTask trunk_{"trunk", robot_, "trunk"};
  PostureTask posture_{"posture", robot_};
  double mass_ = robot_.model()->body_subtreemass[robot_.root_body()];
  AccelerationController controller_{robot_, {.max_acceleration = 200.0}};
};

TEST_F(Contacts, CarryTheWeightAtRest) {
  controller_.set_stack(contacts() < com_ < trunk_ < posture_);
  EXPECT_EQ(controller_.stack().text(),
            "limits < torque limits < contacts < centre of mass < trunk < posture < least forces");
  const Vector acceleration = controller_.compute(robot_);
  EXPECT_TRUE(near(acceleration, Vector::Zero(robot_.size()), 1e-6));
  EXPECT_TRUE(near(carried(controller_), Vector3(0, 0, 9.81 * mass_), 1e-6));
  const Vector given = torque(controller_);
  EXPECT_TRUE(near(given.head<6>(), Vector::Zero(6), 1e-6));  // nothing else holds the root
  for (const auto& foot : feet_) EXPECT_GT(controller_.contact_force(*foot).z(), 20.0);
}

// the rate of momentum is m (com acceleration + g), whatever is asked for
TEST_F(Contacts, AreTheRateOfMomentumInsideTheirCones) {
  controller_.set_stack(contacts() < com_ < trunk_ < posture_);
  for (const Vector3& way : {Vector3(0.02, 0, 0), Vector3(0, 0.03, 0.01), Vector3(2, 0, 0),
                             Vector3(0, -1, 0), Vector3(0, 0, -1)}) {
    com_.set_target(robot_.com() + way);
    const Vector acceleration = controller_.compute(robot_);
    Matrix J(3, robot_.size());
    robot_.com_jacobian(J);
    const Vector3 rate = mass_ * (J * acceleration + Vector3(0, 0, 9.81));
    EXPECT_TRUE(near(carried(controller_), rate, 1e-6));
    for (const auto& foot : feet_) {
      const Vector3 force = controller_.contact_force(*foot);
      EXPECT_GE(force.z(), -1e-9);
      // a pyramid with its edges on the cone
      EXPECT_LE(std::abs(force.x()) + std::abs(force.y()),
                kFriction * std::sqrt(2.0) * force.z() + 1e-9);
      EXPECT_LE(force.head<2>().norm(), kFriction * force.z() + 1e-9);
      EXPECT_TRUE(near(foot->jacobian() * acceleration, Vector::Zero(3), 1e-4));
    }
    const Vector given = torque(controller_);
    for (Index i = 0; i < robot_.size(); ++i)
      EXPECT_LE(std::abs(given[i]),
                robot_.coordinates()[static_cast<std::size_t>(i)].max_effort + 1e-6);
  }
}

TEST_F(Contacts, CountInTorqueLimitsOfOnesOwn) {
  TorqueLimits limits("own", robot_);
  const StackLevel own("own", {&limits}, 0.0);  // unregularised, as the stack's own
  for (const Stack& stack :
       {own < contacts() < com_ < posture_, contacts() < own < com_ < posture_,
        contacts() < com_ < posture_ < own}) {
    AccelerationController controller(robot_, {.max_acceleration = 200.0});
    controller.set_stack(stack);
    EXPECT_TRUE(near(controller.compute(robot_), Vector::Zero(robot_.size()), 1e-6));
    EXPECT_TRUE(near(carried(controller), Vector3(0, 0, 9.81 * mass_), 1e-6));
  }
  // a knee that gives less than it bears yields, and the others take over
  Vector most = limits.upper();
  const Index knee = robot_.coordinate("FL_knee");
  controller_.set_stack(contacts() < com_ < trunk_ < posture_);
  controller_.compute(robot_);
  most[knee] = 0.5 * std::abs(torque(controller_)[knee]);
  limits.set_interval(-most, most);
  controller_.set_stack(own < contacts() < com_ < trunk_ < posture_);
  controller_.compute(robot_);
  EXPECT_LE(std::abs(torque(controller_)[knee]), most[knee] + 1e-6);
}

TEST_F(Contacts, TellWhatFrictionForbids) {
  com_.set_max_speed(50.0);
  com_.set_gain(20.0);
  controller_.set_stack(contacts() < com_ < posture_);
  com_.set_target(robot_.com() + Vector3(1.0, 0, 0));
  controller_.compute(robot_);
  const Vector3 sum = carried(controller_);
  EXPECT_GT(sum.x(), 0.0);
  bool told = false;
  for (const LevelDiagnostics& note : controller_.diagnostics(robot_))
    for (const Shortfall& task : note.shortfalls) told = told || contains(task.text(), "friction");
  EXPECT_TRUE(told);
}

// on its side the feet are no contacts: they yield, told with what holds them, before a torque passes
TEST_F(Contacts, YieldToTorqueLimits) {
  controller_.set_stack(contacts() < com_ < posture_);
  Vector qpos = robot_.qpos();
  qpos.segment<4>(3) << std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0;
  robot_.set_qpos(qpos);
  Vector velocity = Vector::Zero(robot_.size());
  velocity[2] = 5.0;  // [m/s] off the ground, which does not pull
  robot_.set_velocity(velocity);
  controller_.compute(robot_);
  const Vector given = torque(controller_);
  EXPECT_TRUE(near(given.head<6>(), Vector::Zero(6), 1e-6));
  for (Index i = 6; i < robot_.size(); ++i)
    EXPECT_LE(std::abs(given[i]),
              robot_.coordinates()[static_cast<std::size_t>(i)].max_effort + 1e-9);
  std::string told;
  for (const LevelDiagnostics& note : controller_.diagnostics(robot_))
    for (const Shortfall& task : note.shortfalls) told += task.text() + "\n";
  EXPECT_TRUE(contains(told, "m/s^2 short, held by")) << told;
  EXPECT_FALSE(contains(told, "torque limits:")) << told;
}

TEST_F(Contacts, RefuseStacksThatCannotBe) {
  const auto refused = [&](const Stack& stack) {
    return error_text([&] { controller_.set_stack(stack); });
  };
  EXPECT_TRUE(contains(refused(Stack({com_})), "the root of the robot floats"));
  EXPECT_TRUE(contains(refused(*feet_[0] < com_ < *feet_[1]), "on one level"));
  EXPECT_TRUE(contains(refused(*feet_[0] + com_ < posture_), "is no contact"));
  AccelerationController bare(robot_, {.enforce_limits = false});
  EXPECT_TRUE(contains(error_text([&] { bare.set_stack(contacts() < com_); }), "enforce_limits"));
  controller_.set_stack(contacts() < com_);
  controller_.compute(robot_);
  Vector q = robot_.configuration(), v = robot_.velocity();
  EXPECT_TRUE(contains(error_text([&] { controller_.integrate(q, v); }), "torques"));
  const auto contact = [&](double friction, const Vector3& normal) {
    return error_text(
        [&] { ContactTask("c", robot_, "FL_shank", {.friction = friction, .normal = normal}); });
  };
  EXPECT_TRUE(contains(contact(-0.1, Vector3::UnitZ()), "friction > 0"));
  EXPECT_TRUE(contains(contact(0.5, Vector3::Zero()), "normal"));
  EXPECT_TRUE(contains(error_text([&] { ContactTask("c", robot_, "hand"); }),
                       "wants a body, 'hand' is on"));
}

// an arm that is bolted down may be held by a contact too: its forces press on what it touches
TEST(ContactsOfAnArm, NeedNoFreeRoot) {
  Robot robot(load_model_text(kArm));
  robot.set_keyframe("home");
  ContactTask tip("tip", robot, "hand", {.points = {Vector3(0.02, 0, -0.15)}});
  PostureTask posture("posture", robot);
  AccelerationController controller(robot);
  controller.set_stack(tip < posture);
  const Vector acceleration = controller.compute(robot);
  EXPECT_TRUE(near(tip.jacobian() * acceleration, Vector::Zero(3), 1e-6));
}

}  // namespace

// Strategy: inverse dynamics against the mass matrix (its part that is linear in the acceleration)
// and against energy: with dampers taken out, torque times velocity is the rate of kinetic plus
// potential energy, by central differences; standing on a leg too. Angular momentum against MuJoCo's and
// against differences. Gravity of a pendulum by hand.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

struct ChainCase {
  const char* name;
  const char* model;
  const char* support;  // "" for the root
};

class Dynamics : public testing::TestWithParam<ChainCase> {
 protected:
  Dynamics() {
    if (*GetParam().support) robot_.stand_on(GetParam().support);
  }
  double energy(const Vector& q, const Vector& v) {
    robot_.set_configuration(q);
    Matrix M(robot_.size(), robot_.size());
    robot_.mass_matrix(M);
    const int tree = 1 + (GetParam().model == kTwin ? 1 : 0);
    const double mass = robot_.model()->body_subtreemass[tree];
    return 0.5 * v.dot(M * v) + 9.81 * mass * robot_.com().z();
  }
  Robot robot_{load_model_text(GetParam().model)};
};

TEST_P(Dynamics, IsLinearInTheAccelerationWithTheMassMatrix) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    RandomMotion random(seed);
    random.move(robot_);
    const Index n = robot_.size();
    robot_.set_velocity(random.vector(n, 1.0));
    const Vector a = random.vector(n, 3.0), still = Vector::Zero(n);
    Matrix M(n, n);
    Vector torque(n), bias(n);
    robot_.mass_matrix(M);
    robot_.inverse_dynamics(a, torque);
    robot_.inverse_dynamics(still, bias);
    EXPECT_TRUE(near(torque - bias, M * a, 1e-9)) << "seed " << seed;
  }
}

TEST_P(Dynamics, TorqueTimesVelocityIsTheRateOfEnergy) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    RandomMotion random(seed);
    random.move(robot_);
    const Index n = robot_.size();
    const Vector q = robot_.configuration(), v = random.vector(n, 1.0), a = random.vector(n, 3.0);
    robot_.set_velocity(v);
    Vector torque(n);
    robot_.inverse_dynamics(a, torque);
    const double h = 1e-5;
    const double rate = (energy(q + h * v, v + h * a) - energy(q - h * v, v - h * a)) / (2.0 * h);
    EXPECT_NEAR(torque.dot(v), rate, tolerance(1e-5) * (1.0 + std::abs(rate))) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, Dynamics,
                         testing::Values(ChainCase{"Arm", kArm, ""}, ChainCase{"Twin", kTwin, ""},
                                         ChainCase{"TwinOnALeg", kTwin, "leg_l"}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(AngularMomentum, IsMuJoCosAndChangesByItsDrift) {
  for (const char* support : {"", "leg_l"}) {
    Robot robot(load_model_text(kTwin));
    if (*support) robot.stand_on(support);
    const mjModel* const m = robot.model().get();
    const std::unique_ptr<mjData, void (*)(mjData*)> d(mj_makeData(m), mj_deleteData);
    const int tree = robot.root_body();
    for (unsigned seed = 0; seed < 10; ++seed) {
      RandomMotion random(seed);
      random.move(robot);
      const Index n = robot.size();
      const Vector q = robot.configuration(), v = random.vector(n, 1.0);
      robot.set_velocity(v);
      Matrix A(3, n);
      robot.angular_momentum_jacobian(A);
      const Vector3 drift = robot.angular_momentum_drift();
      const Vector3 now = A * v;
      // by MuJoCo, at the velocity that differences of qpos have
      const double h = 1e-5;
      robot.set_configuration(q + h * v);
      const Vector ahead = robot.qpos();
      robot.angular_momentum_jacobian(A);
      const Vector3 momentum_ahead = A * v;
      robot.set_configuration(q - h * v);
      const Vector behind = robot.qpos();
      robot.angular_momentum_jacobian(A);
      const Vector3 momentum_behind = A * v;
      robot.set_configuration(q);
      std::copy(robot.qpos().begin(), robot.qpos().end(), d->qpos);
      mj_differentiatePos(m, d->qvel, 2.0 * h, behind.data(), ahead.data());
      mj_forward(m, d.get());
      mj_subtreeVel(m, d.get());
      const Eigen::Map<const Vector3> wanted(d->subtree_angmom + 3 * tree);
      EXPECT_TRUE(near(now, wanted, 1e-7)) << support << seed;
      EXPECT_TRUE(near(drift, (momentum_ahead - momentum_behind) / (2.0 * h), 1e-7))
          << support << seed;
    }
  }
}

TEST(DynamicsOfAPendulum, GravityIsThatOfTheBob) {
  Robot robot(load_model_text(kPendulum));
  robot.set_configuration(Eigen::Vector2d(0.2, 0.3));
  Vector torque(2);
  robot.inverse_dynamics(Vector::Zero(2), torque);
  EXPECT_NEAR(torque[0], 0.0, tolerance(1e-12));
  EXPECT_NEAR(torque[1], 9.81 * 0.5 * std::sin(0.3), tolerance(1e-10));
}

}  // namespace

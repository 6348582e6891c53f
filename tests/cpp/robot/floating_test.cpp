// Strategy: robots whose root or ball joints are coordinates against MuJoCo, which has the same
// coordinates: Jacobians of a point, drifts by differences of Jacobians along the motion, mass matrix,
// inverse dynamics. Then where the numbers of a root are read and written, and what is refused.
#include <mujoco/mujoco.h>

#include "hurcules/robot/sole_points.hpp"
#include "support/expect.hpp"
#include "support/quadruped.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// a robot of MuJoCo's own coordinates
struct SiteCase {
  std::string name;
  ModelPtr model;
  bool floating;
  std::string site;
};

class OfMuJoCo : public testing::TestWithParam<SiteCase> {
 protected:
  // Jacobian of the site's origin or of its turn, at a configuration
  Matrix jacobian(const Vector& qpos, bool turn) {
    const mjModel* const m = model_.get();
    std::copy(qpos.begin(), qpos.end(), data_->qpos);
    mj_kinematics(m, data_.get());
    mj_comPos(m, data_.get());
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> linear(3, m->nv), angular(3, m->nv);
    mj_jacSite(m, data_.get(), linear.data(), angular.data(), site_.id);
    return turn ? angular : linear;
  }
  void move(unsigned seed) {
    RandomMotion random(seed);
    Vector qpos = robot_.qpos() + random.vector(robot_.qpos().size(), 0.5);
    mj_normalizeQuat(model_.get(), qpos.data());
    robot_.set_qpos(qpos);
    robot_.set_velocity(random.vector(robot_.size(), 2.0));
  }

  ModelPtr model_ = GetParam().model;
  std::unique_ptr<mjData, void (*)(mjData*)> data_{mj_makeData(model_.get()), mj_deleteData};
  Robot robot_{model_, {}, GetParam().floating};
  Frame site_ = robot_.frame(GetParam().site);
};

TEST_P(OfMuJoCo, MovesAsMuJoCoSays) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    move(seed);
    const Index n = robot_.size();
    Matrix linear(3, n), angular(3, n);
    robot_.position_jacobian(site_, linear);
    robot_.rotation_jacobian(site_, angular);
    const Matrix J = jacobian(robot_.qpos(), false), Jw = jacobian(robot_.qpos(), true);
    EXPECT_TRUE(near(linear, J, 1e-12));
    EXPECT_TRUE(near(angular, Jw, 1e-12));
    // Jdot v by a step of 1e-6 s along the motion: rounding and curvature both leave less than 1e-5
    const double step = 1e-6;
    Vector ahead = robot_.qpos();
    mj_integratePos(model_.get(), ahead.data(), robot_.velocity().data(), step);
    const Vector3 drift = (jacobian(ahead, false) - J) * robot_.velocity() / step;
    const Vector3 turning = (jacobian(ahead, true) - Jw) * robot_.velocity() / step;
    EXPECT_TRUE(near(robot_.position_drift(site_), drift, 1e-4));
    EXPECT_TRUE(near(robot_.rotation_drift(site_), turning, 1e-4));
  }
}

TEST_P(OfMuJoCo, TakesTheTorquesThatMuJoCoSays) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    move(seed);
    const mjModel* const m = model_.get();
    const Index n = robot_.size();
    const Vector acceleration = RandomMotion(seed + 50).vector(n, 3.0);
    std::copy(robot_.qpos().begin(), robot_.qpos().end(), data_->qpos);
    std::copy(robot_.velocity().begin(), robot_.velocity().end(), data_->qvel);
    mj_forward(m, data_.get());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> M(n, n);
    mj_fullM(m, data_.get(), M.data());
    Matrix inertia(n, n);
    robot_.mass_matrix(inertia);
    EXPECT_TRUE(near(inertia, M, 1e-12));
    const Eigen::Map<const Vector> bias(data_->qfrc_bias, n), passive(data_->qfrc_passive, n);
    Vector torque(n);
    robot_.inverse_dynamics(acceleration, torque);
    EXPECT_TRUE(near(torque, M * acceleration + bias - passive, 1e-9));
  }
}

TEST_P(OfMuJoCo, GoesAStepFurtherAsMuJoCoDoes) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    move(seed);
    const Vector velocity = robot_.velocity();
    Vector ahead = robot_.qpos(), q = robot_.configuration();
    mj_integratePos(model_.get(), ahead.data(), velocity.data(), 0.3);
    add_step(robot_.rotations(), 0.3 * velocity, q);
    robot_.set_configuration(q);
    EXPECT_TRUE(near(jacobian(robot_.qpos(), false), jacobian(ahead, false), 1e-12));
    EXPECT_TRUE(near(robot_.configuration(), q, 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, OfMuJoCo,
                         testing::Values(SiteCase{"Floating", quadruped(), true, "hand"},
                                         SiteCase{"BallJoints", load_model_text(kBallArm), false,
                                                  "tip"}),
                         [](const auto& test) { return test.param.name; });

class Floating : public testing::Test {
 protected:
  void move(unsigned seed) {
    RandomMotion random(seed);
    Vector qpos = robot_.qpos() + random.vector(robot_.qpos().size(), 0.5);
    qpos.segment<4>(3).normalize();
    robot_.set_qpos(qpos);
  }

  ModelPtr model_ = quadruped();
  Robot robot_{model_, {}, true};
};

TEST_F(Floating, HasTheCoordinatesOfItsRootInFront) {
  EXPECT_EQ(robot_.size(), 6 + 15);
  EXPECT_TRUE(robot_.floating());
  EXPECT_FALSE(robot_.floats());
  EXPECT_EQ(robot_.coordinate_names()[0], "root_x");
  EXPECT_EQ(robot_.coordinate_names()[5], "root_rz");
  EXPECT_EQ(robot_.coordinates()[2].max_effort, 0.0);
  const Robot again(model_, robot_.coordinate_names());
  EXPECT_EQ(again.coordinate_names(), robot_.coordinate_names());
}

TEST_F(Floating, ReadsAndWritesItsPlaceAsARotationVector) {
  move(3);
  const Vector qpos = robot_.qpos(), q = robot_.configuration();
  EXPECT_TRUE(near(q.head<3>(), qpos.head<3>(), 0.0));
  robot_.set_keyframe("stand");
  robot_.set_configuration(q);
  EXPECT_TRUE(near(robot_.qpos(), qpos[3] < 0 ? Vector(-qpos) : qpos, 1e-12) ||
              near(robot_.qpos(), qpos, 1e-12));
  Vector qvel = RandomMotion(4).vector(model_->nv, 1.0), velocity(robot_.size());
  robot_.velocities_of(qvel, velocity);
  EXPECT_TRUE(near(velocity, qvel, 0.0));
}

TEST_F(Floating, RefusesWhatHasNoFreeRoot) {
  const ModelPtr arm = load_model_text(kArm);
  EXPECT_TRUE(contains(error_text([&] { Robot(arm, {}, true); }), "free joint at its root"));
  EXPECT_TRUE(contains(error_text([&] { robot_.stand_on("FL_shank"); }), "ContactTask"));
}

TEST(SolePoints, AreTheCornersOfASoleAndTheLowestOfARoundFoot) {
  const ModelPtr model = load_model_text(R"(<mujoco><worldbody>
    <body name="foot" pos="0 0 1" euler="0 0 30"><freejoint/>
      <geom type="box" size="0.1 0.04 0.02" pos="0.02 0 -0.05"/>
      <geom type="sphere" size="0.2" contype="0" conaffinity="0"/></body>
    <body name="ball" pos="1 0 1" euler="40 0 0"><freejoint/><geom size="0.03"/></body>
    <body name="bar" pos="2 0 1" euler="0 90 0"><freejoint/>
      <geom type="capsule" size="0.02 0.1"/></body>
    <body name="seen" pos="3 0 1"><joint/><geom size="0.1" contype="0" conaffinity="0"/></body>
    </worldbody></mujoco>)");
  const Robot robot(model);
  const std::vector<Vector3> sole = sole_points(robot, "foot");
  ASSERT_EQ(sole.size(), 4U);
  for (const Vector3& point : sole) {
    EXPECT_NEAR(std::abs(point.x() - 0.02), 0.1, 1e-12);
    EXPECT_NEAR(std::abs(point.y()), 0.04, 1e-12);
    EXPECT_NEAR(point.z(), -0.07, 1e-12);
  }
  const std::vector<Vector3> round = sole_points(robot, "ball");
  ASSERT_EQ(round.size(), 1U);
  const Vector3 lowest =
      robot.position(robot.frame("ball")) + robot.orientation(robot.frame("ball")) * round[0];
  EXPECT_TRUE(near(lowest, Vector3(1, 0, 0.97), 1e-12));
  EXPECT_EQ(sole_points(robot, "bar").size(), 2U);
  EXPECT_TRUE(contains(error_text([&] { (void)sole_points(robot, "seen"); }), "collision geoms"));
  EXPECT_TRUE(contains(error_text([&] { (void)sole_points(robot, "hoof"); }), "'hoof'"));
}

}  // namespace

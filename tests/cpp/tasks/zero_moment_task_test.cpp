// Strategy: the rows against the contact wrench that MuJoCo's inverse dynamics asks of a free root at
// the same motion, at random configurations, velocities and accelerations, standing on a leg and on the
// root, tilted and upside down too.
#include "hurcules/tasks/zero_moment_task.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <memory>

#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

const Matrix kSquare = (Matrix(4, 2) << -0.3, -0.2, 0.4, -0.2, 0.4, 0.25, -0.3, 0.25).finished();
constexpr double kNudge = 1e-5;  // [s]

// qvel of the robot at q and v, by differences of qpos
Vector qvel_at(Robot& robot, const Vector& q, const Vector& v) {
  const mjModel* const m = robot.model().get();
  robot.set_configuration(q + kNudge * v);
  const Vector ahead = robot.qpos();
  robot.set_configuration(q - kNudge * v);
  Vector qvel(m->nv);
  mj_differentiatePos(m, qvel.data(), 2.0 * kNudge, robot.qpos().data(), ahead.data());
  robot.set_configuration(q);
  return qvel;
}

// (k) the moment of the ground's push about each side [N m], positive where it presses
Vector pressing(Robot& robot, const Vector& a, const Skeleton::Pose& reference, double height) {
  const mjModel* const m = robot.model().get();
  const std::unique_ptr<mjData, void (*)(mjData*)> d(mj_makeData(m), mj_deleteData);
  const Vector q = robot.configuration(), v = robot.velocity();
  const double h = 1e-4;
  const Vector after = qvel_at(robot, q + h * v + 0.5 * h * h * a, v + h * a);
  const Vector before = qvel_at(robot, q - h * v + 0.5 * h * h * a, v - h * a);
  const Vector now = qvel_at(robot, q, v);
  std::copy(robot.qpos().begin(), robot.qpos().end(), d->qpos);
  std::copy(now.begin(), now.end(), d->qvel);
  const Vector qacc = (after - before) / (2.0 * h);
  std::copy(qacc.begin(), qacc.end(), d->qacc);
  mj_fwdPosition(m, d.get());
  mj_fwdVelocity(m, d.get());
  Vector efforts(m->nv);
  mj_rne(m, d.get(), 1, efforts.data());
  const auto root = efforts.segment<6>(robot.root_dof());
  const Eigen::Map<const Vector3> origin(d->xpos + 3 * robot.root_body());
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(d->xmat +
                                                                         9 * robot.root_body());
  const Vector3 force = root.head<3>(), moment = R * root.tail<3>();
  Vector result(kSquare.rows());
  const double up = reference.R(2, 2) > 0.0 ? 1.0 : -1.0;
  for (Index i = 0; i < kSquare.rows(); ++i) {
    const Vector3 p = reference.p + reference.R * Vector3(kSquare(i, 0), kSquare(i, 1), height);
    const Index next = (i + 1) % kSquare.rows();
    // along the side, the polygon on the left of it as seen from above
    const Vector3 along = up * (reference.R * Vector3(kSquare(next, 0) - kSquare(i, 0),
                                                      kSquare(next, 1) - kSquare(i, 1), 0.0))
                                   .normalized();
    result[i] = along.dot(moment + (origin - p).cross(force));
  }
  return result;
}

class ZeroMoment : public testing::TestWithParam<const char*> {};

TEST_P(ZeroMoment, RowsAreTheMomentThatInverseDynamicsAsksOfTheGround) {
  Robot robot(load_model_text(kTwin));
  const std::string support = GetParam();
  if (!support.empty()) robot.stand_on(support);
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomMotion random(seed);
    random.move(robot);
    const Index n = robot.size();
    robot.set_velocity(random.vector(n, 1.0));
    const double height = random.uniform(-0.5, 0.0);
    ZeroMomentTask task(
        "zero moment", robot,
        {.polygon = kSquare, .margin = 0.0, .height = height, .reference = support});
    const Vector a = random.vector(n, 3.0);
    const Vector asked = robot.mass() * (task.jacobian() * a + task.drift());
    const Skeleton::Pose reference =
        support.empty() ? Skeleton::Pose{} : robot.pose(robot.frame(support));
    const Vector wanted = pressing(robot, a, reference, height);
    EXPECT_TRUE(near(asked, wanted, 1e-4 * wanted.norm())) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(OnRootAndLeg, ZeroMoment, testing::Values("", "leg_l"));

TEST(ZeroMomentTask, KeepsItsMarginTimesGravity) {
  const Robot robot(load_model_text(kTwin));
  const ZeroMomentTask task("zero moment", robot, {.polygon = kSquare, .margin = 0.05});
  EXPECT_TRUE(near(task.lower(), Vector::Constant(4, 0.05 * 9.81), 1e-12));
}

TEST(ZeroMomentTask, AllocatesNothing) {
  Robot robot(load_model_text(kTwin));
  ZeroMomentTask task("zero moment", robot, {.polygon = kSquare});
  robot.set_velocity(Vector::Constant(robot.size(), 0.3));
  const NoAllocation guard;
  task.update(robot);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(ZeroMomentTask, RefusesWhatIsNoGround) {
  const Robot robot(load_model_text(kTwin));
  const auto refusal = [&](const ZeroMomentTaskOptions& options) {
    return error_text([&] { ZeroMomentTask("zero moment", robot, options); });
  };
  EXPECT_TRUE(contains(refusal({.polygon = kSquare.topRows(2)}), "3 or more finite corners"));
  EXPECT_TRUE(contains(refusal({.polygon = kSquare, .reference = "moon"}), "moon"));
  const double endless = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(contains(refusal({.polygon = kSquare, .height = endless}), "finite"));
}

}  // namespace

// Strategy: linkages whose passive joints follow: a four-bar, rods between balls, a curve
// and a tendon, loops over the ground, a load, a hand on a door. Truth: MuJoCo's own
// residuals, differences of poses, and its constrained forward dynamics, which know nothing of the
// shares.
#include <mujoco/mujoco.h>

#include <Eigen/QR>
#include <random>

#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/left_out.hpp"
#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"
#include "support/linkages.hpp"
#include "support/no_allocation.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class ClosedChain : public testing::TestWithParam<const char*> {
 protected:
  ClosedChain() : model_(load_model_text(GetParam())), robot_(model_) {}

  // potential energy of all bodies [J]
  double potential() const {
    std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model_.get()), mj_deleteData);
    Eigen::Map<Vector>(data->qpos, model_->nq) = robot_.qpos();
    mj_kinematics(model_.get(), data.get());
    mj_comPos(model_.get(), data.get());
    mj_energyPos(model_.get(), data.get());
    return data->energy[0];
  }

  // at random near the start, moving
  void place(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-0.3, 0.3);
    Vector q(robot_.size()), v(robot_.size());
    for (Index i = 0; i < q.size(); ++i) {
      q[i] = uniform(random);
      v[i] = 5.0 * uniform(random);
    }
    robot_.set_configuration(q);
    robot_.set_velocity(v);
  }

  // a step from there
  void go(Vector q, const Vector& step) {
    add_step(robot_.rotations(), step, q);
    robot_.set_configuration(q);
  }

  // largest residual of the model's equality constraints there
  double open(const Vector& qpos) const {
    std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model_.get()), mj_deleteData);
    Eigen::Map<Vector>(data->qpos, model_->nq) = qpos;
    mj_forward(model_.get(), data.get());
    double most = 0.0;
    for (int row = 0; row < data->ne; ++row) most = std::max(most, std::abs(data->efc_pos[row]));
    EXPECT_GT(data->ne, 0);
    return most;
  }

  ModelPtr model_;
  Robot robot_;
};

TEST_P(ClosedChain, StaysClosed) {
  EXPECT_EQ(robot_.size(), model_->nu);
  for (unsigned seed = 0; seed < 50; ++seed) {
    place(seed);
    EXPECT_LT(open(robot_.qpos()), 1e-11) << seed;
  }
  EXPECT_EQ(left_out(robot_), "");
}

TEST_P(ClosedChain, JacobianAndDriftAreThoseOfThePoses) {
  const Frame tip = robot_.frame("tip");
  const double e = 2e-4;
  for (unsigned seed = 0; seed < 10; ++seed) {
    place(seed);
    const Vector q = robot_.configuration(), v = robot_.velocity();
    Matrix J(3, robot_.size()), R(3, robot_.size());
    robot_.position_jacobian(tip, J);
    robot_.rotation_jacobian(tip, R);
    const Vector3 p = robot_.position(tip), drift = robot_.position_drift(tip);
    const Vector3 turning = robot_.rotation_drift(tip);
    const auto moved = [&](double share) {
      go(q, share * e * v);
      return robot_.position(tip);
    };
    const Vector3 ahead = moved(1), behind = moved(-1);
    EXPECT_LT((J * v - (ahead - behind) / (2 * e)).norm(), 1e-6) << seed;
    const auto spin = [&](double share) -> Vector3 {
      go(q, share * e * v);
      Matrix rotation(3, robot_.size());
      robot_.rotation_jacobian(tip, rotation);
      return rotation * v;
    };
    EXPECT_LT(((spin(1) - spin(-1)) / (2 * e) - turning).norm(), 1e-5) << seed;
    // at constant velocity of the coordinates the tip accelerates by the drift
    EXPECT_LT(((ahead - 2 * p + behind) / (e * e) - drift).norm(), 1e-3) << seed;
    // the robot goes on at its velocity wherever it is put
    robot_.set_configuration(q);
    EXPECT_LT((robot_.position_drift(tip) - drift).norm(), 1e-6) << seed;
  }
}

// at rest: M qacc + h = torque + C' lambda, C qacc = 0, with MuJoCo's M, h and C
TEST_P(ClosedChain, TorquesOfInverseDynamicsGiveTheAcceleration) {
  const mjModel* const m = model_.get();
  std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(m), mj_deleteData);
  const Vector wanted = Vector::LinSpaced(robot_.size(), 1.0, -2.0);
  Vector torque(robot_.size());
  for (unsigned seed = 0; seed < 10; ++seed) {
    place(seed);
    robot_.set_velocity(Vector::Zero(robot_.size()));
    robot_.inverse_dynamics(wanted, torque);
    Eigen::Map<Vector>(data->qpos, m->nq) = robot_.qpos();
    Eigen::Map<Vector>(data->ctrl, m->nu) = torque;
    mj_forward(m, data.get());
    const int nv = static_cast<int>(m->nv), rows = data->ne;
    Matrix system = Matrix::Zero(nv + rows, nv + rows), M(nv, nv);
    mj_fullM(m, data.get(), M.data());
    system.topLeftCorner(nv, nv) = M;
    for (int row = 0; row < rows; ++row)
      for (int dof = 0; dof < nv; ++dof)
        system(nv + row, dof) = system(dof, nv + row) = data->efc_J[row * nv + dof];
    Vector right = Vector::Zero(nv + rows);
    right.head(nv) = Eigen::Map<Vector>(data->qfrc_smooth, nv);
    const Vector qacc = system.completeOrthogonalDecomposition().solve(right).head(nv);
    for (Index i = 0; i < robot_.size(); ++i)
      EXPECT_NEAR(qacc[robot_.coordinates()[static_cast<std::size_t>(i)].joints[0].dof], wanted[i],
                  1e-6)
          << seed;
  }
}

// moving: the power of the torques is what energy gains
TEST_P(ClosedChain, TorquesOfInverseDynamicsGiveThePower) {
  const double e = 1e-4;
  Matrix M(robot_.size(), robot_.size());
  Vector torque(robot_.size());
  for (unsigned seed = 0; seed < 10; ++seed) {
    place(seed);
    const Vector q = robot_.configuration(), v = robot_.velocity();
    const Vector a = Vector::LinSpaced(robot_.size(), 1.0, -2.0);
    robot_.inverse_dynamics(a, torque);
    const auto energy = [&](double t) {
      go(q, t * v + 0.5 * t * t * a);
      robot_.mass_matrix(M);
      const Vector moving = v + t * a;
      return 0.5 * moving.dot(M * moving) + potential();
    };
    EXPECT_NEAR((energy(e) - energy(-e)) / (2 * e), torque.dot(v), 1e-5) << seed;
  }
}

TEST_P(ClosedChain, AllocatesNothing) {
  place(0);
  const Vector q = robot_.configuration(), v = robot_.velocity(), qpos = robot_.qpos();
  Vector torque(robot_.size());
  const NoAllocation guard;
  robot_.set_configuration(q);
  robot_.set_velocity(v);
  robot_.inverse_dynamics(v, torque);
  robot_.set_qpos(qpos);
  EXPECT_EQ(guard.count(), 0U);
}

// a cable of many edges beside an arm, each of them a row of one constraint
TEST(ClosedChains, LeaveFlexibleBodiesAlone) {
  std::string text = kFourBar;
  text.insert(
      text.find("<body name=\"base\""),
      R"(<flexcomp name="rope" type="grid" count="20 1 1" spacing="0.05 0.05 0.05" dim="1" pos="2 0 1"
                  mass="0.1"><contact contype="0" conaffinity="0"/><edge equality="true"/></flexcomp>)");
  const Robot robot(load_model_text(text));
  EXPECT_EQ(robot.closures()->size(), 2);
  EXPECT_EQ(left_out(robot), "");
}

// three joints have a motor and the hand leaves one free: as they are, the loop opens and is named;
// where one leads by name the others follow, with the door and its range
TEST(ClosedChains, FollowTheJointsThatWereChosen) {
  const ModelPtr model = load_model_text(kDoor);
  const Robot all(model);
  EXPECT_EQ(all.size(), 3);
  EXPECT_TRUE(contains(left_out(all), "do not keep: grip"));
  EXPECT_TRUE(contains(left_out(all), "joints=[...]"));
  Robot robot(model, {"c"});
  EXPECT_EQ(robot.size(), 1);
  EXPECT_EQ(robot.closures()->size(), 3);
  EXPECT_EQ(left_out(robot), "");
  Vector q(1);
  for (q[0] = 0.0; q[0] < 0.5; q[0] += 0.01) {
    robot.set_configuration(q);
    EXPECT_LT(robot.closures()->error(), 1e-12);
  }
  // at the end of its way the door has turned, and the hand is where its handle was
  const double angle = robot.qpos()[3];
  EXPECT_GT(std::abs(angle), 0.1);
  const Vector3 handle(0.6 - 0.7 * std::sin(angle), -0.5 + 0.7 * std::cos(angle), 1.0);
  EXPECT_TRUE(near(robot.position(robot.frame("tip")), handle, 1e-10));
}

// where the root moves with the joints, the loop over the ground would have to count it
TEST(ClosedChains, OverTheGroundRefuseAnotherSupport) {
  std::string text = kTied;
  text.insert(text.find("<joint name=\"crank\""),
              "<freejoint name='root'/><geom size='0.1'/>"
              "<body name='first'>");
  text.insert(text.find("</worldbody>"), "</body>");
  Robot robot(load_model_text(text));
  EXPECT_EQ(robot.closures()->size(), 2);
  EXPECT_TRUE(contains(error_text([&] { robot.stand_on("coupler"); }), "tied to the ground"));
}

INSTANTIATE_TEST_SUITE_P(Linkages, ClosedChain,
                         testing::Values(kFourBar, kRod, kCurve, kPiston, kTied, kLoad, kBallRod));

}  // namespace

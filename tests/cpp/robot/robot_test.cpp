// Strategy: Jacobians, drifts and poses of every kind of frame against central differences at
// seeded random configurations; hand-computed values on the pendulum; wrong input as an Error. Not
// tested: MuJoCo's kinematics themselves.
#include "hurcules/robot/robot.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "support/expect.hpp"
#include "support/no_allocation.hpp"
#include "support/random_motion.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kStep = 1e-5;  // a central difference is exact to about its square

struct Case {
  const char* model;
  const char* frame;
  const char* support = nullptr;  // the body that it stands on, else its root
};

class RobotFrame : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (GetParam().support) robot_.stand_on(GetParam().support);
  }
  Robot robot_{load_model_text(GetParam().model)};
  Frame frame_ = robot_.frame(GetParam().frame);

  Matrix position_jacobian() {
    Matrix J(3, robot_.size());
    robot_.position_jacobian(frame_, J);
    return J;
  }
  Matrix rotation_jacobian() {
    Matrix J(3, robot_.size());
    robot_.rotation_jacobian(frame_, J);
    return J;
  }
};

TEST_P(RobotFrame, JacobiansEqualDifferencesOfThePose) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    RandomMotion(seed).move(robot_);
    const Vector q = robot_.configuration();
    const Matrix Jp = position_jacobian(), Jr = rotation_jacobian();
    Matrix linear(3, robot_.size()), angular(3, robot_.size());
    for (Index i = 0; i < robot_.size(); ++i) {
      robot_.set_configuration(q + kStep * Vector::Unit(robot_.size(), i));
      const Vector3 p = robot_.position(frame_);
      const Matrix3 R = robot_.orientation(frame_);
      robot_.set_configuration(q - kStep * Vector::Unit(robot_.size(), i));
      linear.col(i) = (p - robot_.position(frame_)) / (2 * kStep);
      angular.col(i) = rotation_log(R * robot_.orientation(frame_).transpose()) / (2 * kStep);
    }
    EXPECT_TRUE(near(Jp, linear, 1e-9)) << "seed " << seed;
    EXPECT_TRUE(near(Jr, angular, 1e-9)) << "seed " << seed;
  }
}

TEST_P(RobotFrame, DriftsEqualDifferencesOfTheVelocity) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    RandomMotion random(seed);
    random.move(robot_);
    const Vector q = robot_.configuration(), v = random.vector(robot_.size(), 1.0);
    robot_.set_velocity(v);
    const Vector3 linear = robot_.position_drift(frame_), angular = robot_.rotation_drift(frame_);
    robot_.set_configuration(q + kStep * v);
    const Vector3 linear_after = position_jacobian() * v, angular_after = rotation_jacobian() * v;
    robot_.set_configuration(q - kStep * v);
    EXPECT_TRUE(near(linear, (linear_after - position_jacobian() * v) / (2 * kStep), 1e-7));
    EXPECT_TRUE(near(angular, (angular_after - rotation_jacobian() * v) / (2 * kStep), 1e-7));
  }
}

TEST_P(RobotFrame, DriftsDoNotCareWhetherVelocityOrConfigurationCameFirst) {
  RandomMotion random(1);
  const Vector q = random.configuration(robot_), v = random.vector(robot_.size(), 1.0);
  robot_.set_configuration(q);
  robot_.set_velocity(v);
  const Vector3 linear = robot_.position_drift(frame_), angular = robot_.rotation_drift(frame_);
  robot_.set_configuration(Vector::Zero(robot_.size()));
  robot_.set_velocity(v);
  robot_.set_configuration(q);
  // a root that follows its support has gone another way, by a rounding
  const double rounding = GetParam().support ? 1e-12 : 0.0;
  EXPECT_TRUE(near(robot_.position_drift(frame_), linear, rounding));
  EXPECT_TRUE(near(robot_.rotation_drift(frame_), angular, rounding));
}

TEST_P(RobotFrame, QuestionsAllocateNothing) {
  const Vector v = Vector::Ones(robot_.size()), q = 0.1 * v, qpos = robot_.qpos();
  Matrix J(3, robot_.size()), M(robot_.size(), robot_.size());
  Vector out(robot_.size());
  double sum = 0;
  const NoAllocation guard;
  robot_.set_qpos(qpos);
  robot_.set_velocity(v);
  robot_.set_configuration(q);
  robot_.coordinates_of(qpos, out);
  robot_.position_jacobian(frame_, J);
  robot_.rotation_jacobian(frame_, J);
  robot_.com_jacobian(J);
  robot_.mass_matrix(M);
  sum += robot_.position(frame_).x() + robot_.orientation(frame_)(0) + robot_.com().x();
  sum += robot_.position_drift(frame_).x() + robot_.rotation_drift(frame_).x();
  sum += robot_.com_drift().x() + robot_.view_orientation(frame_)(0);
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_TRUE(std::isfinite(sum));
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind, RobotFrame,
    testing::Values(Case{kArm, "tip"}, Case{kArm, "hand"}, Case{kArm, "eye"}, Case{kArm, "forearm"},
                    Case{kArm, "goal"}, Case{kTwin, "hand_l"}, Case{kTwin, "head"},
                    Case{kTwin, "eye"}, Case{kTwin, "toe_r"}, Case{kTwin, "base_site"},
                    Case{kTwin, "ball"}, Case{kTwin, "hand_l", "leg_l"},
                    Case{kTwin, "toe_r", "leg_l"}, Case{kTwin, "eye", "leg_r"},
                    Case{kTwin, "ball", "leg_l"}, Case{kTwin, "hand_l", "base"}),
    [](const auto& test) {
      return std::string(test.param.model == kArm ? "Arm_" : "Twin_") + test.param.frame +
             (test.param.support ? std::string("_on_") + test.param.support : "");
    });

TEST(Robot, TheSupportStaysAndEverythingElseMoves) {
  Robot robot(load_model_text(kTwin));
  robot.stand_on("leg_l");
  RandomMotion random(3);
  random.move(robot);
  const Frame support = robot.frame("leg_l"), base = robot.frame("base");
  const Vector3 p = robot.position(support);
  const Matrix3 R = robot.orientation(support), R_base = robot.orientation(base);
  for (int i = 0; i < 100; ++i) robot.set_configuration(random.configuration(robot));
  EXPECT_TRUE(near(robot.position(support), p, 1e-12));
  EXPECT_TRUE(near(robot.orientation(support), R, 1e-12));
  EXPECT_GT((robot.orientation(base) - R_base).norm(), 1e-2);
  Matrix J(3, robot.size());
  robot.position_jacobian(support, J);
  EXPECT_LT(J.norm(), 1e-14);
}

TEST(Robot, StandingInertiaIsThatOfTheMotionItMakes) {
  // v'Mv from the velocities of all bodies, computed from the reduced Jacobians alone
  Robot robot(load_model_text(kTwin));
  robot.stand_on("leg_l");
  RandomMotion(5).move(robot);
  const mjModel& m = *robot.model();
  Matrix M(robot.size(), robot.size()), wanted = Matrix::Zero(robot.size(), robot.size());
  robot.mass_matrix(M);
  mjData* data = mj_makeData(&m);
  std::copy(robot.qpos().begin(), robot.qpos().end(), data->qpos);
  mj_kinematics(&m, data);
  for (int body = 1; body < m.nbody; ++body) {
    if (std::string(mj_id2name(&m, mjOBJ_BODY, body)) == "ball") continue;
    Matrix Jp(3, robot.size()), Jr(3, robot.size());
    const Frame frame{mjOBJ_BODY, body};
    robot.position_jacobian(frame, Jp);
    robot.rotation_jacobian(frame, Jr);
    const Vector3 arm = Eigen::Map<const Vector3>(data->xipos + 3 * body) - robot.position(frame);
    const Matrix Jc = Jp - skew(arm) * Jr;
    const Matrix3 R =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data->ximat + 9 * body);
    const Matrix3 I =
        R * Eigen::Map<const Vector3>(m.body_inertia + 3 * body).asDiagonal() * R.transpose();
    wanted += m.body_mass[body] * Jc.transpose() * Jc + Jr.transpose() * I * Jr;
  }
  mj_deleteData(data);
  EXPECT_TRUE(near(M, wanted, 1e-10));
}

TEST(Robot, StandsOnlyOnABodyOfItsOwnFreeTree) {
  Robot twin(load_model_text(kTwin)), arm(load_model_text(kArm));
  EXPECT_THROW(twin.stand_on("ball"), Error);
  EXPECT_THROW(twin.stand_on("hand_l"), Error);  // a site
  EXPECT_THROW(twin.stand_on("leg_x"), Error);
  EXPECT_THROW(arm.stand_on("hand"), Error);
}

TEST(Robot, PendulumStandsWhereAHandComputesIt) {
  Robot robot(load_model_text(kPendulum));
  robot.set_configuration(Eigen::Vector2d(0.7, 0.3));
  const Frame ball = robot.frame("ball");
  const Vector3 p(0.7 - 0.5 * std::sin(0.3), 0, -0.5 * std::cos(0.3));
  EXPECT_TRUE(near(robot.position(ball), p, 1e-14));
  Matrix J(3, 2), wanted(3, 2);
  robot.position_jacobian(ball, J);
  wanted << 1, -0.5 * std::cos(0.3), 0, 0, 0, 0.5 * std::sin(0.3);
  EXPECT_TRUE(near(J, wanted, 1e-14));
  // three parts cart, one part ball
  EXPECT_TRUE(near(robot.com(), 0.75 * Vector3(0.7, 0, 0) + 0.25 * p, 1e-14));
}

TEST(Robot, MassMatrixIsThatOfCartAndBall) {
  Robot robot(load_model_text(kPendulum));
  robot.set_configuration(Eigen::Vector2d(0.0, 0.3));
  Matrix M(2, 2), wanted(2, 2);
  robot.mass_matrix(M);
  const double coupling = -0.5 * std::cos(0.3), ball = 0.4 * 0.1 * 0.1 + 0.25;
  wanted << 4, coupling, coupling, ball;
  EXPECT_TRUE(near(M, wanted, 1e-13));
}

TEST(Robot, CoupledMassMatrixGivesTheEnergyOfBothLegs) {
  Robot robot(load_model_text(kTwin));
  RandomMotion(3).move(robot);
  Matrix M(13, 13);
  robot.mass_matrix(M);
  EXPECT_TRUE(near(M, M.transpose(), 1e-12));
  // each leg: 3 kg at 0.2 m and a ball of 0.05 m; factors 1 and -2
  const double leg = 3 * 0.2 * 0.2 + 0.4 * 3 * 0.05 * 0.05;
  EXPECT_NEAR(M(1, 1), leg * (1 + 4), tolerance(1e-12));
}

TEST(Robot, CenterOfMassJacobianAndDriftEqualDifferences) {
  Robot robot(load_model_text(kTwin));
  for (unsigned seed = 0; seed < 20; ++seed) {
    if (seed == 10) robot.stand_on("leg_l");
    RandomMotion random(seed);
    random.move(robot);
    const Vector q = robot.configuration(), v = random.vector(13, 1.0);
    robot.set_velocity(v);
    Matrix J(3, 13), Jh(3, 13), difference(3, 13);
    robot.com_jacobian(J);
    const Vector3 drift = robot.com_drift();
    for (Index i = 0; i < 13; ++i) {
      robot.set_configuration(q + kStep * Vector::Unit(13, i));
      const Vector3 ahead = robot.com();
      robot.set_configuration(q - kStep * Vector::Unit(13, i));
      difference.col(i) = (ahead - robot.com()) / (2 * kStep);
    }
    EXPECT_TRUE(near(J, difference, 1e-9)) << "seed " << seed;
    robot.set_configuration(q + kStep * v);
    robot.com_jacobian(Jh);
    const Vector3 ahead = Jh * v;
    robot.set_configuration(q - kStep * v);
    robot.com_jacobian(Jh);
    EXPECT_TRUE(near(drift, (ahead - Jh * v) / (2 * kStep), 1e-8)) << "seed " << seed;
  }
}

// a root, and bodies with several joints of every kind, few of them coordinates
constexpr const char* kManyJoints = R"(
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="root" pos="0 0 1"><freejoint/><geom size="0.1" pos="0.05 0 0.1" mass="3"/>
      <body name="stacked" pos="0.1 0.2 0.3" euler="0.3 0.2 0.1">
        <joint name="a" axis="0 1 0" pos="0.05 0 0"/>
        <joint name="b" type="slide" axis="1 0 1"/>
        <joint name="c" axis="1 0.2 0" pos="0 0.1 0.02"/>
        <geom size="0.1" pos="0 0 0.2" mass="2"/>
        <body name="hung" pos="0 0.1 0.2">
          <joint name="d" axis="0 0 1"/><joint name="e" type="ball" pos="0.1 0 0"/>
          <geom type="box" size="0.1 0.2 0.05" pos="0.1 0 0" euler="0.4 0 0" mass="1"/>
          <site name="tip" pos="0.1 0.2 0.3"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>)";

TEST(Robot, TwistCenterOfMassAndMomentumAreMuJoCos) {
  Robot robot(load_model_text(kManyJoints), {"a", "d"});
  const mjModel* const m = robot.model().get();
  const std::unique_ptr<mjData, void (*)(mjData*)> d(mj_makeData(m), mj_deleteData);
  const Frame tip = robot.frame("tip");
  for (unsigned seed = 0; seed < 10; ++seed) {
    RandomMotion random(seed);
    random.move(robot);
    const Vector qvel = random.vector(m->nv, 1.0);
    std::copy(robot.qpos().begin(), robot.qpos().end(), d->qpos);
    std::copy(qvel.begin(), qvel.end(), d->qvel);
    mj_forward(m, d.get());
    double wanted[6];
    mj_objectVelocity(m, d.get(), tip.type, tip.id, wanted, 0);
    const Twist twist = robot.twist(tip, qvel);
    EXPECT_TRUE(near(twist.angular, Eigen::Map<const Vector3>(wanted), 1e-12)) << seed;
    EXPECT_TRUE(near(twist.linear, Eigen::Map<const Vector3>(wanted + 3), 1e-12)) << seed;
    EXPECT_TRUE(near(robot.com(), Eigen::Map<const Vector3>(d->subtree_com + 3), 1e-12)) << seed;
    // by the coordinates alone
    const int a = robot.coordinates()[0].joints[0].dof, b = robot.coordinates()[1].joints[0].dof;
    Matrix J(3, 2), A(3, 2), full(3, m->nv);
    robot.com_jacobian(J);
    mj_jacSubtreeCom(m, d.get(), full.data(), 1);
    EXPECT_TRUE(near(J.col(0), full.col(a), 1e-12)) << seed;
    EXPECT_TRUE(near(J.col(1), full.col(b), 1e-12)) << seed;
    for (int dof = 0; dof < m->nv; ++dof)
      if (dof != a && dof != b) d->qvel[dof] = 0.0;
    mj_forward(m, d.get());
    mj_subtreeVel(m, d.get());
    robot.angular_momentum_jacobian(A);
    EXPECT_TRUE(near(A * Eigen::Vector2d(qvel[a], qvel[b]),
                     Eigen::Map<const Vector3>(d->subtree_angmom + 3), 1e-12))
        << seed;
  }
}

TEST(Robot, WhatHangsIsWhereTheModelHasItNow) {
  mjModel* const own = mj_copyModel(nullptr, load_model_text(kManyJoints).get());
  const ModelPtr model(own, [](const mjModel* m) { mj_deleteModel(const_cast<mjModel*>(m)); });
  Robot robot(model, {"a"});  // "hung" hangs
  const Frame hung = robot.frame("hung");
  const Vector3 before = robot.position(hung);
  const Vector qpos = robot.qpos();
  double& height = own->body_pos[3 * hung.id + 2];
  const double first = height;
  height += 0.5;
  robot.set_qpos(qpos);
  EXPECT_NEAR((robot.position(hung) - before).norm(), 0.5, 1e-14);
  height = first;
  robot.set_qpos(qpos);
  EXPECT_EQ(robot.position(hung), before);
}

TEST(Robot, SeparationIsWhatTheJacobiansOfBothPointsSay) {
  for (const char* support : {"", "leg_l"}) {
    Robot robot(load_model_text(kTwin));
    if (*support) robot.stand_on(support);
    for (const auto& [first, second] : {std::pair{"hand_l", "hand_r"},
                                        {"fa_l", "chest"},
                                        {"toe_l", "hand_r"},
                                        {"base", "ball"},
                                        {"ball", "head"}}) {
      RandomMotion random(7);
      random.move(robot);
      const Frame a = robot.frame(first), b = robot.frame(second);
      const Vector3 p = robot.position(a), q = robot.position(b), way = (q - p).normalized();
      Matrix Ja(3, 13), Jb(3, 13);
      robot.position_jacobian(a, Ja);
      robot.position_jacobian(b, Jb);
      const auto body_of = [&](Frame frame) {
        return frame.type == mjOBJ_SITE ? robot.model()->site_bodyid[frame.id] : frame.id;
      };
      Eigen::RowVectorXd row(13);
      robot.separation({body_of(a), p}, {body_of(b), q}, way, row);
      EXPECT_TRUE(near(row, way.transpose() * (Jb - Ja), 1e-12)) << first << " " << second;
    }
  }
}

TEST(Robot, LooseBodiesDoNotBelongToTheCenterOfMass) {
  Robot robot(load_model_text(kTwin));
  const Frame ball = robot.frame("ball");
  const Vector3 before = robot.com(), lay = robot.position(ball);
  const Vector there = robot.qpos();
  Vector qpos = there;
  qpos[0] += 5;  // the ball
  robot.set_qpos(qpos);
  EXPECT_TRUE(near(robot.com(), before, 1e-14));
  EXPECT_TRUE(near(robot.position(ball), lay + Vector3(5, 0, 0), 1e-14));
  robot.set_qpos(there);
  EXPECT_EQ(robot.position(ball), lay);
}

TEST(Robot, BaseGoesWhereQposPutsIt) {
  Robot robot(load_model_text(kTwin));
  Vector qpos = robot.qpos();
  const double half = std::sqrt(0.5);
  qpos.segment(7, 7) << 3, 4, 5, half, 0, 0, half;  // a quarter turn to the left
  robot.set_qpos(qpos);
  EXPECT_TRUE(near(robot.position(robot.frame("base")), Vector3(3, 4, 5), 1e-14));
  EXPECT_TRUE(near(robot.position(robot.frame("gaze")), Vector3(3, 4.1, 6), 1e-14));
  // and stays there when only the coordinates move
  robot.set_configuration(Vector::Zero(13));
  EXPECT_TRUE(near(robot.position(robot.frame("base")), Vector3(3, 4, 5), 1e-14));
}

TEST(Robot, CameraViewHasXAlongTheLineOfSight) {
  Robot robot(load_model_text(kTwin));
  EXPECT_TRUE(near(robot.view_orientation(robot.frame("eye")), Matrix3::Identity(), 1e-14));
  EXPECT_TRUE(near(robot.orientation(robot.frame("eye")).col(2), -Vector3::UnitX(), 1e-14));
}

TEST(Robot, KeyframeSetsTheWholePosture) {
  Robot robot(load_model_text(kArm));
  robot.set_keyframe("home");
  EXPECT_DOUBLE_EQ(robot.configuration()[3], 1.2);
  robot.set_keyframe("");
  EXPECT_DOUBLE_EQ(robot.configuration()[3], 0.0);
}

TEST(Robot, UnknownNamesAreAnsweredWithTheNamesThatExist) {
  Robot robot(load_model_text(kArm));
  EXPECT_EQ(error_text([&] { robot.set_keyframe("hmoe"); }),
            "keyframe 'hmoe' does not exist; there are: home, straight");
  EXPECT_EQ(error_text([&] { (void)robot.coordinate("j8"); }),
            "coordinate 'j8' does not exist; there are: j1, j2, j3, j4, j5, j6, j7");
  const std::string text = error_text([&] { (void)robot.frame("hnad"); });
  EXPECT_TRUE(contains(text, "frame 'hnad' does not exist; there are: goal, tip, world")) << text;
  EXPECT_TRUE(contains(text, "eye, forearm")) << text;
}

TEST(Robot, WrongSizesAndNumbersThatAreNoneAreErrors) {
  Robot robot(load_model_text(kArm));
  EXPECT_EQ(error_text([&] { robot.set_configuration(Vector::Zero(6)); }),
            "set_configuration wants 7 numbers, 6 came");
  Vector bad = Vector::Zero(7);
  bad[2] = std::nan("");
  EXPECT_EQ(error_text([&] { robot.set_configuration(bad); }),
            "set_configuration wants finite numbers, number 2 is nan");
  EXPECT_EQ(error_text([&] { robot.set_qpos(bad); }),
            "set_qpos wants finite numbers, number 2 is nan");
  bad[2] = HUGE_VAL;
  EXPECT_EQ(error_text([&] { robot.set_velocity(bad); }),
            "set_velocity wants finite numbers, number 2 is inf");
  // nothing changed
  EXPECT_TRUE(near(robot.configuration(), Vector::Zero(7), 0));
}

TEST(Robot, AnswersWantRoomOfTheirShape) {
  Robot robot(load_model_text(kArm));
  const Frame tip = robot.frame("tip");
  Matrix none, six = Matrix::Zero(3, 6), square = Matrix::Zero(6, 6), J = Matrix::Zero(3, 7);
  Vector short_one = Vector::Zero(6), whole = Vector::Zero(7);
  EXPECT_EQ(error_text([&] { robot.position_jacobian(tip, none); }),
            "position_jacobian wants a matrix of (3, 7), (0, 0) came");
  EXPECT_EQ(error_text([&] { robot.rotation_jacobian(tip, six); }),
            "rotation_jacobian wants a matrix of (3, 7), (3, 6) came");
  EXPECT_TRUE(contains(error_text([&] { robot.com_jacobian(six); }), "(3, 6) came"));
  EXPECT_TRUE(contains(error_text([&] { robot.angular_momentum_jacobian(six); }), "(3, 6) came"));
  EXPECT_EQ(error_text([&] { robot.mass_matrix(square); }),
            "mass_matrix wants a matrix of (7, 7), (6, 6) came");
  EXPECT_EQ(error_text([&] { robot.inverse_dynamics(short_one, whole); }),
            "inverse_dynamics: acceleration wants 7 numbers, 6 came");
  EXPECT_EQ(error_text([&] { robot.inverse_dynamics(whole, short_one); }),
            "inverse_dynamics: torque wants 7 numbers, 6 came");
  EXPECT_TRUE(contains(error_text([&] { (void)robot.twist(tip, short_one); }), "6 came"));
  EXPECT_TRUE(contains(error_text([&] { robot.point_jacobian(Vector3::Zero(), -1, J); }),
                       "a point wants a body from 0 to"));
  EXPECT_TRUE(contains(error_text([&] { (void)robot.point_drift(Vector3::Zero(), 99); }),
                       "a point wants a body from 0 to"));
}

TEST(Robot, AFrameThatTheModelHasNotIsAnError) {
  const Robot robot(load_model_text(kArm));
  const Vector qvel = Vector::Zero(7);
  for (const Frame none : {Frame{}, Frame{mjOBJ_SITE, -1}, Frame{mjOBJ_SITE, 99},
                           Frame{mjOBJ_BODY, 99}, Frame{mjOBJ_JOINT, 0}}) {
    const std::string text = error_text([&] { (void)robot.position(none); });
    EXPECT_TRUE(contains(text, "Robot::frame")) << none.type << " " << none.id;
    EXPECT_EQ(error_text([&] { (void)robot.orientation(none); }), text);
    EXPECT_EQ(error_text([&] { (void)robot.twist(none, qvel); }), text);
  }
}

TEST(Robot, OfOneNameTheSiteComesFirst) {
  const Robot robot(
      load_model_text("<mujoco><worldbody><body name='hand' pos='1 0 0'>"
                      "<site name='hand' pos='0 2 0'/></body></worldbody></mujoco>"));
  EXPECT_TRUE(near(robot.position(robot.frame("hand")), Vector3(1, 2, 0), 0));
}

TEST(Robot, AFollowingCameraIsNoFrame) {
  const Robot robot(
      load_model_text("<mujoco><worldbody><camera name='c' mode='targetbody' "
                      "target='b'/><body name='b'/></worldbody></mujoco>"));
  EXPECT_TRUE(contains(error_text([&] { (void)robot.frame("c"); }), "follows something"));
}

TEST(Robot, CopiesOfAModelHaveOneIdentity) {
  const Robot a(load_model_text(kArm)), b(load_model_text(kArm)), other(load_model_text(kTwin));
  EXPECT_EQ(a.identity(), b.identity());
  EXPECT_NE(a.identity(), other.identity());
}

// MuJoCo's own signature is the same for both names, and 0 in a file of its own
TEST(Robot, ModelsOfOtherNamesHaveOthersAndFilesOfMuJoCoTheSame) {
  const auto arm = [](const std::string& site) {
    return load_model_text(
        "<mujoco><worldbody><body><joint name='j'/><geom size='1'/><site name='" + site +
        "'/></body></worldbody></mujoco>");
  };
  const ModelPtr one = arm("tip");
  EXPECT_EQ(Robot(one).identity(), Robot(arm("tip")).identity());
  EXPECT_NE(Robot(one).identity(), Robot(arm("eye")).identity());
  const std::string path = testing::TempDir() + "identity.mjb";
  mj_saveModel(one.get(), path.c_str(), nullptr, 0);
  EXPECT_EQ(Robot(load_model(path)).identity(), Robot(one).identity());
}

}  // namespace

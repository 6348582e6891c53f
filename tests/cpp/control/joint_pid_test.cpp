// Strategy: the inverse-optimality conditions of the thesis' appendix, checked as matrices; then a
// two-joint arm with gravity, integrated here, that the servo must hold, move and load.
#include "hurcules/control/joint_pid.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "support/expect.hpp"
#include "support/random_motion.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

JointPidOptions gains(double K, double K_P, double K_I, double max_torque = 1e9) {
  JointPidOptions options;
  options.K = Vector::Constant(1, K);
  options.K_P = Vector::Constant(1, K_P);
  options.K_I = Vector::Constant(1, K_I);
  options.max_torque = Vector::Constant(1, max_torque);
  return options;
}

Vector one(double value) {
  return Vector::Constant(1, value);
}

// The matrices of the appendix for n joints with random gains, inertia and Coriolis terms.
struct Appendix {
  explicit Appendix(unsigned seed) : random(seed) {
    const Matrix half = random.vector(n * n, 1.0).reshaped(n, n);
    M = half * half.transpose() + Matrix::Identity(n, n);
    // M does not change here, so that C must be skew: dM/dt = C + C^T
    const Matrix any = random.vector(n * n, 1.0).reshaped(n, n);
    C = any - any.transpose();
    for (Index i = 0; i < n; ++i) {
      K_P(i, i) = random.uniform(1.0, 5.0);
      K_I(i, i) = random.uniform(0.05, 0.49) * K_P(i, i) * K_P(i, i);
      K(i, i) = random.uniform(0.5, 5.0);
    }
    const Matrix inverse = M.inverse();
    A.block(0, n, n, n).setIdentity();
    A.block(n, 2 * n, n, n).setIdentity();
    A.block(2 * n, 0, n, n) = -inverse * C * K_I;
    A.block(2 * n, n, n, n) = -inverse * C * K_P - K_I;
    A.block(2 * n, 2 * n, n, n) = -inverse * C - K_P;
    B.bottomRows(n) = inverse;
    P << K_I * M * K_I + K_I * K_P * K, K_I * M * K_P + K_I * K, K_I * M,  //
        K_P * M * K_I + K_I * K, K_P * M * K_P + K_P * K, K_P * M,         //
        M * K_I, M * K_P, M;                                               // [T A.2.8]
  }

  static constexpr Index n = 3;
  RandomMotion random;
  Matrix M, C, K = Matrix::Zero(n, n), K_P = Matrix::Zero(n, n), K_I = Matrix::Zero(n, n);
  Matrix A = Matrix::Zero(3 * n, 3 * n), B = Matrix::Zero(3 * n, n), P = Matrix(3 * n, 3 * n);
};

TEST(JointPid, LyapunovMatrixIsPositiveDefinite) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Appendix appendix(seed);
    const Eigen::LLT<Eigen::MatrixXd> factor(appendix.P);
    EXPECT_EQ(factor.info(), Eigen::Success) << "seed " << seed;
  }
}

TEST(JointPid, RiccatiEquationGivesTheStateWeightOfTheThesis) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Appendix a(seed);
    const Matrix Q = -(a.A.transpose() * a.P + a.P * a.A -
                       a.P * a.B * a.K * a.B.transpose() * a.P);  // [T A.2.11]
    Matrix wanted = Matrix::Zero(9, 9);
    wanted.block(0, 0, 3, 3) = a.K_I * a.K_I * a.K;
    wanted.block(3, 3, 3, 3) = (a.K_P * a.K_P - 2.0 * a.K_I) * a.K;
    wanted.block(6, 6, 3, 3) = a.K;
    EXPECT_TRUE(near(Q, wanted, 1e-9)) << "seed " << seed;
  }
}

TEST(JointPid, TorqueIsTheOptimalControlLaw) {
  const Appendix a(1);
  JointPidOptions options;
  options.K = a.K.diagonal();
  options.K_P = a.K_P.diagonal();
  options.K_I = a.K_I.diagonal();
  options.max_torque = Vector::Constant(3, 1e9);
  options.gamma = 0.7;
  options.dt = 0.01;
  JointPid pid(options);
  RandomMotion random(5);
  JointError error;
  for (int i = 0; i < 20; ++i) {
    error = {random.vector(3, 0.1), random.vector(3, 0.5)};
    pid.compute(error);
  }
  Vector x(9);
  x << pid.integral(), error.position, error.velocity;
  const Matrix R_inverse = a.K + Matrix::Identity(3, 3) / (0.7 * 0.7);  // [T A.2.6]
  const Vector wanted = R_inverse * a.B.transpose() * a.P * x;          // tau = -u
  EXPECT_TRUE(near(pid.torque(), wanted, 1e-10));
}

TEST(JointPid, RefusesGainsOutsideItsConditions) {
  EXPECT_EQ(error_text([] { JointPid pid(gains(1.0, 2.0, 1.9)); }), "");
  const std::string text = error_text([] { JointPid pid(gains(1.0, 2.0, 2.1)); });
  EXPECT_TRUE(contains(text, "K_P^2 > 2 K_I")) << text;
  EXPECT_TRUE(contains(error_text([] { JointPid pid(gains(-1.0, 2.0, 1.0)); }), "positive"));
  JointPidOptions sizes = gains(1.0, 2.0, 1.0);
  sizes.K_I = Vector::Constant(2, 1.0);
  EXPECT_TRUE(contains(error_text([&] { JointPid pid(sizes); }), "same size"));
  JointPidOptions gamma = gains(1.0, 2.0, 1.0);
  gamma.gamma = 0.0;
  EXPECT_TRUE(contains(error_text([&] { JointPid pid(gamma); }), "gamma"));
}

TEST(JointPid, SaturatesEachJointAndShowsWhatItWanted) {
  JointPid pid(gains(10.0, 20.0, 100.0, 3.0));
  EXPECT_EQ(pid.compute({one(1.0), one(0.0)})[0], 3.0);
  EXPECT_GT(pid.demand()[0], 200.0);
  EXPECT_EQ(pid.compute({one(-1.0), one(0.0)})[0], -3.0);
}

TEST(JointPid, DoesNotWindUpWhileSaturated) {
  // pressed against a stop for 10 s, then let go: the torque turns as soon as the error does
  JointPid pid(gains(10.0, 20.0, 100.0, 3.0));
  for (int i = 0; i < 10000; ++i) pid.compute({one(0.5), one(0.0)});
  EXPECT_LT(std::abs(pid.integral()[0]), 1e-2);
  EXPECT_LT(pid.compute({one(-0.05), one(0.0)})[0], 0.0);
}

TEST(JointPid, StillIntegratesOutOfSaturation) {
  JointPid pid(gains(10.0, 20.0, 100.0, 3.0));
  for (int i = 0; i < 100; ++i) pid.compute({one(0.001), one(0.0)});
  const double before = pid.integral()[0];
  EXPECT_GT(before, 0.0);
  pid.compute({one(-1.0), one(30.0)});  // saturated upward, the error leads back
  EXPECT_GT(pid.demand()[0], 3.0);
  EXPECT_LT(pid.integral()[0], before);
}

// Two joints that turn in a vertical plane; a load hangs at the end.
class Arm {
 public:
  explicit Arm(double load, double K_scale = 1.0, double gamma = 1.0)
      : load_(load), pid_(options(K_scale, gamma)) {}

  // largest error [rad] over 12 s of lifting and lowering, the first second left out; a torque of
  // this size [N m] shakes both joints at 2 Hz
  double largest_error(double shake = 0.0) {
    double largest = 0.0;
    for (int i = 0; i < 12000; ++i) {
      const double t = i * 1e-3, phase = 0.5 * t;
      const Vector2 q_des(0.3 + 0.4 * std::sin(phase), 1.0 - 0.5 * std::sin(phase));
      const Vector2 qd_des(0.2 * std::cos(phase), -0.25 * std::cos(phase));
      if (i == 0) {
        q_ = q_des;
        qd_ = qd_des;
      }
      const JointError error{q_des - q_, qd_des - qd_};
      const double push = shake * std::sin(4.0 * M_PI * t);
      move(pid_.compute(error) + Vector2(push, -push));
      if (i > 1000) largest = std::max(largest, error.position.cwiseAbs().maxCoeff());
    }
    return largest;
  }

  // errors [rad] of 3 s at rest, the servo switched on under the load
  struct Sag {
    double largest = 0.0, end = 0.0;
  };
  Sag sag(bool compensated) {
    Sag sag;
    q_ = Vector2(0.3, 1.0);
    for (int i = 0; i < 3000; ++i) {
      const JointError error{Vector2(0.3, 1.0) - q_, -qd_};
      const Vector2 weight = gravity();
      move(compensated ? pid_.compute(error, weight) : pid_.compute(error));
      sag.end = error.position.cwiseAbs().maxCoeff();
      sag.largest = std::max(sag.largest, sag.end);
    }
    return sag;
  }

 private:
  using Vector2 = Eigen::Vector2d;

  [[nodiscard]] Vector2 gravity() const {
    const double g = 9.81, m = 11.5 + load_, c = (11.5 * 0.30 + load_ * 0.44) / m;
    const double tip = m * c * g * std::cos(q_[0] + q_[1]);
    return {(30.0 * 0.2 + m * 0.4) * g * std::cos(q_[0]) + tip, tip};
  }

  static JointPidOptions options(double K_scale, double gamma) {
    JointPidOptions made = triple_pole({{10.0, 30.0, 1e9}, {2.5, 50.0, 1e9}}, 1e-3);
    made.K *= K_scale;
    made.gamma = gamma;
    return made;
  }

  // upper arm 0.4 m, 30 kg in its middle; lower arm 11.5 kg at 0.30 m; the load at 0.44 m from the
  // elbow, as in docs/design/robot.md#postures; rotors 2.6 and 0.9 kg m^2
  void move(const Vector2& torque) {
    const double l = 0.4, m = 11.5 + load_;
    const double c = (11.5 * 0.30 + load_ * 0.44) / m;
    const double J = 11.5 * 0.30 * 0.30 + load_ * 0.44 * 0.44 + 0.5;
    const double mcl = m * c * l * std::cos(q_[1]), h = m * c * l * std::sin(q_[1]);
    Eigen::Matrix2d M;
    M << 2.6 + 30.0 * 0.04 + m * l * l + J + 2.0 * mcl, J + mcl, J + mcl, J + 0.9;
    const Vector2 coriolis(-h * qd_[1] * (2.0 * qd_[0] + qd_[1]), h * qd_[0] * qd_[0]);
    qd_ += 1e-3 * M.inverse() * (torque - coriolis - gravity());
    q_ += 1e-3 * qd_;
  }

  double load_;
  JointPid pid_;
  Vector2 q_ = Vector2::Zero(), qd_ = Vector2::Zero();
};

TEST(JointPid, HoldsFourTenthsOfADegreeFromNoLoadTo60KilogramsAnArm) {
  // P06, P07: the same gains, no feed-forward; 7.0e-3 rad [T §A.3]
  for (const double load : {0.0, 15.0, 30.0, 60.0}) {
    EXPECT_LT(Arm(load).largest_error(), 7.0e-3) << load << " kg";
  }
}

TEST(JointPid, GravityFedForwardLeavesItsSagToNobody) {
  // the same arm at rest under 30 kg: the first instant bends it less, and the end is the same
  const Arm::Sag plain = Arm(30.0).sag(false), compensated = Arm(30.0).sag(true);
  EXPECT_GT(plain.largest, 1e-3);
  EXPECT_LT(compensated.largest, 1e-6);
  EXPECT_LT(plain.end, 1e-6);
  EXPECT_LT(compensated.end, 1e-6);
}

TEST(JointPid, ABoundedDisturbanceGivesABoundedErrorThatGrowsWithIt) {
  // P08: not asymptotic for a moving reference, but bounded (ISS)
  const double small = Arm(0.0).largest_error(5.0), large = Arm(0.0).largest_error(50.0);
  EXPECT_GT(Arm(0.0).largest_error(), 1e-6);
  EXPECT_LT(large, 7.0e-3);
  EXPECT_GT(large, small);
}

TEST(JointPid, AFourTimesLargerStateWeightHalvesTheErrorAtLeast) {
  // P04
  EXPECT_LT(Arm(30.0, 4.0).largest_error(), 0.5 * Arm(30.0).largest_error());
}

TEST(JointPid, ASmallerGammaRejectsDisturbancesBetter) {
  // P09; gamma changes nothing but the control weight
  EXPECT_LT(Arm(30.0, 1.0, 0.05).largest_error(), Arm(30.0, 1.0, 1.0).largest_error());
}

TEST(JointPid, TriplePoleBendsUnderALoadStepAsItsHeaderSays) {
  const double J = 2.0, omega = 20.0, step = 10.0;
  JointPid pid(triple_pole({{J, omega, 1e9}}, 1e-5));
  double q = 0.0, qd = 0.0, largest = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double torque = pid.compute({one(-q), one(-qd)})[0];
    qd += 1e-5 * (torque + step) / J;
    q += 1e-5 * qd;
    largest = std::max(largest, q);
  }
  EXPECT_NEAR(largest, 4.0 * std::exp(-2.0) / 2.0 * step / (J * omega * omega), 1e-5);
  EXPECT_NEAR(q, 0.0, 1e-6);
}

TEST(JointPid, ARestoredOneGivesTheSameBits) {
  JointPid pid(gains(10.0, 20.0, 100.0)), other(gains(10.0, 20.0, 100.0));
  for (int i = 0; i < 50; ++i) pid.compute({one(0.01 * i), one(0.1)});
  std::vector<double> state;
  StateWriter writer(state);
  pid.save(writer);
  StateReader reader(state);
  other.restore(reader);
  EXPECT_EQ(other.compute({one(0.3), one(0.2)}), pid.compute({one(0.3), one(0.2)}));
}

}  // namespace

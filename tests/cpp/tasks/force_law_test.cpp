// Strategy: the four laws on an ideal robot, s'' or s' exactly as asked, against a spring: steady
// states and settling of K01-K06 and K15-K16 where the thesis or a pencil gives them; the stability
// bound against the same loop simulated on both sides of it; the contact monitor and the stiffness
// estimate on made-up readings. Not tested here: the row in a stack (force_task_test.cpp).
#include "hurcules/tasks/force_law.hpp"

#include <cmath>
#include <limits>

#include "hurcules/tasks/contact_monitor.hpp"
#include "hurcules/tasks/stiffness_estimate.hpp"
#include "support/expect.hpp"
#include "support/random_motion.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ForceGains gains(ForceLoop loop, double C, double N = 0.0) {
  ForceGains made;
  made.loop = loop;
  made.compliance = C;
  made.integral = N;
  return made;
}

// A robot that does what it is asked, on a spring G whose rest position r is `below` the reference.
struct IdealContact {
  IdealContact(const ForceGains& g, double stiffness, double below = 0.0, int delay = 0)
      : law(g), G(stiffness), r(-below), late(delay > 0) {
    s = last = r;
  }
  void step() {
    const double f = G * ((late ? last : s) - r), dt = law.gains().dt;
    last = s;
    const double u = law.step({s, v}, f_d - f, 1.0);
    if (law.commands_acceleration()) {
      s += v * dt + 0.5 * u * dt * dt;
      v += u * dt;
    } else {
      s += u * dt;
    }
  }
  [[nodiscard]] double force() const { return G * (s - r); }
  // [s] after which the force stays within 5 % of its end
  double settle(double seconds) {
    std::vector<double> forces;
    for (int i = 0; i < seconds / law.gains().dt; ++i) {
      step();
      forces.push_back(force());
    }
    std::size_t i = forces.size();
    while (i > 0 && std::abs(forces[i - 1] - forces.back()) < 0.05 * std::abs(forces.back())) --i;
    return static_cast<double>(i) * law.gains().dt;
  }
  ForceLaw law;
  double G, r, f_d = -5.0, s = 0.0, v = 0.0, last = 0.0;
  bool late;
};

TEST(ForceLaw, FirstOrderReachesTheForceWithItsTimeConstant) {
  // K15: s' + C G s = ..., time constant 1 / (C G) = 0.1 s, no steady error
  IdealContact one(gains(ForceLoop::FirstOrder, 1e-3), 1e4);
  for (int i = 0; i < 100; ++i) one.step();
  EXPECT_NEAR(one.force(), -5.0 * (1.0 - std::exp(-1.0)), 0.02);
  for (int i = 0; i < 2000; ++i) one.step();
  EXPECT_NEAR(one.force(), -5.0, 1e-6);
}

TEST(ForceLaw, FasterWithMoreCompliance) {
  // K16; 3 time constants to 5 %
  IdealContact slow(gains(ForceLoop::FirstOrder, 5e-4), 1e4),
      fast(gains(ForceLoop::FirstOrder, 1e-3), 1e4);
  EXPECT_NEAR(slow.settle(3.0), 0.6, 0.01);
  EXPECT_NEAR(fast.settle(3.0), 0.3, 0.01);
}

TEST(ForceLaw, TheVelocityLoopReachesTheForceWithItsFrequencyAndDamping) {
  // K04: wn = sqrt(K C G / M) = 10, zeta = L / (2 sqrt(M K C G)) = 1: (1 + 10 t) exp(-10 t)
  IdealContact one(gains(ForceLoop::Velocity, 1e-4), 1e4);
  for (int i = 0; i < 200; ++i) one.step();
  EXPECT_NEAR(one.force(), -5.0 * (1.0 - 3.0 * std::exp(-2.0)), 0.03);
  for (int i = 0; i < 5000; ++i) one.step();
  EXPECT_NEAR(one.force(), -5.0, 1e-6);
}

TEST(ForceLaw, ThePositionLoopStaysOffByWhatTheThesisSays) {
  // K02: f = (C G f_d - G r) / (1 + C G), also with the ground 5 cm off
  for (const double below : {0.0, 0.001, -0.05}) {
    for (const double C : {1e-4, 1e-3}) {
      IdealContact one(gains(ForceLoop::Position, C), 1e4, below);
      for (int i = 0; i < 5000; ++i) one.step();
      const double CG = C * 1e4;
      EXPECT_NEAR(one.force(), (CG * -5.0 + 1e4 * below) / (1.0 + CG), 1e-6) << below << " " << C;
    }
  }
}

TEST(ForceLaw, IntegralActionIsStableUpToTheBoundOfRouth) {
  // K03: N < L (1 + C G) / (M G); C = 1e-4, G = 1e4: 20 * 2 / 1e4 = 4e-3
  const auto text = [](double N) {
    return error_text(
        [&] { check_force_gains(gains(ForceLoop::PositionIntegral, 1e-4, N), 1e4, "z"); });
  };
  EXPECT_EQ(text(3.6e-3), "");
  EXPECT_TRUE(contains(text(4.1e-3), "L (1 + C G) / (M G) = 0.004")) << text(4.1e-3);
  IdealContact inside(gains(ForceLoop::PositionIntegral, 1e-4, 3.6e-3), 1e4);
  IdealContact outside(gains(ForceLoop::PositionIntegral, 1e-4, 4.4e-3), 1e4);
  for (int i = 0; i < 20000; ++i) {
    inside.step();
    outside.step();
  }
  EXPECT_LT(std::abs(inside.force() + 5.0), 0.5);
  EXPECT_GT(std::abs(outside.force() + 5.0), 50.0);
}

TEST(ForceLaw, TheStableStiffnessOfTheFirstOrderLawIsThatOfCGdt) {
  // K15: C G dt < 1
  EXPECT_NEAR(largest_stiffness(gains(ForceLoop::FirstOrder, 1e-3)), 1e6, 200.0);
}

TEST(ForceLaw, GainsThatAreUnstableAreRefusedWithTheStiffnessThatIsNot) {
  const std::string text =
      error_text([] { check_force_gains(gains(ForceLoop::FirstOrder, 0.05), 1e5, "lforce"); });
  EXPECT_TRUE(contains(text, "'lforce' are stable up to an environment of 2e+04 N/m")) << text;
  EXPECT_EQ(error_text([] { check_force_gains(gains(ForceLoop::FirstOrder, 0.05), 1e3, "z"); }),
            "");
  EXPECT_TRUE(
      contains(error_text([] { check_force_gains(gains(ForceLoop::FirstOrder, -1.0), 0.0, "z"); }),
               "compliance"));
  EXPECT_TRUE(contains(
      error_text([] { check_force_gains(gains(ForceLoop::PositionIntegral, 1e-3), 0.0, "z"); }),
      "integral gain"));
}

ContactMonitor monitor(const ContactOptions& options = {}) {
  return {options, "z"};
}

TEST(ContactMonitor, EntersAtTheLeastForceAndLeavesBelowHalfOfIt) {
  // K12
  ContactMonitor one = monitor();
  EXPECT_EQ(one.look(-2.4, 0.0), ContactState::Free);
  EXPECT_EQ(one.look(-2.5, 0.0), ContactState::Contact);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(one.look(-1.5 - 1e-6 * i, 0.0), ContactState::Contact);
  for (int i = 0; i < 49; ++i) ASSERT_EQ(one.look(-1.0 + 1e-6 * i, 0.0), ContactState::Contact);
  one.look(0.0, 0.0);
  one.look(0.1, 0.0);
  EXPECT_EQ(one.look(0.0, 0.0), ContactState::Free);
}

TEST(ContactMonitor, StopsAboveTheLargestForceUntilReset) {
  // K13
  ContactMonitor one = monitor();
  EXPECT_EQ(one.look(-149.0, 0.0), ContactState::Contact);
  EXPECT_EQ(one.look(-151.0, 0.0), ContactState::Stopped);
  EXPECT_EQ(one.look(-5.0, 0.0), ContactState::Stopped);
  one.reset();
  EXPECT_EQ(one.look(0.0, 0.0), ContactState::Free);
}

TEST(ContactMonitor, BridgesAShortGapAndStopsAfterALongOne) {
  ContactMonitor one = monitor();
  one.look(-5.0, 0.0);
  for (int i = 0; i < 9; ++i) ASSERT_EQ(one.look(kNan, 0.0), ContactState::Contact) << i;
  EXPECT_EQ(one.force(), -5.0);
  EXPECT_EQ(one.look(-4.9, 0.0), ContactState::Contact);
  for (int i = 0; i < 12; ++i) one.look(kNan, 0.0);
  EXPECT_EQ(one.state(), ContactState::SensorLost);
}

TEST(ContactMonitor, AReadingThatStaysWhileTheFrameMovesIsALostSensor) {
  ContactMonitor one = monitor(), coarse = monitor({.frozen_move = 0.0}), still = monitor();
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(one.look(0.0, -1e-4 * i), ContactState::Free);
  for (int i = 0; i < 60; ++i) {  // 0.6 mm
    one.look(-5.0, -1e-5 * i);
    coarse.look(-5.0, -1e-5 * i);
    still.look(-5.0, 0.0);  // at rest a good sensor may say the same for ever
  }
  EXPECT_EQ(one.state(), ContactState::SensorLost);
  EXPECT_EQ(coarse.state(), ContactState::Contact);
  EXPECT_EQ(still.state(), ContactState::Contact);
}

TEST(ContactMonitor, RefusesBoundsThatCannotBe) {
  EXPECT_TRUE(contains(error_text([] { monitor({.f_min = 0.0}); }), "f_min"));
  EXPECT_TRUE(contains(error_text([] { monitor({.f_min = 5.0, .f_max = 4.0}); }), "f_max"));
}

TEST(StiffnessEstimate, LearnsAStiffnessFromAPressThroughNoise) {
  for (const double G : {1e3, 1e4, 1e5}) {
    RandomMotion random(4);
    StiffnessEstimate estimate({});
    estimate.start(0.0, -2.5);
    // 0.2 N of noise on a press that goes 20 N deep and back
    for (int i = 0; i < 4000; ++i) {
      const double depth = 20.0 / G * std::sin(2e-3 * i);
      estimate.look(-depth, -2.5 - G * depth + random.uniform(-0.2, 0.2));
    }
    EXPECT_NEAR(estimate.value(), G, 0.3 * G) << G;
  }
}

TEST(StiffnessEstimate, StaysWithinItsBoundsWhateverIsRead) {
  RandomMotion random(5);
  StiffnessEstimate estimate({});
  estimate.start(0.0, 0.0);
  EXPECT_EQ(estimate.value(), 1e6);
  for (int i = 0; i < 10000; ++i) {
    estimate.look(random.uniform(-1.0, 1.0), random.uniform(-200.0, 200.0));
    ASSERT_GE(estimate.value(), 100.0);
    ASSERT_LE(estimate.value(), 1e6);
  }
}

}  // namespace

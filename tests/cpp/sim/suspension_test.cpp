// Strategy: the springs of the tracks do what they are for, against the same robot with its springs
// locked: over boards and over a rough road at 20 km/h the trunk is shaken less (H11); they stand
// on their stops under every working load, and yield above their preload in both positions of the
// lower legs, as far as a hand computes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "support/rover.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kSpeed = 5.56, kStiffness = 5e4;

double spring(const Rover& rover, const char* name) {
  const mjModel& m = rover.m();
  return rover.physics.data()->qpos[m.jnt_qposadr[mj_name2id(&m, mjOBJ_JOINT, name)]];
}

void lock_springs(const mjModel& m) {
  for (int joint = 0; joint < m.njnt; ++joint) {
    const std::string name = mj_id2name(&m, mjOBJ_JOINT, joint);
    if (name.find("_spring") == std::string::npos) continue;
    m.jnt_range[2 * joint] = -1e-5;
    m.jnt_range[2 * joint + 1] = 1e-5;
  }
}

struct Shaking {
  double rms = 0.0, peak = 0.0;  // [m/s^2] vertical, of the knee frame
};

Shaking ride(const std::string& ground, double seconds, bool locked) {
  Rover rover({.more = ground});
  if (locked) lock_springs(rover.m());
  rover.d().qvel[0] = kSpeed;
  for (const int belt : rover.physics.tracks().belts()) {
    rover.d().qvel[rover.m().jnt_dofadr[belt]] = kSpeed / Rover::kRadius;
  }
  Shaking shaking;
  int counted = 0;
  for (int i = 0; i < std::lround(1e3 * seconds); ++i) {
    rover.step(kSpeed, kSpeed);
    if (i < 200) continue;
    const double up = rover.d().qacc[2];
    shaking.rms += up * up;
    shaking.peak = std::max(shaking.peak, std::abs(up));
    ++counted;
  }
  EXPECT_GT(rover.d().qpos[0], 0.9 * kSpeed * seconds);
  shaking.rms = std::sqrt(shaking.rms / counted);
  return shaking;
}

std::string box(double x, double half, double height) {
  return "<geom class=\"terrain\" type=\"box\" size=\"" + std::to_string(half) + " 1 " +
         std::to_string(height / 2.0) + "\" pos=\"" + std::to_string(x) + " 0 " +
         std::to_string(height / 2.0) + "\"/>";
}

TEST(Suspension, HalvesTheShakingOverBoardsAtTwentyKilometresAnHour) {
  const std::string boards = box(3.0, 0.1, 0.01) + box(5.0, 0.1, 0.02) + box(7.0, 0.1, 0.02);
  const Shaking rigid = ride(boards, 2.0, true), sprung = ride(boards, 2.0, false);
  std::printf("boards: rms %.1f to %.1f, peak %.0f to %.0f m/s^2\n", rigid.rms, sprung.rms,
              rigid.peak, sprung.peak);
  EXPECT_LT(sprung.rms, 0.6 * rigid.rms);
  EXPECT_LT(sprung.peak, 0.5 * rigid.peak);
}

// steps of 0.25 m with the heights of ISO 8608 class D: sum of waves from 0.1 to 2 cycles/m
TEST(Suspension, LowersTheShakingOverARoughRoad) {
  std::string road;
  for (int i = 0; i < 60; ++i) {
    double height = 0.03;
    for (int wave = 1; wave <= 20; ++wave) {
      const double n = 0.1 * wave, density = 1024e-6 * std::pow(n / 0.1, -2.0);
      const double x = 1.0 + 0.25 * i, phase = 2.399963 * wave * wave;
      height += std::sqrt(2.0 * density * 0.1) * std::sin(2.0 * std::numbers::pi * n * x + phase);
    }
    if (height > 1e-3) road += box(1.5 + 0.25 * i, 0.125, height);
  }
  const Shaking rigid = ride(road, 2.0, true), sprung = ride(road, 2.0, false);
  std::printf("road: rms %.1f to %.1f, peak %.0f to %.0f m/s^2\n", rigid.rms, sprung.rms,
              rigid.peak, sprung.peak);
  EXPECT_LT(sprung.rms, 0.8 * rigid.rms);
}

// preloads 2400, 4200 and 7000 N against at most 3924 N on a lower leg: 800 kg on both
class Standing : public testing::TestWithParam<std::string> {};
TEST_P(Standing, IsOnTheStopsAlsoWithACasualty) {
  Rover rover({.payload = 120.0}, GetParam());
  const double height = rover.d().qpos[2];
  rover.brake_belts();
  rover.go(0.0, 0.0, 1.0);
  EXPECT_NEAR(rover.d().qpos[2], height, 1e-3);
  for (const char* name : {"L_lower_spring", "R_lower_spring", "L_lower_spring_front",
                           "R_lower_spring_front", "L_upper_spring", "R_upper_spring"}) {
    EXPECT_NEAR(spring(rover, name), 0.0, 5e-4) << name;
  }
}
INSTANTIATE_TEST_SUITE_P(Keys, Standing, testing::Values("drive", "ready", "acquisition", "carry"));

// A track is pushed up against its leg, which is pushed down as much: the spring that lies below
// gives by (push - weight of the track - preload) / stiffness, in both positions of the leg.
TEST(Suspension, YieldsAboveItsPreloadInBothPositionsOfTheLegs) {
  for (const bool front : {false, true}) {
    const double preload = front ? 7000.0 : 2400.0;
    Rover rover({}, "drive");
    const mjModel& m = rover.m();
    for (const char* knee : {"LKN", "RKN"}) {
      rover.d().qpos[m.jnt_qposadr[mj_name2id(&m, mjOBJ_JOINT, knee)]] =
          front ? std::numbers::pi : 0.0;
    }
    rover.brake_belts();
    const int track = mj_name2id(&m, mjOBJ_BODY, "L_lower_track");
    const double weight = m.body_mass[track] * 9.81, push = preload + weight + 0.02 * kStiffness;
    rover.d().xfrc_applied[6 * track + 2] = push;
    rover.d().xfrc_applied[6 * m.body_parentid[track] + 2] = -push;
    rover.go(0.0, 0.0, 1.5);
    const double back = spring(rover, "L_lower_spring"),
                 forth = -spring(rover, "L_lower_spring_front");
    EXPECT_NEAR(front ? forth : back, 0.02, 5e-4);
    EXPECT_LT(std::abs(front ? back : forth), 5e-4);
  }
}

}  // namespace

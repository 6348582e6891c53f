// Strategy: the rescue robot on its tracks against what theory says of 680 kg on a plane: speed,
// traction at the limit of friction, turning in place under the loads that each contact point
// really has, slopes, power (claims H06 to H09). The turning theory is Coulomb's law alone: the
// motion at which friction dissipates least, found by descent. Not tested: obstacles
// (test_scene_drive.py), turning above 0.5 m/s of belt speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "support/rover.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kGravity = 9.81, kThirty = std::numbers::pi / 6;

TEST(Driving, StraightIsAsFastAsTheBeltsAndTheSlipIsSensed) {
  Rover rover;
  rover.go(1.0, 1.0, 3.0);
  const double belt = rover.belt(0) * Rover::kRadius, speed = rover.d().qvel[0];
  EXPECT_NEAR(speed, belt, 0.005 * belt);
  EXPECT_NEAR(rover.ground().slip, belt - speed, 1e-3);
  EXPECT_NEAR(rover.ground().load, rover.mass() * kGravity, 0.01 * rover.mass() * kGravity);
}

// The greatest traction is mu W cos(theta): below tan(theta) the belts turn and the robot slides.
TEST(Driving, StallsWhereTheSlopeAsksForMoreThanFrictionGives) {
  Rover rover({.slope = kThirty, .friction = 0.5});
  rover.go(0.6, 0.6, 2.0);
  const double limit = 0.5 * rover.mass() * kGravity * std::cos(kThirty);
  EXPECT_NEAR(rover.ground().traction, limit, 0.03 * limit);
  const double slide = kGravity * (std::sin(kThirty) - 0.5 * std::cos(kThirty));
  EXPECT_NEAR(rover.d().qvel[0], -2.0 * slide, 0.1 * 2.0 * slide);
  EXPECT_GT(rover.ground().slip, 1.0);
}

// H07: loaded with 120 kg and unloaded: tan(30 deg) = 0.577, no rolling resistance here
class Slope : public testing::TestWithParam<double> {};
TEST_P(Slope, OfThirtyDegreesIsClimbedHeldAndDescended) {
  Rover rover({.slope = kThirty, .friction = 0.65, .payload = GetParam()});
  rover.go(0.5, 0.5, 3.0);
  EXPECT_GT(rover.d().qpos[0], 1.0);
  EXPECT_NEAR(rover.d().qvel[0], rover.belt(0) * Rover::kRadius, 0.01);
  const double needed = rover.mass() * kGravity * std::sin(kThirty);
  EXPECT_NEAR(rover.ground().traction, needed, 0.02 * needed);
  rover.go(0.0, 0.0, 0.5);
  rover.brake_belts();
  rover.go(0.0, 0.0, 0.5);
  const double held = rover.d().qpos[0];
  rover.go(0.0, 0.0, 2.0);
  EXPECT_NEAR(rover.d().qpos[0], held, 4e-3);  // less than 2 mm/s near the limit of friction
  Rover down({.slope = kThirty, .friction = 0.65, .payload = GetParam()});
  down.go(-0.5, -0.5, 3.0);
  EXPECT_NEAR(down.d().qvel[0], down.belt(0) * Rover::kRadius, 0.01);
  EXPECT_LT(down.d().qpos[0], -1.3);
}
INSTANTIATE_TEST_SUITE_P(Payload, Slope, testing::Values(0.0, 120.0));

// no power at all: every brake shut
class Hold : public testing::TestWithParam<std::array<double, 2>> {};
TEST_P(Hold, OnThirtyDegreesDoesNotCreep) {
  Rover rover({.slope = kThirty, .up = GetParam()});
  rover.brake_belts();
  rover.go(0.0, 0.0, 1.0);
  const std::array<double, 2> before{rover.d().qpos[0], rover.d().qpos[1]};
  rover.go(0.0, 0.0, 3.0);
  EXPECT_LT(std::hypot(rover.d().qpos[0] - before[0], rover.d().qpos[1] - before[1]), 3e-3);
  EXPECT_LT(std::abs(rover.belt(0)), 1e-4);
}
INSTANTIATE_TEST_SUITE_P(UpDownAcross, Hold,
                         testing::Values(std::array<double, 2>{-1.0, 0.0},
                                         std::array<double, 2>{1.0, 0.0},
                                         std::array<double, 2>{0.0, 1.0}));

struct Point {
  double x, y, load, belt;  // [m], [m] from the centre of mass, [N], [m/s] of the surface
};

// Sum of N |slip| at a motion of the centre (x, y) [m/s] and yaw rate: convex, least where Coulomb
// friction is in balance.
double dissipation(const std::vector<Point>& points, const std::array<double, 3>& motion) {
  double sum = 0.0;
  for (const Point& p : points) {
    sum += p.load * std::hypot(motion[0] - motion[2] * p.y - p.belt, motion[1] + motion[2] * p.x);
  }
  return sum;
}

double yaw_by_coulomb(const std::vector<Point>& points) {
  std::array<double, 3> best{};
  for (double size = 0.2; size > 1e-6;) {
    bool better = false;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const double sign : {-1.0, 1.0}) {
        std::array<double, 3> next = best;
        next[i] += sign * size;
        if (dissipation(points, next) >= dissipation(points, best)) continue;
        best = next;
        better = true;
      }
    }
    if (!better) size *= 0.5;
  }
  return best[2];
}

// contact points with their loads, in the axes of the robot, which stands level
std::vector<Point> contact_points(Rover& rover) {
  std::vector<Point> points;
  const mjData& d = rover.d();
  const mjtNum* const axes = d.xmat + 9 * mj_name2id(&rover.m(), mjOBJ_BODY, "upper_legs");
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& contact = d.contact[i];
    if (contact.efc_address < 0) continue;
    const double dx = contact.pos[0] - rover.centre()[0], dy = contact.pos[1] - rover.centre()[1];
    const double x = axes[0] * dx + axes[3] * dy, y = axes[1] * dx + axes[4] * dy;
    const std::size_t side = y > 0.0 ? 0 : 1;
    points.push_back({x, y, d.efc_force[contact.efc_address], rover.belt(side) * Rover::kRadius});
  }
  return points;
}

// H09: once round, and as fast as Coulomb's law says under the true loads
TEST(Driving, TurnsInPlaceAsCoulombsLawSaysAndStaysWhereItIs) {
  Rover rover;
  rover.go(-0.3, 0.3, 2.0);
  const std::array<double, 2> start{rover.centre()[0], rover.centre()[1]};
  double turned = 0.0, drift = 0.0, ratio = 0.0;
  int seen = 0;
  for (int i = 0; i < 20000 && turned < 2.0 * std::numbers::pi; ++i) {
    rover.step(-0.3, 0.3);
    turned += 1e-3 * rover.d().qvel[5];
    drift = std::max(drift, std::hypot(rover.centre()[0] - start[0], rover.centre()[1] - start[1]));
    if (i % 500 != 0) continue;
    ratio += rover.d().qvel[5] / yaw_by_coulomb(contact_points(rover));
    ++seen;
  }
  std::printf("turn: %.3f of Coulomb's law, drift of the centre %.3f m\n", ratio / seen, drift);
  EXPECT_GE(turned, 2.0 * std::numbers::pi);
  EXPECT_NEAR(ratio / seen, 1.0, 0.03);
  EXPECT_LT(drift, 0.10);
}

// the leg turned over by pi runs over the ground the same way
TEST(Driving, GoesTheSameWayWithTheLegsTurnedOver) {
  Rover back, front;
  for (const char* knee : {"LKN", "RKN"}) {
    const int joint = mj_name2id(&front.m(), mjOBJ_JOINT, knee);
    front.d().qpos[front.m().jnt_qposadr[joint]] = std::numbers::pi;
  }
  mj_forward(&front.m(), &front.d());
  back.go(0.5, 0.5, 2.0);
  front.go(0.5, 0.5, 2.0);
  EXPECT_GT(back.d().qpos[0], 0.9);
  EXPECT_NEAR(front.d().qpos[0], back.d().qpos[0], 0.01);
}

// a climb under way: motor work = height + motion + slip at the ground + damping of the belts
TEST(Driving, PowerIsBalancedWithinFivePercent) {
  Rover rover({.slope = 0.35});
  rover.go(0.8, 0.8, 1.0);
  const double start = rover.d().qpos[0], before = rover.work;
  const auto kinetic = [&] {
    return 0.5 * (rover.mass() * std::pow(rover.d().qvel[0], 2) +
                  (2.0 * 0.65 + 2.0 * 0.2) * std::pow(rover.belt(0), 2));
  };
  const double energy = kinetic();
  double lost = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double speed = 0.8 + 0.2e-3 * i;
    rover.step(speed, speed);
    lost += 1e-3 * rover.ground().traction * rover.ground().slip;
    lost += 1e-3 * 4.0 * 0.1 * std::pow(rover.belt(0), 2);
  }
  const double height = std::sin(0.35) * (rover.d().qpos[0] - start);
  const double gained = rover.mass() * kGravity * height + kinetic() - energy + lost;
  std::printf("climb: work %.0f J, gained and lost %.0f J\n", rover.work - before, gained);
  EXPECT_NEAR(rover.work - before, gained, 0.05 * gained);
}

// H06, H08: up to 20 km/h at 2 m/s^2
TEST(Driving, ReachesTwentyKilometresAnHourThroughEveryGear) {
  Rover rover;
  double ratio = rover.physics.drive_train().ratio(rover.drive[0]), seconds = 0.0;
  double most_power = 0.0, most_torque = 0.0;
  EXPECT_EQ(ratio, 3.0);
  while (rover.d().qvel[0] < 5.5 && seconds < 5.0) {
    const double speed = std::min(2.0 * seconds, 5.58);
    rover.step(speed, speed);
    seconds += 1e-3;
    const double now = rover.physics.drive_train().ratio(rover.drive[0]);
    EXPECT_LE(now, ratio + 1e-3);  // it only shifts up
    ratio = now;
    const double torque = rover.d().actuator_force[rover.drive[0]];
    most_power = std::max(most_power, torque * rover.belt(0));
    most_torque = std::max(most_torque, torque / ratio);
  }
  // kinetic energy of robot and belts, and their damping while w grows evenly
  const double w = rover.belt(0);
  const double theory = 0.5 * rover.mass() * 5.5 * 5.5 + 0.5 * 2.0 * (0.65 + 0.2) * w * w +
                        4.0 * 0.1 * w * w * seconds / 3.0;
  std::printf("20 km/h: %.2f s, %.1f kJ work (theory %.1f), %.1f kJ electric, at most %.0f W\n",
              seconds, 1e-3 * rover.work, 1e-3 * theory, 1e-3 * rover.energy, most_power);
  EXPECT_LT(seconds, 3.5);
  EXPECT_LT(ratio, 1.15);
  EXPECT_LT(most_power, 7950.0 * 1.01);
  EXPECT_LT(most_torque, 200.0 * 1.01);
  EXPECT_NEAR(rover.work, theory, 0.02 * theory);
}

}  // namespace

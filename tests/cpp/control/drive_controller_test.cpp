// Strategy: the controller on the smallest tracked vehicle (support/track_plant.hpp), whose skid,
// friction and slope are known, so that what comes out can be reckoned by hand. Not tested here:
// the robot itself, whose physics tests/python/test_drive.py drives.
#include "hurcules/control/drive_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "support/track_plant.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kDt = 1e-3;

// turns about the origin of its pose
DriveOptions plain() {
  DriveOptions options;
  options.parking.turn_centre = 0.0;
  return options;
}

struct Vehicle {
  explicit Vehicle(const DriveOptions& options = plain()) : controller(options) {}
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kDt)); ++i) step();
  }
  void step() {
    const double before = plant.state.speed;
    torques = controller.compute(plant.state);
    plant.step(torques, kDt);
    hardest = std::max(hardest, std::abs(plant.state.speed - before) / kDt);
  }
  DriveController controller;
  TrackPlant plant;
  DriveTorques torques;
  double hardest = 0.0;  // [m/s^2]
};

TEST(DriveController, ReachesTheSpeedThatIsAskedFor) {
  for (const double speed : {0.5, -0.5, 5.0}) {
    Vehicle vehicle;
    vehicle.controller.drive({speed, 0.0});
    vehicle.run(5.0);
    EXPECT_NEAR(vehicle.plant.state.speed, speed, 0.01 * std::abs(speed));
    EXPECT_LT(vehicle.hardest, 1.3 * vehicle.controller.options().forward.acceleration);
    EXPECT_NEAR(vehicle.plant.state.yaw_rate, 0.0, 1e-6);
  }
}

TEST(DriveController, StopsAndShutsTheBrakesWithoutTorque) {
  Vehicle vehicle;
  vehicle.controller.drive({0.5, 0.0});
  vehicle.run(3.0);
  EXPECT_FALSE(vehicle.torques.brake);
  vehicle.controller.drive({});
  vehicle.run(2.0);
  EXPECT_TRUE(vehicle.torques.brake);
  EXPECT_EQ(vehicle.torques.left, 0.0);
  EXPECT_EQ(vehicle.torques.right, 0.0);
  EXPECT_NEAR(vehicle.plant.state.speed, 0.0, 1e-3);
}

TEST(DriveController, LearnsTheEffectiveGaugeAndTurnsAsAsked) {
  for (const double skid : {0.5, 0.75, 1.0}) {
    Vehicle vehicle;
    vehicle.plant.skid = skid;
    vehicle.controller.drive({0.0, 0.6});
    vehicle.run(5.0);
    EXPECT_NEAR(vehicle.plant.state.yaw_rate, 0.6, 0.01);
    EXPECT_NEAR(vehicle.controller.gauge(), 0.67 / skid, 0.01 * 0.67 / skid);
  }
}

// From a straight, at once: the belts may lead the ground by 0.23 m/s here, and have to by 0.4.
TEST(DriveController, LearnsTheGaugeInATurnThatTheSlipLimitHoldsBack) {
  Vehicle vehicle;
  vehicle.plant.skid = 0.5;
  vehicle.controller.drive({0.0, 1.2});
  vehicle.run(5.0);
  EXPECT_NEAR(vehicle.plant.state.yaw_rate, 1.2, 0.02);
}

// Where tracks bear at their ends they skid, and the gauge that is learnt there is twice too wide
// for other ground. Belts that followed the ground by it would spin the vehicle faster and faster.
TEST(DriveController, AGaugeLearntElsewhereStillBrakesATurnThatIsTooFast) {
  Vehicle vehicle;
  vehicle.plant.skid = 0.5;
  vehicle.controller.drive({0.0, 0.5});
  vehicle.run(5.0);
  ASSERT_NEAR(vehicle.controller.gauge(), 2.0 * 0.67, 0.02);
  DriveState fast;
  fast.yaw_rate = 1.5;
  // without skid
  fast.right = 1.5 * 0.67 / 2.0 / 0.14;
  fast.left = -fast.right;
  const DriveTorques torques = vehicle.controller.compute(fast);
  EXPECT_LT(torques.right, 0.0);
  EXPECT_GT(torques.left, 0.0);
}

TEST(DriveController, KeepsABeltFromSpinningWhereItsSpeedIsNotTheGrounds) {
  Vehicle vehicle;
  vehicle.plant.stuck = true;
  vehicle.controller.drive({1.0, 0.0});
  vehicle.run(3.0);
  EXPECT_TRUE(vehicle.controller.slipping());
  // no faster than the slip limit, and pulling still
  EXPECT_LE(0.14 * vehicle.plant.state.left, vehicle.controller.options().slip_speed + 0.01);
  EXPECT_GT(vehicle.torques.left, 100.0);
}

TEST(DriveController, OnIceTheBeltsFollowTheGroundAndTheVehicleStillGoes) {
  Vehicle vehicle;
  vehicle.plant.friction = 0.05;
  vehicle.controller.drive({2.0, 0.0});
  double most = 0.0;
  for (int i = 0; i < 3000; ++i) {
    vehicle.step();
    const DriveState& state = vehicle.plant.state;
    most = std::max(most, 0.14 * state.left - state.speed);
  }
  EXPECT_LT(most, 0.2 + 0.1 * 2.0 + 0.02);
  // all that friction gives: mu g t
  EXPECT_NEAR(vehicle.plant.state.speed, 0.05 * 9.81 * 3.0, 0.15);
}

TEST(DriveController, OnASlopeItStartsWithoutRollingBack) {
  Vehicle vehicle;
  vehicle.plant.slope = 0.3;
  vehicle.controller.drive({0.3, 0.0});
  vehicle.run(3.0);
  vehicle.controller.drive({});
  vehicle.run(2.0);
  ASSERT_TRUE(vehicle.torques.brake);
  vehicle.controller.drive({0.3, 0.0});
  double back = 0.0;
  for (int i = 0; i < 1000; ++i) {
    vehicle.step();
    back = std::min(back, vehicle.plant.state.speed);
  }
  EXPECT_GT(back, -0.01);
  EXPECT_GT(vehicle.plant.state.speed, 0.1);
}

TEST(DriveController, AFastVehicleThatIsToTurnSlowsDown) {
  Vehicle vehicle;
  vehicle.controller.drive({5.0, 1.0});
  vehicle.run(8.0);
  EXPECT_NEAR(vehicle.plant.state.speed, 2.5, 0.05);  // max_sideways / yaw rate
  EXPECT_NEAR(vehicle.plant.state.yaw_rate, 1.0, 0.02);
}

TEST(DriveController, PowerLimitsDrivingAndNotBraking) {
  Vehicle vehicle;
  vehicle.controller.drive({5.0, 0.0});
  vehicle.run(4.0);
  DriveState state = vehicle.plant.state;
  const double most = vehicle.controller.options().max_power / state.left;
  state.left -= 10.0;   // far too slow
  state.right += 10.0;  // far too fast
  const DriveTorques torques = vehicle.controller.compute(state);
  EXPECT_NEAR(torques.left, vehicle.controller.options().max_power / state.left, 1e-9);
  EXPECT_LT(torques.right, -2.0 * most);
}

TEST(DriveController, BehindATransmissionPowerLimitsBrakingToo) {
  DriveOptions options;
  options.max_braking_power = 7000.0;
  DriveController controller(options);
  controller.drive({1.0, 0.0});
  for (int i = 0; i < 2000; ++i) controller.compute({1.0 / 0.14, 1.0 / 0.14, 0.0, 1.0, {}});
  const DriveTorques slow = controller.compute({2.0 / 0.14, 2.0 / 0.14, 0.0, 1.0, {}});
  EXPECT_NEAR(slow.left, -7000.0 / (2.0 / 0.14), 1e-9);
  options.max_braking_power = 0.0;
  EXPECT_THROW(DriveController{options}, Error);
}

TEST(DriveController, WherePowerLacksTheSpeedGivesWayToTurning) {
  Vehicle vehicle;
  vehicle.plant.scrub = 257.0 / 0.14;  // what the robot needs at friction 0.9, docs/drive.md
  vehicle.controller.drive({5.0, 0.0});
  vehicle.run(4.0);
  ASSERT_NEAR(vehicle.plant.state.speed, 5.0, 0.05);
  vehicle.controller.drive({5.0, 0.15});
  vehicle.run(4.0);
  EXPECT_NEAR(vehicle.plant.state.yaw_rate, 0.15, 0.01);
  // the outer belt, 0.07 m/s faster than the robot, gives 257 N m below power / torque
  const double fastest = 7950.0 / 257.0 * 0.14;
  EXPECT_LT(vehicle.plant.state.speed, fastest);
  EXPECT_GT(vehicle.plant.state.speed, fastest - 0.3);
  vehicle.controller.drive({5.0, 0.0});
  vehicle.run(4.0);
  EXPECT_NEAR(vehicle.plant.state.speed, 5.0, 0.05);
}

TEST(DriveController, WhereBothDrivesLackPowerItSlowsDownUntilItTurns) {
  for (const double speed : {5.0, -5.0}) {
    DriveOptions options;
    options.max_power = options.max_braking_power = 7543.0;  // behind the robot's transmission
    Vehicle vehicle(options);
    vehicle.plant.scrub = 257.0 / 0.14;
    vehicle.controller.drive({speed, 0.0});
    vehicle.run(4.0);
    ASSERT_NEAR(vehicle.plant.state.speed, speed, 0.05);
    vehicle.controller.drive({speed, 0.15});
    vehicle.run(8.0);
    EXPECT_NEAR(vehicle.plant.state.yaw_rate, 0.15, 0.01) << speed;
    EXPECT_LT(std::abs(vehicle.plant.state.speed), 7543.0 / 257.0 * 0.14) << speed;
    EXPECT_GT(std::abs(vehicle.plant.state.speed), 3.0) << speed;
  }
}

// A left turn, then full speed, where the drives lack power and friction keeps the vehicle straight:
// told to turn right it is to get all that there is, nothing held back by the left turn.
TEST(DriveController, ShortOfPowerTheDrivesDoNotKeepTheTorquesOfTheLastTurn) {
  DriveOptions options;
  options.max_power = options.max_braking_power = 7543.0;
  DriveController controller(options);
  controller.drive({1.0, 0.5});
  for (int i = 0; i < 1000; ++i) {  // turns with nine tenths of the reference
    const auto [speed, yaw_rate] = controller.reference();
    const double turn = 0.9 * yaw_rate, half = turn * controller.gauge() / 2.0;
    controller.compute(
        {(speed - half) / options.radius, (speed + half) / options.radius, turn, speed, {}});
  }
  const double fast = 4.4 / options.radius;
  DriveTorques torques;
  for (const double yaw_rate : {0.0, -0.3}) {
    controller.drive({5.56, yaw_rate});
    for (int i = 0; i < 4000; ++i) torques = controller.compute({fast, fast, 0.0, 4.4, {}});
  }
  EXPECT_NEAR(torques.right, -7543.0 / fast, 1e-9);
  EXPECT_NEAR(torques.left, 0.0, 1e-9);  // it slows down: the difference that it wants wants power
}

TEST(DriveController, ParksAtPosesInAllDirections) {
  constexpr double kPi = std::numbers::pi;
  for (const PlanarPose& goal :
       {PlanarPose{3.0, 0.5, 0.3}, PlanarPose{-2.0, 1.0, kPi}, PlanarPose{0.3, 0.0, 0.0},
        PlanarPose{0.0, 1.5, kPi / 2}, PlanarPose{0.0, 0.05, 0.0}, PlanarPose{1.0, -2.0, -2.0}}) {
    Vehicle vehicle;
    vehicle.plant.sideways = 0.05;
    vehicle.controller.park(goal);
    const auto under_way = [&] { return vehicle.controller.parking_phase() < ParkingPhase::Done; };
    for (int i = 0; i < 90000 && under_way(); ++i) vehicle.step();
    vehicle.run(1.0);
    const PlanarPose& pose = vehicle.plant.state.pose;
    EXPECT_EQ(vehicle.controller.parking_phase(), ParkingPhase::Done);
    EXPECT_LT(std::hypot(pose.x - goal.x, pose.y - goal.y), 0.03) << goal.x << ' ' << goal.y;
    EXPECT_LT(std::abs(wrap_angle(pose.yaw - goal.yaw)), 0.035) << goal.x << ' ' << goal.y;
    EXPECT_TRUE(vehicle.torques.brake);
  }
}

TEST(DriveController, ParkingThatCannotSucceedEnds) {
  DriveOptions options = plain();
  options.parking.max_offset = 1e-9;
  options.parking.attempts = 2;
  Vehicle vehicle(options);
  vehicle.controller.park({2.0, 0.2, 0.1});
  vehicle.run(60.0);
  EXPECT_EQ(vehicle.controller.parking_phase(), ParkingPhase::Failed);
  EXPECT_TRUE(vehicle.torques.brake);
}

TEST(DriveController, ParkingThatComesToNoEndFails) {
  Vehicle vehicle;
  vehicle.plant.stuck = true;  // the line is never driven
  vehicle.controller.park({2.0, 0.0, 0.0});
  // patience times 1 m at 0.5 m/s, and 5 s
  vehicle.run(10.9);
  EXPECT_EQ(vehicle.controller.parking_phase(), ParkingPhase::Approach);
  vehicle.run(2.0);
  EXPECT_EQ(vehicle.controller.parking_phase(), ParkingPhase::Failed);
  EXPECT_TRUE(vehicle.torques.brake);
}

TEST(DriveController, ACommandEndsTheParking) {
  Vehicle vehicle;
  vehicle.controller.park({2.0, 0.0, 0.0});
  vehicle.run(1.0);
  vehicle.controller.drive({0.2, 0.0});
  EXPECT_EQ(vehicle.controller.parking_phase(), ParkingPhase::Off);
}

TEST(DriveController, GoesOnBitForBitFromASnapshot) {
  Vehicle first, second;
  first.controller.park({2.0, 0.7, 0.4});
  first.run(3.3);
  std::vector<double> kept;
  StateWriter writer(kept);
  first.controller.save(writer);
  second.plant = first.plant;
  StateReader reader(kept);
  second.controller.restore(reader);
  EXPECT_TRUE(reader.at_end());
  for (int i = 0; i < 10000; ++i) {
    first.step();
    second.step();
    ASSERT_EQ(first.torques.left, second.torques.left) << i;
    ASSERT_EQ(first.torques.right, second.torques.right) << i;
  }
}

TEST(DriveController, AMeasurementThatIsNotFiniteShutsTheBrakes) {
  Vehicle vehicle;
  vehicle.controller.drive({0.5, 0.0});
  vehicle.run(1.0);
  DriveState broken = vehicle.plant.state;
  broken.yaw_rate = std::numeric_limits<double>::quiet_NaN();
  const DriveTorques torques = vehicle.controller.compute(broken);
  EXPECT_TRUE(torques.brake);
  EXPECT_EQ(torques.left, 0.0);
  vehicle.step();  // and goes on when it is back
  EXPECT_FALSE(vehicle.torques.brake);
}

TEST(DriveController, RefusesOptionsAndCommandsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  DriveOptions options;
  options.gauge = 0.0;
  EXPECT_THROW(DriveController{options}, Error);
  options = {};
  options.parking.run_in = nan;
  EXPECT_THROW(DriveController{options}, Error);
  DriveController controller;
  EXPECT_THROW(controller.drive({nan, 0.0}), Error);
  EXPECT_THROW(controller.park({0.0, nan, 0.0}), Error);
}

}  // namespace

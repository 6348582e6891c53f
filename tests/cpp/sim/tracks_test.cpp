// Strategy: the tracked vehicle of docs/design/mujoco.md#track-measurements, 680 kg on two tracks
// of two boxes each, against what a hand computes: statics on a slope, kinematics straight ahead,
// Coulomb friction with equal loads in a turn, energy, the braking distance of a sliding plate; edges of a few
// millimetres to centimetres, on which it once stopped. Not tested: stairs.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/step.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kRadius = 0.15, kGauge = 0.8, kMass = 680.0, kGravity = 9.81;

std::string track(const std::string& side, const std::string& y) {
  return R"(<body name=")" + side + R"(_track" pos="0 )" + y + R"( 0">
      <geom name=")" +
         side + R"(_1" class="track" type="box" size="0.3 0.075 0.15" pos="-0.3 0 0"/>
      <geom name=")" +
         side + R"(_2" class="track" type="box" size="0.3 0.075 0.15" pos="0.3 0 0"/>
      <geom name=")" +
         side + R"(_3" class="track" type="cylinder" size="0.149 0.075" pos="-0.6 0 0"
            zaxis="0 1 0"/>
      <geom name=")" +
         side + R"(_4" class="track" type="cylinder" size="0.149 0.075" pos="0.6 0 0"
            zaxis="0 1 0"/>
      <body name=")" +
         side + R"(_belt"><inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
        <joint name=")" +
         side + R"(_belt" type="hinge" axis="0 1 0" armature="2" damping="0.1"/>
      </body></body>)";
}

std::string tuple(const std::string& side) {
  std::string text = "<tuple name=\"robot_track_" + side +
                     "\"><element objtype=\"joint\" objname=\"" + side + "_belt\"/>";
  for (const char* number : {"1", "2", "3", "4"}) {
    text += "<element objtype=\"geom\" objname=\"" + side + "_" + number + "\"/>";
  }
  return text + "</tuple>";
}

// gravity tilted backward by `slope` [rad] stands for a slope
std::string vehicle(double slope, const std::string& cone = "elliptic",
                    const std::string& jacobian = "sparse", const std::string& ground = "") {
  return R"(<mujoco><compiler angle="radian"/>
    <option timestep="0.001" integrator="implicitfast" solver="Newton" cone=")" +
         cone + R"(" impratio="10" jacobian=")" + jacobian + R"(" gravity=")" +
         std::to_string(-kGravity * std::sin(slope)) + " 0 " +
         std::to_string(-kGravity * std::cos(slope)) + R"("><flag multiccd="disable"/></option>
    <size memory="16M"/>
    <default><geom solimp="0.5 0.5 0.001"/>
      <default class="track"><geom contype="1" conaffinity="2" friction="0.01" mass="0"/></default>
    </default>
    <worldbody>
      <geom type="plane" size="50 50 1" contype="2" conaffinity="1" friction="0.9"/>)" +
         ground + R"(
      <body name="chassis" pos="0 0 0.151"><freejoint/>
        <inertial pos="0 0 0.05" mass="678" diaginertia="60 110 130"/>)" +
         track("L", "0.4") + track("R", "-0.4") + R"(</body>
    </worldbody>
    <actuator><motor joint="L_belt"/><motor joint="R_belt"/></actuator>
    <custom>)" +
         tuple("L") + tuple("R") + "</custom></mujoco>";
}

class Vehicle {
 public:
  explicit Vehicle(double slope = 0.0, const std::string& ground = "",
                   const std::string& jacobian = "sparse")
      : model_(load_model_text(vehicle(slope, "elliptic", jacobian, ground))),
        tracks_(model_.get()),
        data_(mj_makeData(model_.get()), mj_deleteData) {}

  // belts at these speeds [rad/s] for so many seconds, by a P drive of at most 800 N m
  void drive(double left, double right, double seconds) {
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) {
      const double wanted[] = {left, right};
      for (int side = 0; side < 2; ++side) {
        const double error = wanted[side] - belt_speed(side);
        data_->ctrl[side] = std::clamp(1000.0 * error, -800.0, 800.0);
        work += data_->ctrl[side] * belt_speed(side) * 1e-3;
      }
      step(model_.get(), data_.get(), tracks_);
    }
  }
  [[nodiscard]] double belt_speed(int side) const {
    return data_->qvel[model_->jnt_dofadr[tracks_.belts()[static_cast<std::size_t>(side)]]];
  }
  [[nodiscard]] const mjData& data() const { return *data_; }
  [[nodiscard]] const Tracks& tracks() const { return tracks_; }
  double work = 0.0;  // [J] of both motors

 private:
  ModelPtr model_;
  Tracks tracks_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

TEST(Tracks, AreFoundByTheirTuplesWhateverTheirPrefix) {
  EXPECT_EQ(Vehicle().tracks().belts().size(), 2U);
  EXPECT_TRUE(Tracks(load_model_text("<mujoco/>").get()).empty());
}

TEST(Tracks, DriveStraightAtBeltSpeedWithoutSlipOrDrift) {
  Vehicle vehicle;
  vehicle.drive(10.0, 10.0, 4.0);
  EXPECT_NEAR(vehicle.data().qvel[0], vehicle.belt_speed(0) * kRadius, 0.003 * 1.5);
  EXPECT_NEAR(vehicle.data().qpos[1], 0.0, 1e-9);
}

TEST(Tracks, ClimbThirtyDegreesWithTheTorqueOfStatics) {
  Vehicle vehicle(std::numbers::pi / 6);
  vehicle.drive(3.3, 3.3, 3.0);
  const double statics = kMass * kGravity * 0.5 * kRadius / 2.0 + 0.1 * vehicle.belt_speed(0);
  EXPECT_NEAR(vehicle.data().ctrl[0], statics, 0.01 * statics);  // 250.2 + damping
  EXPECT_NEAR(vehicle.data().ctrl[1], statics, 0.01 * statics);
  EXPECT_NEAR(vehicle.data().qvel[0], vehicle.belt_speed(0) * kRadius, 2e-3);
}

TEST(Tracks, WorkOfAClimbBecomesHeight) {
  Vehicle vehicle(std::numbers::pi / 6);
  vehicle.drive(3.3, 3.3, 2.0);  // up to speed
  const double start = vehicle.data().qpos[0], before = vehicle.work;
  vehicle.drive(3.3, 3.3, 4.0);
  const double height = 0.5 * (vehicle.data().qpos[0] - start);
  EXPECT_NEAR(vehicle.work - before, kMass * kGravity * height, 0.01 * (vehicle.work - before));
}

TEST(Tracks, HoldOnASlopeWithTheDriveAtZero) {
  Vehicle vehicle(std::numbers::pi / 6);
  vehicle.drive(0.0, 0.0, 2.0);
  const double start = vehicle.data().qpos[0], belt = vehicle.belt_speed(0);
  vehicle.drive(0.0, 0.0, 5.0);
  // a P drive gives way a little; the contact itself creeps less than 1 mm/s
  EXPECT_NEAR(vehicle.data().qpos[0] - start, 5.0 * belt * kRadius, 5e-3);
}

TEST(Tracks, TurnInPlaceAsCoulombsLawSays) {
  Vehicle vehicle;
  vehicle.drive(-2.0, 2.0, 6.0);
  const double ideal = 2.0 * vehicle.belt_speed(1) * kRadius / kGauge;
  // 0.607 with equal loads on the corners of four boxes
  EXPECT_NEAR(vehicle.data().qvel[5] / ideal, 0.607, 0.02 * 0.607);
  EXPECT_NEAR(std::hypot(vehicle.data().qpos[0], vehicle.data().qpos[1]), 0.0, 0.02);
  EXPECT_NEAR(vehicle.data().qvel[2], 0.0, 1e-3);  // and it does not hop
}

TEST(Tracks, FollowAnArcAsCoulombsLawSays) {
  Vehicle vehicle;
  vehicle.drive(0.8 / kRadius, 1.2 / kRadius, 6.0);
  const double ideal = (vehicle.belt_speed(1) - vehicle.belt_speed(0)) * kRadius / kGauge;
  EXPECT_NEAR(vehicle.data().qvel[5] / ideal, 0.606, 0.03 * 0.606);
}

class TrackSteps : public testing::TestWithParam<double> {};

// the edge passes from the cylinder in front to the boxes behind it, 1 mm lower, without a halt
TEST_P(TrackSteps, AreClimbedAtACrawl) {
  const double height = GetParam();
  Vehicle vehicle(0.0, "<geom type=\"box\" size=\"5 2 " + std::to_string(height / 2.0) +
                           "\" pos=\"5.85 0 " + std::to_string(height / 2.0) +
                           "\" contype=\"2\" conaffinity=\"1\" friction=\"0.9\"/>");
  vehicle.drive(0.2 / kRadius, 0.2 / kRadius, 12.0);
  EXPECT_NEAR(vehicle.data().qpos[0], 12.0 * 0.2, 0.15);
  EXPECT_NEAR(vehicle.data().qpos[2], kRadius + height, 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Metres, TrackSteps, testing::Values(0.002, 0.005, 0.02, 0.05, 0.1));

TEST(Tracks, ASlidingPlateNeitherHopsNorBrakesTooWeakly) {
  // a plate whose belt stands still is a plate: it stops after v^2 / (2 mu g) = 3.670 m
  const ModelPtr model = load_model_text(R"(<mujoco>
    <option timestep="0.001" integrator="implicitfast" cone="elliptic" impratio="10"
            jacobian="dense"/>
    <default><geom solimp="0.5 0.5 0.001"/></default>
    <worldbody><geom type="plane" size="50 50 1" friction="0.5"/>
      <body name="plate" pos="0 0 0.05"><freejoint/>
        <geom name="plate" type="box" size="0.5 0.3 0.05" mass="50" friction="0.01"/>
        <body><inertial pos="0 0 0" mass="1e-3" diaginertia="1e-5 1e-5 1e-5"/>
          <joint name="belt" axis="0 1 0" armature="1e6"/></body></body>
    </worldbody>
    <custom><tuple name="track_plate"><element objtype="joint" objname="belt"/>
      <element objtype="geom" objname="plate"/></tuple></custom></mujoco>)");
  const Tracks tracks(model.get());
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
  for (int i = 0; i < 500; ++i) step(model.get(), data.get(), tracks);
  const double rest = data->qpos[2], start = data->qpos[0];
  data->qvel[0] = 6.0;
  double lift = 0.0;
  for (int i = 0; i < 2000; ++i) {
    step(model.get(), data.get(), tracks);
    lift = std::max(lift, data->qpos[2] - rest);
  }
  EXPECT_NEAR(data->qpos[0] - start, 36.0 / (2.0 * 0.5 * kGravity), 0.03);
  EXPECT_LT(lift, 2e-4);  // 4.9 mm without the correction
}

TEST(Tracks, GiveTheSameBitsAgain) {
  Vehicle a, b;
  a.drive(-1.0, 3.0, 1.0);
  b.drive(-1.0, 3.0, 1.0);
  EXPECT_TRUE(std::equal(a.data().qpos, a.data().qpos + 9, b.data().qpos));
}

TEST(Tracks, PullTheSameInASparseJacobianAsInADenseOne) {
  Vehicle sparse(0.2), dense(0.2, "", "dense");
  sparse.drive(-1.0, 3.0, 1.0);
  dense.drive(-1.0, 3.0, 1.0);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(sparse.data().qpos[i], dense.data().qpos[i], 1e-9) << i;
  EXPECT_GT(std::abs(sparse.data().qpos[6]), 0.1);  // turned
}

TEST(Tracks, RefuseModelsThatCannotHaveThem) {
  const auto text = [](const std::string& mjcf) {
    return error_text([&] { Tracks(load_model_text(mjcf).get()); });
  };
  EXPECT_TRUE(contains(text(vehicle(0.0, "pyramidal")), "elliptic"));
  EXPECT_TRUE(contains(text(R"(<mujoco><worldbody><geom name="g" size="1"/></worldbody><custom>
      <tuple name="track_x"><element objtype="geom" objname="g"/></tuple></custom></mujoco>)"),
                       "'track_x' wants a belt hinge"));
}

}  // namespace

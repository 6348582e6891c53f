// Strategy: the suite on the real scene, sampled by hand: which sensors there are, what they say,
// what they refuse. How the loop acts on them: simulation_sensors_test.cpp.
#include "hurcules/sim/sensors.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "hurcules/sim/plant.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class SensorsTest : public testing::Test {
 protected:
  SensorsTest() : physics_(stretch_scene()), robot_(stretch_scene()) {
    physics_.reset(physics_.find_keyframe("stretch"));
  }
  [[nodiscard]] Sensors make(const SensorOptions& options = {}) const {
    return {robot_, robot_.model()->opt.timestep, options};
  }
  void run(Sensors& sensors, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      physics_.step();
      sensors.sample(physics_.model(), physics_.data(), physics_.data()->time);
    }
  }
  [[nodiscard]] std::string refusal(const SensorOptions& options) const {
    return error_text([&] { (void)make(options); });
  }
  static const Sensor& find(const Sensors& sensors, const std::string& name) {
    return *std::find_if(sensors.all().begin(), sensors.all().end(),
                         [&](const Sensor& sensor) { return sensor.setup().name == name; });
  }
  static double read(const Sensors& sensors, const std::string& name, const std::string& entry) {
    const Sensor& sensor = find(sensors, name);
    const auto& entries = sensor.setup().entries;
    return sensor.reading()[std::find(entries.begin(), entries.end(), entry) - entries.begin()];
  }

  Plant physics_;
  Robot robot_;
};

TEST_F(SensorsTest, AreThoseOfTheRobotAndNotOfTheCasualty) {
  const Sensors sensors = make();
  const std::vector<std::string> wanted = {
      "encoder_position", "encoder_speed", "imu_acceleration", "imu_rate",      "load",
      "track_speed",      "pose_position", "pose_rotation",    "pose_velocity", "pose_rate"};
  EXPECT_EQ(sensors.names(), wanted);
  EXPECT_EQ(find(sensors, "encoder_position").size(), 19);  // 14 joints, 3 of the bed, 2 drives
  EXPECT_EQ(find(sensors, "load").size(), 12);              // a force each track
  EXPECT_EQ(find(sensors, "track_speed").size(), 4);
  EXPECT_FALSE(sensors.alter_state());
}

TEST_F(SensorsTest, IdealOnesSayWhatThePhysicsSays) {
  Sensors sensors = make();
  sensors.reset(physics_.data(), 1);
  const mjModel* const m = physics_.model();
  physics_.data()->qvel[m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, "L_lower_belt")]] = 2.0;
  run(sensors, 30);
  const mjData* const d = physics_.data();
  const int shoulder = mj_name2id(m, mjOBJ_JOINT, "LSP");
  EXPECT_EQ(read(sensors, "encoder_position", "LSP"), d->qpos[m->jnt_qposadr[shoulder]]);
  EXPECT_EQ(read(sensors, "encoder_speed", "LSP"), d->qvel[m->jnt_dofadr[shoulder]]);
  const int belt = m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, "L_lower_belt")];
  EXPECT_EQ(read(sensors, "track_speed", "L_lower"), 0.14 * d->qvel[belt]);
  const int root = m->jnt_qposadr[mj_name2id(m, mjOBJ_JOINT, "root")];
  EXPECT_EQ(read(sensors, "pose_position", "z"), d->qpos[root + 2]);
  EXPECT_EQ(read(sensors, "pose_rotation", "w"), d->qpos[root + 3]);
}

TEST_F(SensorsTest, TheTracksCarryTheRobotAndTheImuFeelsGravity) {
  Sensors sensors = make();
  sensors.reset(physics_.data(), 1);
  physics_.brakes().reset(true);  // it stands still behind its brakes
  run(sensors, 1500);
  double weight = 0.0;
  for (const char* track : {"L_lower", "R_lower", "L_upper", "R_upper"}) {
    weight -= read(sensors, "load", std::string(track) + "_load/z");
  }
  EXPECT_NEAR(weight, 680.0 * 9.81, 0.03 * 680.0 * 9.81);
  EXPECT_NEAR(find(sensors, "imu_acceleration").reading().norm(), 9.81, 0.1);
}

TEST_F(SensorsTest, OnlyWhatHasAModelAltersTheState) {
  SensorOptions options;
  options.models["encoder_position"] = {.bias = 0.01};
  options.models["imu_rate"] = {.noise = 0.1};
  Sensors sensors = make(options);
  ASSERT_TRUE(sensors.alter_state());
  sensors.reset(physics_.data(), 1);
  run(sensors, 2);
  Vector qpos = physics_.qpos();
  Vector qvel = std::as_const(physics_).qvel();
  sensors.overwrite(qpos, qvel);
  EXPECT_EQ(qvel, std::as_const(physics_).qvel());
  const Vector change = qpos - physics_.qpos();
  EXPECT_EQ((change.array() != 0.0).count(), 19);
  EXPECT_LT(change.cwiseAbs().maxCoeff(), 0.05);
}

TEST_F(SensorsTest, ANoisyRotationStaysARotation) {
  SensorOptions options;
  options.models["pose_rotation"] = {.noise = 0.05};
  Sensors sensors = make(options);
  sensors.reset(physics_.data(), 1);
  run(sensors, 1);
  Vector qpos = physics_.qpos();
  Vector qvel = std::as_const(physics_).qvel();
  sensors.overwrite(qpos, qvel);
  const int root = physics_.model()->jnt_qposadr[mj_name2id(physics_.model(), mjOBJ_JOINT, "root")];
  EXPECT_NEAR(qpos.segment(root + 3, 4).norm(), 1.0, 1e-15);
  EXPECT_NE(qpos[root + 3], physics_.qpos()[root + 3]);
}

TEST_F(SensorsTest, AModelOfOneSensorDoesNotChangeAnother) {
  SensorOptions one, two;
  one.models["imu_rate"] = two.models["imu_rate"] = {.noise = 0.1};
  two.models["encoder_speed"] = {.noise = 0.1};
  Sensors a = make(one), b = make(two);
  a.reset(physics_.data(), 1);
  b.reset(physics_.data(), 1);
  physics_.step();
  a.sample(physics_.model(), physics_.data(), 0.001);
  b.sample(physics_.model(), physics_.data(), 0.001);
  EXPECT_EQ(read(a, "imu_rate", "y"), read(b, "imu_rate", "y"));
}

TEST_F(SensorsTest, AFaultBeginsWhenItIsToldToAndKeepsTheLastNumberUsable) {
  SensorOptions options;
  options.faults = {{"encoder_position/LEB", FaultKind::NotANumber, 0.005},
                    {"encoder_speed/LEB", FaultKind::Frozen, 0.005}};
  Sensors sensors = make(options);
  sensors.reset(physics_.data(), 1);
  EXPECT_TRUE(sensors.alter_state());
  run(sensors, 4);
  const double place = read(sensors, "encoder_position", "LEB");
  const double speed = read(sensors, "encoder_speed", "LEB");
  EXPECT_TRUE(std::isfinite(place));
  run(sensors, 10);
  EXPECT_TRUE(std::isnan(read(sensors, "encoder_position", "LEB")));
  EXPECT_EQ(read(sensors, "encoder_speed", "LEB"), speed);
  Vector qpos = physics_.qpos();
  Vector qvel = std::as_const(physics_).qvel();
  sensors.overwrite(qpos, qvel);
  const mjModel* const m = physics_.model();
  EXPECT_EQ(qpos[m->jnt_qposadr[mj_name2id(m, mjOBJ_JOINT, "LEB")]], place);
}

TEST_F(SensorsTest, RefuseWhatCannotBe) {
  SensorOptions options;
  options.models["encoder"] = {};
  EXPECT_TRUE(contains(refusal(options),
                       "sensor 'encoder' does not exist; there are: encoder_position, enc"));
  options = {};
  options.models["load"] = {.noise = -1.0};
  EXPECT_TRUE(contains(refusal(options), "sensor 'load': noise wants a number >= 0"));
  options = {};
  options.faults = {{"encoder_position/XYZ", FaultKind::Frozen, 0.0}};
  EXPECT_TRUE(contains(refusal(options), "entry of sensor 'encoder_position', 'XYZ' does not"));
  options.faults = {{"encoder_position", FaultKind::Frozen, 0.0}};
  EXPECT_TRUE(contains(refusal(options), "entry of sensor 'encoder_position', ''"));
  options.faults = {{"encoder_position/LEB", FaultKind::Frozen, -1.0}};
  EXPECT_TRUE(contains(refusal(options), "start wants a time >= 0"));
  options = {};
  options.hold_seconds = NAN;
  EXPECT_TRUE(contains(refusal(options), "hold_seconds wants a number >= 0"));
}

}  // namespace

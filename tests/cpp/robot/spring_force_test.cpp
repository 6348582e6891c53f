// Strategy: an arm on a spring whose balance a hand can compute: 2 kg at 0.5 m, and a force put on
// its tip; what the spring tells is compared with that force. The contact of the real robot is in
// tests/python/test_compliance.py.
#include "hurcules/robot/spring_force.hpp"

#include <cmath>

#include "hurcules/base/error.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kStiffness = 400.0, kFree = 0.05, kWeight = 2.0 * 9.81 * 0.5, kDamping = 3.0;

ModelPtr arm() {
  return load_model_text(R"(<mujoco><compiler angle="radian"/><option gravity="0 0 -9.81"/>
    <worldbody><body name="arm">
      <joint name="spring" axis="0 -1 0" range="0 0.2" limited="true" stiffness="400"
             springref="0.05" damping="3"/>
      <inertial pos="0.5 0 0" mass="2" diaginertia="0.01 0.01 0.01"/>
      <site name="tip" pos="0.8 0 0"/>
      <body name="stick" pos="0.8 0 0"><joint name="motor" axis="0 1 0"/>
        <inertial pos="0 0 0" mass="1e-9" diaginertia="1e-12 1e-12 1e-12"/></body>
    </body><body name="other"/></worldbody></mujoco>)");
}

Vector at(double spring) {
  return (Vector(2) << spring, 0.0).finished();
}

TEST(SpringForce, FreeArmAtRestFeelsNothing) {
  SpringForce sensor(arm(), "spring", "tip");
  // k (s_0 - s) = weight cos(s), by three steps of substitution
  double s = 0.0;
  for (int i = 0; i < 60; ++i) s = kFree - kWeight * std::cos(s) / kStiffness;
  sensor.update(at(s), Vector::Zero(2));
  EXPECT_NEAR(sensor.force(), 0.0, 1e-6);
  EXPECT_NEAR(sensor.lever(), 0.8, 1e-12);
  EXPECT_FALSE(sensor.at_stop());
}

TEST(SpringForce, FollowsFromDeflectionWeightAndDamping) {
  SpringForce sensor(arm(), "spring", "tip");
  sensor.update(at(0.1), (Vector(2) << 0.4, 0.0).finished());
  const double moment = kStiffness * (0.1 - kFree) + kWeight * std::cos(0.1) + kDamping * 0.4;
  EXPECT_NEAR(sensor.moment(), moment, 1e-6);
  EXPECT_NEAR(sensor.force(), moment / 0.8, 1e-6);
  // up, and a little back as the arm has risen
  EXPECT_NEAR(sensor.direction()[2], std::cos(0.1), 1e-12);
  EXPECT_NEAR(sensor.direction()[0], -std::sin(0.1), 1e-12);
}

TEST(SpringForce, KnowsWhenAStopBearsTheLoad) {
  SpringForce sensor(arm(), "spring", "tip");
  sensor.update(at(0.0), Vector::Zero(2));
  EXPECT_TRUE(sensor.at_stop());
  sensor.update(at(0.2), Vector::Zero(2));
  EXPECT_TRUE(sensor.at_stop());
}

TEST(SpringForce, NamesWhatIsWrong) {
  EXPECT_THROW(SpringForce(arm(), "motor", "tip"), Error);
  EXPECT_THROW(SpringForce(arm(), "spring", "nothing"), Error);
  EXPECT_THROW(SpringForce(arm(), "spring", "other"), Error);
}

}  // namespace

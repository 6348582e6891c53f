// Strategy: steps whose sensors nobody reads against steps that read them, on the rescue robot
// beside a person: the same bits in the state and, after the last step, in every sensor. A model
// that reckons energy has it after every step.
#include "hurcules/sim/step.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <string>

#include "hurcules/sim/plant.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

std::unique_ptr<Plant> standing() {
  auto physics = std::make_unique<Plant>(stretch_scene());
  physics->reset(physics->find_keyframe("ready"));
  physics->brakes().reset(true);
  return physics;
}

TEST(Step, ManyAtOnceAreTheSameAsOneByOne) {
  const auto once = standing(), singly = standing();
  EXPECT_EQ(once->step(40), 40);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(singly->step(), 1);
  const mjModel* const m = once->model();
  EXPECT_TRUE(std::equal(once->qpos().begin(), once->qpos().end(), singly->qpos().begin()));
  EXPECT_TRUE(std::equal(once->qvel().begin(), once->qvel().end(), singly->qvel().begin()));
  const mjtNum* const readings = once->data()->sensordata;
  EXPECT_TRUE(std::equal(readings, readings + m->nsensordata, singly->data()->sensordata));
  EXPECT_GT(std::count_if(readings, readings + m->nsensordata, [](mjtNum x) { return x != 0.0; }),
            m->nsensordata / 2);
}

TEST(Step, UnseenLeavesTheSensorsAlone) {
  const auto physics = standing();
  mjData* const d = physics->data();
  const Tracks tracks(physics->model());
  std::fill_n(d->sensordata, physics->model()->nsensordata, 7.0);
  step_unseen(physics->model(), d, tracks);
  EXPECT_EQ(std::count(d->sensordata, d->sensordata + physics->model()->nsensordata, 7.0),
            physics->model()->nsensordata);
}

// of every integrator; MuJoCo's own steps are the reference
TEST(Step, IsThatOfMujoco) {
  for (const char* integrator : {"Euler", "RK4", "implicit", "implicitfast", "discrete"}) {
    std::string text = "<mujoco><option timestep='0.005' integrator='";
    text.append(integrator)
        .append(
            "'/><worldbody><geom type='plane' size='1 1 1'/><body pos='0 0 1'><joint name='turn' "
            "axis='0 1 0'"
            " damping='0.1'/><geom type='capsule' size='0.05' fromto='0 0 0 0.4 0 0' mass='1'/>"
            "<body pos='0.4 0 0'><joint axis='0 1 0' frictionloss='0.05'/><geom type='capsule'"
            " size='0.05' fromto='0 0 0 0.3 0 0' mass='1'/></body></body><body pos='0.2 0 0.3'>"
            "<freejoint/><geom size='0.06' mass='0.5'/></body></worldbody><actuator><motor"
            " joint='turn'/></actuator></mujoco>");
    const ModelPtr model = load_model_text(text);
    Plant plant(model);
    const std::unique_ptr<mjData, void (*)(mjData*)> d(mj_makeData(model.get()), mj_deleteData);
    for (int i = 0; i < 300; ++i) mj_step(model.get(), d.get());
    for (int i = 0; i < 60; ++i) EXPECT_EQ(plant.step(5), 5);
    EXPECT_TRUE(std::equal(plant.qpos().begin(), plant.qpos().end(), d->qpos)) << integrator;
  }
}

TEST(Step, UnseenStillReckonsEnergyWhereAsked) {
  const ModelPtr model = load_model_text(
      "<mujoco><option><flag energy='enable'/></option><worldbody><body pos='0 0 1'><freejoint/>"
      "<geom size='0.1' mass='2'/></body></worldbody></mujoco>");
  const std::unique_ptr<mjData, void (*)(mjData*)> d(mj_makeData(model.get()), mj_deleteData);
  step_unseen(model.get(), d.get(), Tracks(model.get()));
  EXPECT_NEAR(d->energy[0], 2.0 * 9.81, 1e-9);
}

}  // namespace

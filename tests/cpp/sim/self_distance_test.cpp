// Strategy: balls on a chain, whose distances a hand can reckon; boxes at random, whose gap must
// never exceed MuJoCo's own distance; the pairs of the real robot by name.
#include "hurcules/sim/self_distance.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "hurcules/base/random.hpp"
#include "hurcules/robot/geom_bounds.hpp"
#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// four balls of 0.1 m, each 1 m further along x and on a joint of its own
constexpr const char* kChain = R"(
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 1" pos="0 0 -0.11"/>
    <body name="a"><freejoint/><geom name="a" size="0.1"/>
      <body name="b" pos="1 0 0"><joint axis="0 0 1"/><geom name="b" size="0.1"/>
        <body name="c" pos="1 0 0"><joint axis="0 0 1"/><geom name="c" size="0.1"/>
          <body name="d" pos="1 0 0"><joint axis="0 0 1"/><geom name="d" size="0.1"/>
            <body name="e" pos="0.1 0 0"><geom name="e" size="0.1" contype="0" conaffinity="0"/>
            </body></body></body></body></body>
  </worldbody>
</mujoco>)";

struct World {
  explicit World(ModelPtr m) : model(std::move(m)), data(mj_makeData(model.get()), mj_deleteData) {}
  void bend(double b, double c) const {
    data->qpos[7] = b;
    data->qpos[8] = c;
    mj_forward(model.get(), data.get());
  }
  ModelPtr model;
  std::unique_ptr<mjData, void (*)(mjData*)> data;
};

TEST(SelfDistance, MeasuresWhatIsFarEnoughAlongTheChain) {
  const World world(load_model_text(kChain));
  SelfDistance three(world.model.get(), {1}), two(world.model.get(), {1}, {.joints = 2});
  const std::vector<std::pair<std::string, std::string>> ends = {{"a", "d"}};
  EXPECT_EQ(three.names(world.model.get()), ends);  // neither floor nor what touches nothing
  EXPECT_EQ(two.pairs(), 3);
  world.bend(0.0, 0.0);
  EXPECT_EQ(three.measure(world.model.get(), world.data.get()), 0.25);  // the cutoff
  EXPECT_EQ(three.nearest(), -1);
  // a triangle: the fourth ball comes to the first
  world.bend(2.0 * M_PI / 3.0, 2.0 * M_PI / 3.0);
  EXPECT_NEAR(three.measure(world.model.get(), world.data.get()), -0.2, 1e-6);
  EXPECT_EQ(three.nearest(), 0);
}

TEST(SelfDistance, TheNearestOneLookedAtFirstChangesNothing) {
  const World world(load_model_text(kChain));
  SelfDistance kept(world.model.get(), {1}, {.joints = 2, .near = 0.05, .cutoff = 9.0});
  for (double bend = 0.0; bend < 3.0; bend += 0.1) {
    world.bend(bend, 2.0 - bend);
    SelfDistance fresh(world.model.get(), {1}, {.joints = 2, .near = 0.05, .cutoff = 9.0});
    EXPECT_EQ(kept.measure(world.model.get(), world.data.get()),
              fresh.measure(world.model.get(), world.data.get()));
  }
}

TEST(SelfDistance, BoxesAreNeverFurtherThanTheirShapes) {
  const World world(load_model_text(R"(<mujoco><worldbody>
      <body><freejoint/><geom type="box" size="0.3 0.1 0.2"/></body>
      <body><freejoint/><geom type="box" size="0.05 0.4 0.1"/></body>
      <body><freejoint/><geom type="capsule" size="0.1 0.3"/></body>
      <body><freejoint/><geom type="cylinder" size="0.2 0.1"/></body></worldbody></mujoco>)"));
  Random random(5);
  double tightest = 1.0;
  for (int trial = 0; trial < 500; ++trial) {
    for (int i = 0; i < world.model->nq; ++i) world.data->qpos[i] = random.symmetric();
    mj_kinematics(world.model.get(), world.data.get());
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) {
        const double gap = box_gap(world.model.get(), world.data.get(), {a, b}, 1e9);
        const double distance =
            mj_geomDistance(world.model.get(), world.data.get(), a, b, 10.0, nullptr);
        if (distance <= 0.0) continue;  // shapes that meet: any gap up to zero will do
        ASSERT_LE(gap, distance + 1e-6) << "trial " << trial;
        if (a == 0 && b == 1) tightest = std::min(tightest, distance - gap);
      }
    }
  }
  EXPECT_LT(tightest, 1e-6);  // face against corner: the box is the shape
}

TEST(SelfDistance, WatchesArmsTrunkAndLegsOfTheRobot) {
  const mjModel* const m = stretch_scene().get();
  const SelfDistance distance(m, {mj_name2id(m, mjOBJ_BODY, "upper_legs")});
  const auto names = distance.names(m);
  const auto watched = [&](const char* a, const char* b) {
    return std::any_of(names.begin(), names.end(), [&](const auto& pair) {
      return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
    });
  };
  EXPECT_TRUE(watched("L_scoop_blade", "L_upper_run_1"));
  EXPECT_TRUE(watched("L_scoop_blade", "R_scoop_blade"));
  EXPECT_TRUE(watched("L_scoop_tip", "torso"));
  EXPECT_TRUE(watched("backpack", "R_lower_run_1"));
  EXPECT_FALSE(watched("torso", "L_uarm"));                 // 4 cm apart in any posture
  EXPECT_FALSE(watched("transfer_bed", "torso"));           // the hip's range keeps them apart
  EXPECT_FALSE(watched("L_lower_run_1", "R_lower_run_1"));  // tracks never meet tracks
}

TEST(SelfDistance, RefusesWhatCannotBe) {
  const mjModel* const m = stretch_scene().get();
  const auto text = [&](const SelfDistanceOptions& options) {
    return error_text([&] { SelfDistance(m, {1}, options); });
  };
  EXPECT_TRUE(contains(text({.joints = 0}), "joints wants a number >= 1"));
  EXPECT_TRUE(contains(text({.near = -1.0}), "near wants a distance >= 0"));
  EXPECT_TRUE(contains(text({.cutoff = NAN}), "cutoff wants a distance > 0"));
}

}  // namespace

// Strategy: a scanner in the middle of a square room, whose distances a hand can reckon.
#include "hurcules/sim/range_finder.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <memory>

#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// walls 2 m away on all sides, a look without substance 1 m before the scanner, a body around it
constexpr const char* kRoom = R"(
<mujoco>
  <worldbody>
    <geom type="box" size="0.1 9 1" pos="2.1 0 0"/> <geom type="box" size="0.1 9 1" pos="-2.1 0 0"/>
    <geom type="box" size="9 0.1 1" pos="0 2.1 0"/> <geom type="box" size="9 0.1 1" pos="0 -2.1 0"/>
    <geom type="box" size="0.1 0.1 1" pos="1 0 0" group="2" contype="0" conaffinity="0"/>
    <body name="head"><freejoint/><geom size="0.3"/><site name="lidar"/></body>
  </worldbody>
</mujoco>)";

class RangeFinderTest : public testing::Test {
 protected:
  RangeFinderTest()
      : model_(load_model_text(kRoom)), data_(mj_makeData(model_.get()), mj_deleteData) {
    mj_forward(model_.get(), data_.get());
  }
  static RangeFinderOptions options(int rays) {
    RangeFinderOptions options;
    options.rays = rays;
    options.angle = 2.0;
    options.period = 10;
    return options;
  }
  RangeFinder make(const RangeFinderOptions& options, std::uint64_t seed = 1) {
    RangeFinder finder(model_.get(), model_->opt.timestep, options);
    finder.reset(seed);
    return finder;
  }
  void scan(RangeFinder& finder, int ticks) {
    for (int i = 0; i < ticks; ++i) finder.sample(model_.get(), data_.get());
  }
  std::string refusal(const RangeFinderOptions& options) {
    return error_text([&] { make(options); });
  }
  // of a wall 2 m away in x and in y, seen from the middle
  static double wall(double angle) {
    return std::min(2.0 / std::abs(std::cos(angle)), 2.0 / std::abs(std::sin(angle)));
  }

  ModelPtr model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

TEST_F(RangeFinderTest, MeasuresTheWallsAndNeitherLooksNorItsOwnBody) {
  RangeFinder finder = make(options(21));
  scan(finder, 10);
  for (Index ray = 0; ray < 21; ++ray) {
    EXPECT_NEAR(finder.reading()[ray], wall(finder.ray_angle(ray)), 1e-9) << ray;
  }
  EXPECT_DOUBLE_EQ(finder.ray_angle(0), -1.0);
  EXPECT_DOUBLE_EQ(finder.ray_angle(20), 1.0);
}

TEST_F(RangeFinderTest, AScanIsThereWhenItsLastRayIs) {
  RangeFinder finder = make(options(20));  // two rays a tick
  scan(finder, 9);
  EXPECT_TRUE(std::isinf(finder.reading().minCoeff()));
  scan(finder, 1);
  EXPECT_LT(finder.reading().maxCoeff(), 3.0);
}

TEST_F(RangeFinderTest, RaysOfAScanAreOfDifferentMoments) {
  RangeFinder finder = make(options(20));
  scan(finder, 5);
  data_->qpos[0] = 1.0;  // a step towards the wall, half way through the scan
  mj_forward(model_.get(), data_.get());
  scan(finder, 5);
  const Vector middle = finder.reading().segment(9, 2);  // almost straight on
  EXPECT_NEAR(middle[0], wall(finder.ray_angle(9)), 1e-9);
  EXPECT_NEAR(middle[1], 1.0 / std::cos(finder.ray_angle(10)), 1e-9);
}

TEST_F(RangeFinderTest, TurnsWithItsSite) {
  RangeFinder finder = make(options(1));  // one ray, at the right end
  data_->qpos[3] = std::cos(0.5);
  data_->qpos[6] = std::sin(0.5);  // 1 rad about z: the ray looks along x
  mj_forward(model_.get(), data_.get());
  scan(finder, 1);
  EXPECT_NEAR(finder.reading()[0], 2.0, 1e-9);
}

TEST_F(RangeFinderTest, WhatIsTooFarOrTooNearSaysSo) {
  RangeFinderOptions far = options(21), near = options(21);
  far.max_range = 2.5;
  near.min_range = 2.5;
  RangeFinder short_sighted = make(far), long_sighted = make(near);
  scan(short_sighted, 10);
  scan(long_sighted, 10);
  EXPECT_TRUE(std::isinf(short_sighted.reading()[3]));  // 2.61 m
  EXPECT_NEAR(short_sighted.reading()[10], 2.0, 1e-9);
  EXPECT_EQ(long_sighted.reading()[10], 0.0);
  EXPECT_GT(long_sighted.reading()[3], 2.5);
}

TEST_F(RangeFinderTest, NoiseIsSeededAndHasItsSize) {
  RangeFinderOptions noisy = options(1000);
  noisy.model.noise = 0.02;
  noisy.model.step = 1e-3;
  RangeFinder a = make(noisy), b = make(noisy), c = make(noisy, 2), exact = make(options(1000));
  for (RangeFinder* finder : {&a, &b, &c, &exact}) scan(*finder, 10);
  EXPECT_EQ(a.reading(), b.reading());
  EXPECT_NE(a.reading(), c.reading());
  const double deviation = (a.reading() - exact.reading()).norm() / std::sqrt(1000.0);
  EXPECT_NEAR(deviation, 0.02, 4.0 * 0.02 / std::sqrt(2000.0));
  EXPECT_NEAR(std::remainder(a.reading()[7], 1e-3), 0.0, 1e-12);
}

TEST_F(RangeFinderTest, ADelayIsInScansAndTheRestGoesOnAfterARestore) {
  RangeFinderOptions late = options(20);
  late.model = {.noise = 0.01, .bias = 0.01, .drift = 0.01, .delay = 2, .step = 0.0};
  RangeFinder finder = make(late), other = make(late, 9);
  scan(finder, 25);
  EXPECT_TRUE(std::isinf(finder.reading()[0]));
  scan(finder, 8);
  EXPECT_FALSE(std::isinf(finder.reading()[0]));
  std::vector<double> state;
  StateWriter writer(state);
  finder.save(writer);
  StateReader reader(state);
  other.restore(reader);
  EXPECT_TRUE(reader.at_end());
  scan(finder, 17);
  scan(other, 17);
  EXPECT_EQ(finder.reading(), other.reading());
}

TEST_F(RangeFinderTest, RefusesWhatCannotBe) {
  RangeFinderOptions wrong = options(5);
  wrong.site = "ladar";
  EXPECT_EQ(refusal(wrong), "site 'ladar' does not exist; there are: lidar");
  wrong = options(-1);
  EXPECT_TRUE(contains(refusal(wrong), "rays wants 0 to 100000, -1 came"));
  wrong = options(5);
  wrong.period = 0;
  EXPECT_TRUE(contains(refusal(wrong), "period wants 1 tick or more, 0 came"));
  wrong = options(5);
  wrong.angle = 7.0;
  EXPECT_TRUE(contains(refusal(wrong), "angle wants 0 to 2 pi, 7 came"));
  wrong = options(5);
  wrong.min_range = 40.0;
  EXPECT_TRUE(contains(refusal(wrong), "min_range < max_range"));
  wrong = options(5);
  wrong.model.noise = NAN;
  EXPECT_TRUE(contains(refusal(wrong), "sensor 'range': noise"));
}

}  // namespace

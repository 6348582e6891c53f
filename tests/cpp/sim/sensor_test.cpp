// Strategy: one sensor on a made-up mjData, whose numbers the test writes itself. Statistics lie
// within four standard errors of theory; everything else is exact.
#include "hurcules/sim/sensor.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>
#include <memory>

#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kDt = 0.001;

class SensorTest : public testing::Test {
 protected:
  SensorTest()
      : model_(load_model_text(R"(<mujoco><worldbody>
          <body><joint name="a" type="slide"/><geom size="1"/></body>
          <body><joint name="b" type="slide"/><geom size="1"/></body></worldbody></mujoco>)")),
        data_(mj_makeData(model_.get()), mj_deleteData) {}

  static SensorSetup setup() {
    using Array = SensorSource::Array;
    return {"test", "m", {"a", "b"}, {{Array::Position, 0, 1.0}, {Array::Position, 1, 2.0}}};
  }
  Sensor make(const SensorModel& model, std::uint64_t seed = 1) {
    Sensor sensor(setup(), model, kDt);
    sensor.reset(data_.get(), seed);
    return sensor;
  }
  void put(double a, double b) {
    data_->qpos[0] = a;
    data_->qpos[1] = b;
  }

  ModelPtr model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_;
};

TEST_F(SensorTest, AnIdealOneRepeatsTheTruthBitForBit) {
  Sensor sensor = make({});
  for (const double value : {0.1, -1.0 / 3.0, 1e-300, 12345.678901234567}) {
    put(value, value);
    sensor.sample(data_.get());
    EXPECT_EQ(sensor.reading()[0], value);
    EXPECT_EQ(sensor.reading()[1], 2.0 * value);
  }
}

TEST_F(SensorTest, NoiseHasItsStandardDeviationAndNoMean) {
  Sensor sensor = make({.noise = 0.3});
  put(5.0, 0.0);
  constexpr int kSamples = 50000;
  double sum = 0.0, square = 0.0, both = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    sensor.sample(data_.get());
    const double a = sensor.reading()[0] - 5.0, b = sensor.reading()[1];
    sum += a;
    square += a * a;
    both += a * b;
  }
  const double error = 1.0 / std::sqrt(kSamples);
  EXPECT_NEAR(sum / kSamples, 0.0, 4.0 * 0.3 * error);
  EXPECT_NEAR(std::sqrt(square / kSamples), 0.3, 4.0 * 0.3 * error / std::sqrt(2.0));
  EXPECT_NEAR(both / kSamples, 0.0, 4.0 * 0.09 * error);  // entries are independent
}

TEST_F(SensorTest, ABiasStaysAndDiffersFromSeedToSeed) {
  put(0.0, 0.0);
  double square = 0.0;
  constexpr int kSeeds = 2000;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Sensor sensor = make({.bias = 0.5}, static_cast<std::uint64_t>(seed));
    sensor.sample(data_.get());
    const double first = sensor.reading()[0];
    sensor.sample(data_.get());
    ASSERT_EQ(sensor.reading()[0], first);
    square += first * first;
  }
  EXPECT_NEAR(std::sqrt(square / kSeeds), 0.5, 4.0 * 0.5 / std::sqrt(2.0 * kSeeds));
}

TEST_F(SensorTest, ADriftGrowsWithTheRootOfTime) {
  put(0.0, 0.0);
  constexpr int kSeeds = 500, kSamples = 250;  // a quarter of a second: half of the drift
  double square = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Sensor sensor = make({.drift = 2.0}, static_cast<std::uint64_t>(seed));
    for (int i = 0; i < kSamples; ++i) sensor.sample(data_.get());
    square += sensor.reading().squaredNorm() / 2.0;
  }
  EXPECT_NEAR(std::sqrt(square / kSeeds), 1.0, 4.0 / std::sqrt(4.0 * kSeeds));
}

TEST_F(SensorTest, ADelayGivesWhatWasSoManySamplesAgo) {
  put(-1.0, 0.0);
  Sensor sensor = make({.delay = 3});
  for (int i = 0; i < 20; ++i) {
    put(i, 0.0);
    sensor.sample(data_.get());
    EXPECT_EQ(sensor.reading()[0], i < 3 ? -1.0 : i - 3);
  }
}

TEST_F(SensorTest, StepsAreWholeAndNearest) {
  Sensor sensor = make({.step = 0.25});
  put(0.3, -0.95);
  sensor.sample(data_.get());
  EXPECT_EQ(sensor.reading()[0], 0.25);
  EXPECT_EQ(sensor.reading()[1], -2.0);  // of -1.9
}

TEST_F(SensorTest, GoesOnWithTheSameBitsAfterARestore) {
  const SensorModel model{.noise = 0.1, .bias = 0.2, .drift = 0.3, .delay = 5, .step = 1e-3};
  Sensor sensor = make(model), other = make(model, 77);
  for (int i = 0; i < 13; ++i) {
    put(i, -i);
    sensor.sample(data_.get());
  }
  sensor.set_reading(1, std::numeric_limits<double>::quiet_NaN());
  std::vector<double> state;
  StateWriter writer(state);
  sensor.save(writer);
  StateReader reader(state);
  other.restore(reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_TRUE(std::isnan(other.reading()[1]));
  for (int i = 0; i < 13; ++i) {
    put(2 * i, i);
    sensor.sample(data_.get());
    other.sample(data_.get());
    EXPECT_EQ(sensor.reading(), other.reading());
  }
}

TEST_F(SensorTest, RefusesWhatCannotBe) {
  const auto text = [this](const SensorModel& model) { return error_text([&] { make(model); }); };
  EXPECT_EQ(text({.noise = -1.0}), "sensor 'test': noise wants a number >= 0, -1 came");
  EXPECT_TRUE(contains(text({.bias = NAN}), "bias wants a number >= 0, nan came"));
  EXPECT_TRUE(contains(text({.drift = INFINITY}), "drift wants"));
  EXPECT_TRUE(contains(text({.step = -0.1}), "step wants"));
  EXPECT_TRUE(contains(text({.delay = -1}), "delay wants 0 to 1000 samples, -1 came"));
  EXPECT_TRUE(contains(text({.delay = 1001}), "1001 came"));
}

}  // namespace

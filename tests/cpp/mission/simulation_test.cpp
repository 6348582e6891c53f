// Strategy: the real scene, a few seconds of it: sameness (seed, pieces, snapshots), what ends a
// run, commands, servo and timings. What the mission is about is in stretch_physics_test.cpp.
#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>
#include <memory>

#include "hurcules/mission/mission_simulation.hpp"
#include "support/expect.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// seed 3, without time series, varied as usual
MissionOptions quiet(std::uint64_t seed = 3) {
  MissionOptions options;
  options.seed = seed;
  options.record = false;
  return options;
}

// figures that have not happened are NaN: compared by their bits
// A simulation on data that the test may disturb.
struct Borrowed {
  explicit Borrowed(const MissionOptions& options = quiet())
      : data(mj_makeData(stretch_scene().get()), mj_deleteData),
        simulation(stretch_scene(), "stretch", options, data.get()) {}
  // velocity of the robot's root, (6)
  [[nodiscard]] double* root_velocity() const {
    const mjModel* const m = stretch_scene().get();
    return data->qvel + m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, "root")];
  }
  void push(double force) const {
    data->xfrc_applied[6 * mj_name2id(stretch_scene().get(), mjOBJ_BODY, "waist")] = force;
  }
  std::unique_ptr<mjData, void (*)(mjData*)> data;
  MissionSimulation simulation;
};

TEST(Simulation, SameSeedGivesTheSameBitsAndAnotherSeedOthers) {
  MissionSimulation a(stretch_scene(), "stretch", quiet()), b(stretch_scene(), "stretch", quiet());
  MissionSimulation c(stretch_scene(), "stretch", quiet(4));
  for (MissionSimulation* simulation : {&a, &b, &c}) simulation->step(2500);
  EXPECT_TRUE(same_bits(a.state(), b.state()));
  EXPECT_FALSE(same_bits(a.state(), c.state()));
}

TEST(Simulation, WithoutVariationTheSeedChangesNothing) {
  MissionOptions one = quiet(1), two = quiet(2);
  one.variation = two.variation = 0.0;
  MissionSimulation a(stretch_scene(), "stretch", one), b(stretch_scene(), "stretch", two);
  a.step(100);
  b.step(100);
  EXPECT_TRUE(same_bits(a.state(), b.state()));
}

TEST(Simulation, ManySmallStepsAreOneLargeStep) {
  MissionSimulation a(stretch_scene(), "stretch", quiet()), b(stretch_scene(), "stretch", quiet());
  a.step(600);
  for (int i = 0; i < 600; i += 20) EXPECT_EQ(b.step(20), 20);
  EXPECT_TRUE(same_bits(a.state(), b.state()));
}

TEST(Simulation, RecordingAndTimingChangeNothing) {
  MissionOptions options = quiet();
  options.record = true;
  options.clock = [] { return 0.0; };
  MissionSimulation a(stretch_scene(), "stretch", quiet()), b(stretch_scene(), "stretch", options);
  a.step(300);
  b.step(300);
  EXPECT_TRUE(same_bits(a.state(), b.state()));
}

TEST(Simulation, ResetIsANewBeginning) {
  MissionSimulation a(stretch_scene(), "stretch", quiet(9)),
      b(stretch_scene(), "stretch", quiet(1));
  b.step(2300);
  b.reset(9);
  EXPECT_EQ(b.time(), 0.0);
  a.step(500);
  b.step(500);
  EXPECT_TRUE(same_bits(a.state(), b.state()));
}

TEST(Simulation, ARestoredRunGoesOnBitForBitHereAndElsewhere) {
  MissionSimulation a(stretch_scene(), "stretch", quiet());
  for (const int start : {0, 150, 1990, 2400}) {  // across the start of the stretch too
    a.reset(3);
    a.step(start);
    const std::vector<double> state = a.state();
    const Vector seen = a.observation().snapshot();
    a.step(400);
    const std::vector<double> later = a.state();

    a.restore(state);
    EXPECT_EQ(a.observation().snapshot(), seen) << start;
    a.step(400);
    EXPECT_TRUE(same_bits(a.state(), later)) << start;

    MissionSimulation other(stretch_scene(), "stretch", quiet(77));
    other.step(10);
    other.restore(state);
    other.step(400);
    EXPECT_TRUE(same_bits(other.state(), later)) << start;
  }
}

TEST(Simulation, TheLogKeepsWhatWasBeforeARestoredTime) {
  MissionOptions options = quiet();
  options.record = true;
  MissionSimulation simulation(stretch_scene(), "stretch", options);
  simulation.step(100);
  const std::vector<double> state = simulation.state();
  simulation.step(100);
  EXPECT_EQ(simulation.log().rows(), 200U);
  const double before = simulation.log().at(150, 2);
  simulation.restore(state);
  EXPECT_EQ(simulation.log().rows(), 100U);
  simulation.step(100);
  EXPECT_EQ(simulation.log().at(150, 2), before);
}

TEST(Simulation, ASnapshotThatDoesNotFitChangesNothing) {
  MissionSimulation simulation(stretch_scene(), "stretch", quiet());
  simulation.step(50);
  const std::vector<double> state = simulation.state();
  std::vector<double> shorter(state.begin(), state.end() - 1), longer = state;
  longer.push_back(0.0);
  EXPECT_TRUE(contains(error_text([&] { simulation.restore(shorter); }), "snapshot"));
  EXPECT_TRUE(contains(error_text([&] { simulation.restore(longer); }), "snapshot"));
  EXPECT_TRUE(same_bits(simulation.state(), state));
}

TEST(Simulation, HalfOfFullScaleIsTheOperator) {
  MissionSimulation a(stretch_scene(), "stretch", quiet()), b(stretch_scene(), "stretch", quiet());
  a.step(2600);
  b.step(2000);
  Vector command = Vector::Zero(11);
  command[0] = command[3] = 0.5 * b.controller().scale()[0];
  EXPECT_EQ(b.operator_command(), command);
  b.step(600, &command);
  EXPECT_TRUE(same_bits(a.state(), b.state()));
}

TEST(Simulation, ZeroCommandHoldsTheHands) {
  MissionSimulation simulation(stretch_scene(), "stretch", quiet());
  const Vector zero = Vector::Zero(11);
  simulation.step(3000, &zero);
  EXPECT_EQ(simulation.mission().table().phases[simulation.mission().phase()].name, "stretch");
  EXPECT_LT(simulation.telemetry().level_error_measured[1], 2e-3);
  EXPECT_LT(simulation.telemetry().qd.cwiseAbs().maxCoeff(), 2e-3);
}

TEST(Simulation, DivergenceEndsTheRunWithAReason) {
  const double values[] = {std::numeric_limits<double>::quiet_NaN(), 1e12,
                           std::numeric_limits<double>::infinity()};
  for (const double bad : values) {
    Borrowed run;
    run.simulation.step(20);
    run.root_velocity()[2] = bad;
    EXPECT_EQ(run.simulation.step(50), 0);
    EXPECT_TRUE(run.simulation.finished());
    EXPECT_FALSE(run.simulation.success());
    EXPECT_EQ(run.simulation.reason(), "diverged at 0.020 s");
    EXPECT_EQ(run.simulation.step(50), 0);
    run.simulation.reset(1);  // and it recovers
    EXPECT_EQ(run.simulation.step(50), 50);
  }
}

TEST(Simulation, DivergenceInsideATickEndsTheRunToo) {
  Borrowed run;
  run.simulation.step(20);
  run.push(1e300);
  EXPECT_EQ(run.simulation.step(50), 1);
  EXPECT_EQ(run.simulation.reason(), "diverged at 0.020 s");
}

TEST(Simulation, AFallEndsTheRunWithAReason) {
  Borrowed run;
  run.simulation.step(200);
  run.push(-9000.0);
  run.simulation.step(5000);
  const std::string reason = run.simulation.reason();
  EXPECT_TRUE(contains(reason, "fell over at ")) << reason;
  EXPECT_TRUE(contains(reason, "at most ") || contains(reason, "at least ")) << reason;
  EXPECT_FALSE(run.simulation.success());
}

TEST(Simulation, APushThatItCanTakeDoesNotEndTheRun) {
  Borrowed run;
  run.simulation.step(200);
  run.push(-400.0);
  run.simulation.step(500);
  run.push(0.0);
  run.simulation.step(1000);
  EXPECT_FALSE(run.simulation.finished());
}

TEST(Simulation, ThePlannerMaySenseWhereTheSupportStands) {
  MissionOptions options = quiet();
  options.base = BaseSource::Sensed;
  MissionSimulation simulation(stretch_scene(), "stretch", options);
  simulation.step(6000);
  EXPECT_FALSE(simulation.finished());
  EXPECT_LT(simulation.telemetry().level_error_measured[1], 5e-4);
}

TEST(Simulation, ObservesAsManyNumbersAsItNames) {
  MissionSimulation simulation(stretch_scene(), "stretch", quiet());
  const Recorder& observation = simulation.observation();
  EXPECT_EQ(observation.snapshot().size(), static_cast<Index>(observation.channels().size()));
  EXPECT_TRUE(observation.snapshot().allFinite());
  EXPECT_EQ(observation.channels().front(), "q/KN");
}

TEST(Simulation, ServesEachKneeOnItsOwnAndBrakesTheTracks) {
  MissionOptions options = quiet();
  options.record = true;
  MissionSimulation simulation(stretch_scene(), "stretch", options);
  simulation.step(1000);
  const std::vector<std::string>& names = simulation.log().channels();
  const auto worst = [&](const std::string& channel) {
    const auto found = std::find(names.begin(), names.end(), channel);
    EXPECT_NE(found, names.end()) << channel;
    return simulation.log()
        .series(static_cast<std::size_t>(found - names.begin()))
        .cwiseAbs()
        .maxCoeff();
  };
  EXPECT_GT(worst("torque/LKN"), 500.0);
  EXPECT_GT(worst("torque/RKN"), 500.0);
  EXPECT_LT(worst("joint_error/L_lower_belt"), 2e-3);
}

TEST(Simulation, TimesEachStageOnlyWithAClock) {
  MissionOptions options = quiet();
  options.clock = [] {
    static double now = 0.0;
    return now += 1e-6;  // every look takes a microsecond
  };
  MissionSimulation timed(stretch_scene(), "stretch", options),
      plain(stretch_scene(), "stretch", quiet());
  timed.step(10);
  plain.step(10);
  EXPECT_EQ(plain.timings().rows(), 0U);
  ASSERT_EQ(timed.timings().rows(), 10U);
  for (std::size_t stage = 1; stage < timed.timings().columns(); ++stage) {
    EXPECT_NEAR(timed.timings().at(5, stage), 1e-6, 1e-12) << timed.timings().channels()[stage];
  }
}

TEST(Simulation, RefusesWhatCannotBe) {
  const auto text = [](const std::string& mission, double variation) {
    MissionOptions options;
    options.variation = variation;
    return error_text([&] { MissionSimulation(stretch_scene(), mission, options); });
  };
  EXPECT_TRUE(contains(text("walk", 1.0), "there are: stretch"));
  EXPECT_TRUE(contains(text("stretch", -1.0), "variation"));
  MissionSimulation simulation(stretch_scene(), "stretch", quiet());
  const Vector few = Vector::Zero(3), bad = Vector::Constant(11, NAN);
  EXPECT_TRUE(contains(error_text([&] { simulation.step(1, &few); }), "11 finite numbers"));
  EXPECT_TRUE(contains(error_text([&] { simulation.step(1, &bad); }), "11 finite numbers"));
  EXPECT_TRUE(contains(error_text([&] { simulation.step(-1); }), ">= 0"));
  const ModelPtr empty = load_model_text("<mujoco/>");
  EXPECT_NE(error_text([&] { MissionSimulation(empty, "stretch"); }), "");
}

}  // namespace

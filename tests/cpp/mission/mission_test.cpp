// Strategy: a made-up mission on the small arm shows what the state machine promises, tick by tick;
// no physics, no solver. The stretch has its own file.
#include "hurcules/mission/mission.hpp"

#include <cmath>

#include "hurcules/control/tasks.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// wait 0.5 s, move the hand for 0.2 m, done
class Wave final : public Mission {
 public:
  explicit Wave(const Robot& plan) : Mission(MissionSetup{}), hand_("hand", plan, "tip") {
    const Stack stack({hand_});
    const auto enter = [this](const char* name) {
      return [this, name](const Robot&, double time) {
        entered.emplace_back(name);
        entered_at.push_back(time);
      };
    };
    phases_ = {{"wait", stack, enter("wait"), {}, [](double t) { return t >= 0.5; }},
               {"skipped", stack, enter("skipped"), {}, [](double) { return true; }},
               {"move", stack, enter("move"), [](VectorRef c, double) { c[0] = 0.1; },
                [this](double) { return moved >= 0.2; }}};
    channels_ = {{"hand_x", 0.2}};
    figures_ = {{"moved_m", NAN, 0.2}};
    tasks_ = {&hand_};
  }
  void note_commanded(const TickReport&) override { figures_[0].value = moved; }
  void note_measured(const TickReport&) override {}
  std::string_view verdict() const override { return ""; }

  std::vector<std::string> entered;
  std::vector<double> entered_at;
  double moved = 0.0;

 private:
  void start(const Robot& plan, const Robot&) override {
    hand_.hold(plan);
    moved = 0.0;
  }
  void move_targets(const Robot&, const ConstVectorRef& command, double dt) override {
    hand_.advance(Vector3(command[0], 0, 0), dt);
    moved += command[0] * dt;
  }
  void save_memory(StateWriter& writer) const override { writer.put(moved); }
  void restore_memory(StateReader& reader) override { moved = reader.get(); }

  PositionTask hand_;
};

class MissionTest : public testing::Test {
 protected:
  MissionTest() { wave_.reset(robot_, robot_); }
  // one tick of 0.1 s; false when the mission is over
  bool tick(const Vector* command = nullptr) {
    wave_.apply(robot_, command ? *command : wave_.operator_command(0.1), 0.1);
    time_ += 0.1;
    return wave_.select_phase(robot_, time_);
  }
  Robot robot_{load_model_text(kArm)};
  Wave wave_{robot_};
  double time_ = 0.0;
};

TEST_F(MissionTest, EntersEachPhaseOnceAndInOrder) {
  int ticks = 1;
  while (tick()) ++ticks;
  EXPECT_EQ(wave_.entered, (std::vector<std::string>{"wait", "skipped", "move"}));
  EXPECT_NEAR(wave_.entered_at[2], 0.5, 1e-12);
  EXPECT_EQ(ticks, 5 + 20);
  EXPECT_NEAR(wave_.moved, 0.2, 1e-12);
}

TEST_F(MissionTest, TheOperatorHoldsStillWherePhasesSayNothing) {
  EXPECT_EQ(wave_.operator_command(0.1), Vector::Zero(1));
  while (wave_.phase() == 0) tick();
  EXPECT_EQ(wave_.operator_command(0.1)[0], 0.1);
}

TEST_F(MissionTest, AnotherCommandReplacesTheOperatorsInEveryPhase) {
  const Vector command = Vector::Constant(1, 0.15);
  tick(&command);
  EXPECT_NEAR(wave_.moved, 0.015, 1e-15);
}

TEST_F(MissionTest, CommandsAreHeldToTheirScale) {
  const Vector command = Vector::Constant(1, -5.0);
  tick(&command);
  EXPECT_EQ(wave_.command()[0], -0.2);
}

TEST_F(MissionTest, ResetStartsOver) {
  while (tick()) {
  }
  TickReport report{0.0, Eigen::VectorXi(), 0.0, 0.0};
  wave_.note_commanded(report);
  wave_.reset(robot_, robot_);
  EXPECT_EQ(wave_.phase(), 0U);
  EXPECT_TRUE(std::isnan(wave_.figures()[0].value));
  EXPECT_EQ(wave_.command()[0], 0.0);
}

TEST_F(MissionTest, ARestoredOneGoesOnTheSame) {
  for (int i = 0; i < 8; ++i) tick();
  std::vector<double> state;
  StateWriter writer(state);
  wave_.save(writer);
  Wave other(robot_);
  other.reset(robot_, robot_);
  StateReader reader(state);
  other.restore(reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(other.phase(), wave_.phase());
  EXPECT_EQ(other.moved, wave_.moved);
}

TEST(Missions, AreFoundByNameAndUnknownOnesAreToldTheNames) {
  for (const std::string& name : mission_names()) EXPECT_EQ(mission_setup(name).name, name);
  const std::string text = error_text([] { (void)mission_setup("walk"); });
  EXPECT_TRUE(contains(text, "'walk' does not exist; there are: stretch")) << text;
}

}  // namespace

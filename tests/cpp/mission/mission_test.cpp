// Strategy: a made-up mission on the small arm shows what the state machine promises, tick by tick;
// no physics. The stretch has its own file.
#include "hurcules/mission/mission.hpp"

#include <cmath>
#include <memory>

#include "hurcules/control/tasks.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

std::shared_ptr<WholeBodyController> make_controller(const Robot& robot) {
  auto hand = std::make_unique<PositionTask>("hand", robot, "tip");
  Vector scale(3);
  scale << 0.2, 0.2, 0.2;
  WholeBodyControllerOptions options;
  options.dt = 0.1;
  options.velocity.horizon = options.acceleration.horizon = 0.1;
  options.acceleration.stiffness = options.acceleration.damping = 1.0;
  auto controller = std::make_shared<WholeBodyController>(
      robot, std::vector<NamedStack>{{"reach", Stack({*hand})}},
      std::vector<Channel>{{"hand", ChannelKind::Twist, *hand, scale}}, options);
  controller->keep(std::move(hand));
  return controller;
}

// wait 0.5 s, move the hand for 0.2 m, done
class Wave final : public Mission {
 public:
  explicit Wave(const WholeBodyController& controller) : Mission({}, controller, 1.0) {
    const auto enter = [this](const char* name) {
      return [this, name](double time) {
        entered.emplace_back(name);
        entered_at.push_back(time);
      };
    };
    phases_ = {{"wait", "reach", enter("wait"), {}, [](double t) { return t >= 0.5; }},
               {"skipped", "reach", enter("skipped"), {}, [](double) { return true; }},
               {"move", "reach", enter("move"), [](VectorRef c, double) { c[0] = 0.1; },
                [this](double) { return moved >= 0.2; }}};
    figures_ = {{"moved_m", NAN, 0.2}};
  }
  void note_commanded(const WholeBodyController& controller, const TickReport&) override {
    moved += controller.command()[0] * controller.dt();
    figures_[0].value = moved;
  }
  void note_measured(const TickReport&) override {}
  std::string_view verdict() const override { return ""; }
  std::unique_ptr<Supervisor> clone(WholeBodyController& controller) const override {
    return std::make_unique<Wave>(controller);
  }

  std::vector<std::string> entered;
  std::vector<double> entered_at;
  double moved = 0.0;

 private:
  void begin(WholeBodyController&, const Robot&) override { moved = 0.0; }
  void save_memory(StateWriter& writer) const override { writer.put(moved); }
  void restore_memory(StateReader& reader) override { moved = reader.get(); }
};

class MissionTest : public testing::Test {
 protected:
  MissionTest() { wave_.reset(*controller_, robot_); }
  // one tick of 0.1 s; false when the mission is over
  bool tick(const Vector* command = nullptr) {
    const Vector qvel = Vector::Zero(3);
    const std::vector<ActuatorStatus> none;
    const RobotState state{robot_.qpos(), qvel, none};
    controller_->apply(command ? command : &wave_.command(0.1), true, state);
    wave_.note_commanded(*controller_, {time_, active_, 0.0, 0.0, tasks_});
    time_ += 0.1;
    return wave_.advance(*controller_, time_);
  }
  Robot robot_{load_model_text(kArm)};
  std::shared_ptr<WholeBodyController> controller_ = make_controller(robot_);
  Wave wave_{*controller_};
  Eigen::VectorXi active_;
  std::vector<const Task*> tasks_;
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
  EXPECT_EQ(wave_.command(0.1), Vector::Zero(3));
  while (wave_.phase() == 0) tick();
  EXPECT_EQ(wave_.command(0.1)[0], 0.1);
}

TEST_F(MissionTest, AnotherCommandReplacesTheOperatorsInEveryPhase) {
  const Vector command = Vector::Constant(3, 0.15);
  tick(&command);
  EXPECT_NEAR(wave_.moved, 0.015, 1e-15);
}

TEST_F(MissionTest, CommandsAreHeldToTheirScale) {
  const Vector command = Vector::Constant(3, -5.0);
  tick(&command);
  EXPECT_EQ(controller_->command()[0], -0.2);
}

TEST_F(MissionTest, ResetStartsOver) {
  while (tick()) {
  }
  controller_->reset(robot_.qpos());
  wave_.reset(*controller_, robot_);
  EXPECT_EQ(wave_.phase(), 0U);
  EXPECT_TRUE(std::isnan(wave_.figures()[0].value));
  EXPECT_EQ(controller_->command()[0], 0.0);
}

TEST_F(MissionTest, ARestoredOneGoesOnTheSame) {
  for (int i = 0; i < 8; ++i) tick();
  std::vector<double> state;
  StateWriter writer(state);
  wave_.save(writer);
  Wave other(*controller_);
  other.reset(*controller_, robot_);
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

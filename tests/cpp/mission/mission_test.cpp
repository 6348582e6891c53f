// Strategy: a made-up mission on the small arm shows what the state machine promises, tick by tick;
// no physics. The stretch has its own file.
#include <cmath>
#include <memory>

#include "hurcules/control/tasks.hpp"
#include "hurcules/mission/mission_simulation.hpp"
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

// wait 0.5 s, nothing, move the hand for 0.2 m
MissionTable wave_table() {
  MissionTable table;
  table.phases = {
      {.name = "wait", .stack = "reach", .seconds = 0.5},
      {.name = "skipped", .stack = "reach"},
      {.name = "move", .stack = "reach", .leads = {{"hand", Vector3(0.1, 0.0, 0.0), 0.2}}}};
  return table;
}

class Wave final : public Mission {
 public:
  explicit Wave(const WholeBodyController& controller)
      : Mission({.name = "wave"}, wave_table(), controller, 1.0) {
    figures_ = {{"moved_m", NAN, 0.2}};
  }

  std::vector<std::string> names;
  std::vector<double> entered_at;
  double moved = 0.0;

 private:
  void begin(WholeBodyController&, const Robot&) override { moved = 0.0; }
  void entered(double time) override {
    names.push_back(phase_names()[phase()]);
    entered_at.push_back(time);
  }
  void commanded(const WholeBodyController& controller, const TickReport&) override {
    moved += controller.command()[0] * controller.dt();
    figures_[0].value = moved;
  }
  void save_memory(StateWriter& writer) const override { writer.put(moved); }
  void restore_memory(StateReader& reader) override { moved = reader.get(); }
};

class MissionTest : public testing::Test {
 protected:
  MissionTest() { wave_.reset(*controller_, robot_); }
  // one tick of 0.1 s; false when the mission is over
  bool tick(const Vector* command = nullptr) { return tick(wave_, command); }
  bool tick(Mission& mission, const Vector* command = nullptr) {
    const Vector qvel = Vector::Zero(3);
    const std::vector<ActuatorStatus> none;
    const RobotState state{robot_.qpos(), qvel, none};
    controller_->apply(command ? command : &mission.command(0.1), true, state);
    mission.note_commanded(*controller_, {time_, active_, 0.0, 0.0, tasks_});
    mission.note_measured({time_, active_, 0.0, 0.0, tasks_});
    time_ += 0.1;
    return mission.advance(*controller_, time_);
  }
  // with a log of one column, "load"
  std::unique_ptr<Mission> make(MissionTable table) {
    auto mission = std::make_unique<Mission>(MissionSetup{.name = "made"}, std::move(table),
                                             *controller_, 1.0);
    Recorder log;
    log.add("load", &load_);
    mission->attach(plant_, log);
    mission->reset(*controller_, robot_);
    time_ = 0.0;
    return mission;
  }
  double load_ = 0.0;
  Robot robot_{load_model_text(kArm)};
  Plant plant_{robot_.model()};
  std::shared_ptr<WholeBodyController> controller_ = make_controller(robot_);
  Wave wave_{*controller_};
  Eigen::VectorXi active_;
  std::vector<const Task*> tasks_;
  double time_ = 0.0;
};

TEST_F(MissionTest, EntersEachPhaseOnceAndInOrder) {
  int ticks = 1;
  while (tick()) ++ticks;
  EXPECT_EQ(wave_.names, (std::vector<std::string>{"wait", "skipped", "move"}));
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
  EXPECT_EQ(other.command(0.1), wave_.command(0.1));
}

TEST_F(MissionTest, AWayIsLedSmoothlyAndWhole) {
  MissionTable table;
  table.phases = {{.name = "by",
                   .stack = "reach",
                   .seconds = 2.0,
                   .leads = {{"hand", {}, 1.0, Vector3(0, 0.1, 0)}}}};
  const auto mission = make(table);
  double way = 0.0, fastest = 0.0;
  do {
    const double speed = mission->command(0.1)[1];
    way += 0.1 * speed;
    fastest = std::max(fastest, speed);
  } while (tick(*mission));
  EXPECT_NEAR(way, 0.1, 1e-12);
  EXPECT_NEAR(fastest, 0.1 / 2.0 * 1.875, 1e-3);  // of x^3 (10 - 15 x + 6 x^2), in the middle
  EXPECT_NEAR(time_, 2.0, 1e-9);
}

TEST_F(MissionTest, AConditionCountsOnlyWhenItHasBeenTrueForItsTime) {
  MissionTable table;
  table.phases = {{.name = "wait", .stack = "reach", .done = {{"load", true, 5.0, 0.3}}}};
  const auto mission = make(table);
  load_ = 6.0;
  tick(*mission), tick(*mission);
  load_ = 4.0;
  tick(*mission);
  load_ = 5.0;
  EXPECT_TRUE(tick(*mission));
  EXPECT_TRUE(tick(*mission));
  EXPECT_TRUE(tick(*mission));
  EXPECT_FALSE(tick(*mission));
  EXPECT_EQ(mission->verdict(), "");
}

TEST_F(MissionTest, ReactionsAreCountedAndTheNextFollows) {
  MissionTable table;
  Trouble heavy;
  heavy.when = {"load", true, 5.0};
  heavy.reactions = {{ReactionKind::Back, "start", 0.0, 2}, {ReactionKind::Lower}};
  table.phases = {{.name = "start", .stack = "reach", .seconds = 0.2},
                  {.name = "carry", .stack = "reach", .seconds = 5.0},
                  {.name = "put", .stack = "reach", .seconds = 0.3}};
  table.phases[1].troubles.push_back(heavy);
  table.safety = "put";
  const auto mission = make(table);
  load_ = 9.0;
  std::vector<std::size_t> seen;
  bool goes_on = true;
  while (goes_on) {
    if (seen.empty() || seen.back() != mission->phase()) seen.push_back(mission->phase());
    goes_on = tick(*mission);
  }
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 0, 1, 0, 1, 2}));
  EXPECT_EQ(mission->verdict(), "phase 'carry': load >= 5");
}

TEST_F(MissionTest, WhatTakesTooLongHoldsThenAborts) {
  MissionTable table;
  table.phases = {{.name = "wait",
                   .stack = "reach",
                   .done = {{"load", true, 5.0}},
                   .within = 0.5,
                   .late = {{ReactionKind::Hold, "", 0.3}, {ReactionKind::Abort}}}};
  const auto mission = make(table);
  while (tick(*mission)) {
  }
  EXPECT_NEAR(time_, 0.6 + 0.3 + 0.1, 1e-9);
  EXPECT_EQ(mission->verdict(), "phase 'wait': took too long: load >= 5 is not true, it is 0");
}

TEST_F(MissionTest, AnAnswerGoesOnOrTakesTheNextReaction) {
  MissionTable table;
  table.phases = {{.name = "carry",
                   .stack = "reach",
                   .seconds = 1.0,
                   .troubles = {{{"load", true, 5.0},
                                 {{ReactionKind::Ask, "", 9.0, 1}, {ReactionKind::Abort}}}}}};
  for (const bool yes : {true, false}) {
    load_ = 0.0;
    const auto mission = make(table);
    tick(*mission);
    load_ = 6.0;
    tick(*mission);
    EXPECT_TRUE(mission->asks_until().has_value());
    EXPECT_EQ(mission->question(), "phase 'carry': load >= 5; go on?");
    EXPECT_TRUE(tick(*mission));
    load_ = 0.0;
    mission->answer(yes);
    EXPECT_EQ(tick(*mission), yes);
    EXPECT_FALSE(mission->asks_until().has_value());
    EXPECT_EQ(mission->question(), "");
  }
}

TEST_F(MissionTest, APhaseAfterAnAnswerCanBeRestored) {
  MissionTable table;
  table.phases = {{.name = "carry",
                   .stack = "reach",
                   .seconds = 0.3,
                   .troubles = {{{"load", true, 5.0},
                                 {{ReactionKind::Ask, "", 9.0, 1}, {ReactionKind::Abort}}}}},
                  {.name = "rest", .stack = "reach", .seconds = 5.0}};
  const auto mission = make(table);
  load_ = 6.0;
  tick(*mission);
  mission->answer(true);
  for (int i = 0; i < 8; ++i) tick(*mission);
  ASSERT_EQ(mission->phase(), 1);
  std::vector<double> state;
  StateWriter writer(state);
  mission->save(writer);
  const auto other = make(table);
  StateReader reader(state);
  other->restore(reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(other->phase(), 1);
}

TEST_F(MissionTest, APauseFreezesTheTable) {
  const auto mission = make(wave_table());
  tick(*mission), tick(*mission);
  mission->pause();
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(tick(*mission));
  EXPECT_EQ(mission->phase(), 0U);
  mission->resume(*controller_, time_);
  tick(*mission), tick(*mission), tick(*mission), tick(*mission);
  EXPECT_EQ(mission->phase(), 2U);
}

TEST_F(MissionTest, APhaseBeginsAnewWhereSomebodyCommandedInThePause) {
  MissionTable table = wave_table();
  table.phases = {table.phases[2]};  // 0.2 m at 0.1 m/s
  for (const double by_hand : {0.0, 0.05}) {
    const auto mission = make(table);
    for (int i = 0; i < 10; ++i) tick(*mission);
    mission->pause();
    const Vector hand = by_hand * Vector::Unit(controller_->scale().size(), 1);
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(tick(*mission, &hand));
    mission->resume(*controller_, time_);
    int left = 1;
    while (tick(*mission)) ++left;
    EXPECT_EQ(left, by_hand > 0.0 ? 20 : 10);
  }
}

// it led no task of another stack, and took too long
TEST_F(MissionTest, APhaseHasItsStackBackAfterAPauseInWhichSomebodyUsedAnother) {
  MissionTable table = wave_table();
  table.phases = {table.phases[2]};
  const auto mission = make(table);
  for (int i = 0; i < 10; ++i) tick(*mission);
  mission->pause();
  controller_->move_joints();
  EXPECT_TRUE(tick(*mission));
  mission->resume(*controller_, time_);
  EXPECT_FALSE(controller_->moves_joints());
  EXPECT_EQ(controller_->stacks()[controller_->active()].name, table.phases[0].stack);
}

TEST_F(MissionTest, FiguresMeasureTheirPhasesAndJudgeTheRun) {
  MissionTable table;
  table.phases = {{.name = "one", .stack = "reach", .seconds = 0.25},
                  {.name = "two", .stack = "reach", .seconds = 0.25}};
  table.measures = {{"most", "load", Measure::Take::Largest, {"two"}},
                    {"span", "load", Measure::Take::Span, {}, 0.0, 3.0}};
  const auto mission = make(table);
  load_ = 7.0;
  for (int i = 0; i < 3; ++i) tick(*mission);
  for (load_ = 1.0; tick(*mission); load_ += 1.0) {
  }
  EXPECT_EQ(mission->figures()[0].value, 3.0);
  EXPECT_EQ(mission->figures()[1].value, 6.0);
  EXPECT_EQ(mission->verdict(), "span is 6, wanted at most 3");
}

// each with one thing wrong
// up, over, back: the rows above each other are up, back, over
MissionTable around() {
  const auto row = [](const char* name) {
    return Phase{.name = name, .stack = "reach", .seconds = 0.2};
  };
  MissionTable table{{row("up"), row("back"), row("over")}, "back"};
  table.phases[0].next = "over";
  table.phases[1].last = true;
  table.phases[2].next = "back";
  return table;
}

TEST_F(MissionTest, APhaseGoesOnToTheRowThatItNames) {
  const auto mission = make(around());
  std::vector<std::size_t> seen{mission->phase()};
  std::vector<double> state;
  while (tick(*mission)) {
    if (mission->phase() != seen.back()) seen.push_back(mission->phase());
    if (mission->phase() != 2 || !state.empty()) continue;
    StateWriter writer(state);
    mission->save(writer);
  }
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 2, 1}));
  StateReader reader(state);
  mission->restore(reader);
  while (mission->phase() == 2 && tick(*mission)) continue;
  EXPECT_EQ(mission->phase(), 1u);
  const std::string text = table_text(mission->table());
  EXPECT_TRUE(contains(text, "1  up  [reach]  0.2 s  (then 'over')")) << text;
}

TEST_F(MissionTest, RowsThatGoOnForEverAreRefused) {
  const auto told = [&](std::size_t phase, const char* next, const char* wanted) {
    MissionTable table = around();
    table.phases[phase].next = next;
    const std::string text = error_text([&] { (void)make(table); });
    EXPECT_TRUE(contains(text, "phase '" + table.phases[phase].name + "', next: ")) << text;
    EXPECT_TRUE(contains(text, wanted)) << text;
  };
  told(0, "oevr", "phase 'oevr' does not exist; there are: up, back, over");
  told(0, "up", "the rows behind it go round for ever");
  told(1, "over", "the run is over after it, it does not go on");
  MissionTable table = around();
  table.phases[1].last = false;  // and so on to the one below, which goes back
  EXPECT_TRUE(contains(error_text([&] { (void)make(table); }), "go round for ever"));
}

TEST_F(MissionTest, ATableIsCheckedWhenItIsLoaded) {
  const Phase good{.name = "good", .stack = "reach", .seconds = 1.0};
  const auto text = [&](const Phase& phase) {
    return error_text([&] { (void)make(MissionTable{{good, phase}, "good"}); });
  };
  const Phase bad{.name = "bad", .stack = "reach", .seconds = 1.0};
  const auto expect = [&](const Phase& phase, const char* wanted) {
    EXPECT_TRUE(contains(text(phase), wanted)) << text(phase);
    EXPECT_TRUE(contains(text(phase), "phase 'bad'")) << text(phase);
  };
  Phase row = bad;
  row.stack = "raech";
  expect(row, "stack 'raech' does not exist; there are: reach");
  row = bad;
  row.leads = {{"hnad", Vector3(1, 0, 0), 1.0}};
  expect(row, "channel 'hnad' does not exist; there are: hand");
  row.leads = {{"hand", Vector::Ones(2), 1.0}};
  expect(row, "wants 3 finite numbers, 2 came");
  row = bad;
  row.done = {{"laod", true, 1.0}};
  expect(row, "quantity 'laod' does not exist; there are: load");
  row = bad;
  row.within = 0.0;
  expect(row, "within wants a time above 0");
  row = bad;
  row.within = 1.0;
  expect(row, "within wants `late`");
  row.late = {{ReactionKind::Back, "godo", 0.0, 1}, {ReactionKind::Abort}};
  expect(row, "phase 'godo' does not exist; there are: good, bad");
  row.late = {{ReactionKind::Back, "good", 0.0, 0}, {ReactionKind::Abort}};
  expect(row, "a count above 0");
  row.late = {{ReactionKind::Back, "good", 0.0, 1}};
  expect(row, "a way to safety");
  row = bad;
  row.within = 0.9;
  expect(row, "is always late: it takes 1 s, within wants as much, 0.9 s came");
  row = bad;
  row.late = {{ReactionKind::Abort}};
  expect(row, "wants `within`");
  row = bad;
  row.support = "feet";
  expect(row, "frame 'feet' does not exist");
  row = bad;
  row.leads = {{"hand", Vector3(0, 0, 0), 1.0}};
  expect(row, "never gives its way: its rate is 0");
  row.leads = {{"hand", Vector3(1, 0, 0), 1.0}, {"hand", Vector3(0, 1, 0), 1.0}};
  expect(row, "channel 'hand' is led twice");
  row.leads = {{"hand", {}, 1.0, Vector3(0, -0.2, 0)}};  // 0.2 m/s at most
  expect(row, "gives at most 0.2 a second: its way of -0.2 wants 1.875 s, seconds are 1");
  row.seconds = 1.875;
  EXPECT_NO_THROW((void)make(MissionTable{{good, row}, "good"}));
  row = bad;
  row.seconds = 0.0;
  row.leads = {{"hand", Vector3(1, 0, 0)}};
  expect(row, "never ends");
  row = bad;
  row.posture = "hand";
  row.keys = {{1.0, {{"a", 0.0}}}};
  expect(row, "wants a PostureTask of all coordinates");
  EXPECT_TRUE(contains(error_text([&] { (void)make(MissionTable{{good, good}, ""}); }),
                       "two phases are called 'good'"));
}

TEST_F(MissionTest, ASetupOutOfRangeIsTold) {
  const auto expect = [&](const MissionSetup& setup, const char* wanted) {
    const std::string text = error_text([&] { Mission(setup, wave_table(), *controller_, 1.0); });
    EXPECT_TRUE(contains(text, wanted)) << text;
  };
  expect({.name = "a", .support = "feet"}, "[mission]: frame 'feet' does not exist");
  expect({.name = "a", .max_seconds = 0.0}, "max_seconds wants a time above 0 [s], 0 came");
  expect({.name = "a", .max_seconds = NAN}, "max_seconds wants a time above 0 [s], nan came");
  expect({.name = "a", .max_tilt = NAN}, "max_tilt wants an angle from 0");
  expect({.name = "a", .max_tilt = -0.1}, "max_tilt wants an angle from 0");
  expect({.name = "a", .min_height = 0.1}, "min_height wants a max_tilt above 0 beside it");
}

TEST_F(MissionTest, TheTableCanBeRead) {
  MissionTable table = wave_table();
  table.phases[0].within = 3.0;
  table.phases[0].late = {{ReactionKind::Hold, "", 2.0, 2}, {ReactionKind::Abort}};
  const std::string text = table_text(table);
  EXPECT_TRUE(contains(text, "1  wait  [reach]  0.5 s\n")) << text;
  EXPECT_TRUE(contains(text, "within 3 s: hold 2 s, 2 times, then abort")) << text;
  EXPECT_TRUE(contains(text, "hand at 0.1 0 0 until 0.2")) << text;
}

TEST(Missions, AreFoundByNameAndUnknownOnesAreToldTheNames) {
  for (const std::string& name : mission_names()) EXPECT_EQ(mission_setup(name).name, name);
  const std::string text = error_text([] { (void)mission_setup("walk"); });
  EXPECT_TRUE(contains(text, "'walk' does not exist; there are: stretch")) << text;
}

TEST_F(MissionTest, ACopyThatWouldBeOfAnotherClassIsRefused) {
  SimulationOptions options;
  options.physics = false;
  const Simulation simulation(robot_.model(), controller_, options,
                              std::make_unique<Wave>(*controller_));
  EXPECT_TRUE(contains(error_text([&] { (void)simulation.clone(); }), "a clone of its own"));
}

}  // namespace

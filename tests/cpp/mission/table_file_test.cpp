// Strategy: a table in which every word occurs, with numbers that need all their bits, goes into
// lines and back; then the same lines with one thing wrong. That files run to the same bits as the
// tables they come from is tests/python/test_mission_file.py's matter.
#include "hurcules/mission/table_file.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "hurcules/mission/table_controllers.hpp"
#include "hurcules/mission/table_words.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kThird = 1.0 / 3.0;

TableFile made_up() {
  TableFile file;
  file.setup = {.name = "wave",
                .support = "base",
                .max_seconds = 90.0,
                .min_height = 0.15,
                .max_tilt = kThird,
                .casualty = "casualty_",
                .stand_off = 1.83,
                .load = "case",
                .container = "box",
                .container_stand = 2.0};
  file.controller = "lift";
  file.model = "my wave.mjb";
  file.table.safety = "way back";
  Phase up{.name = "up there", .stack = "posture", .seconds = kThird};
  up.leads = {{.channel = "hand", .rate = Vector3(0.1, -kThird, 1e-300), .way = 0.2},
              {.channel = "other", .by = Vector3(1.0, 2.0, 3.0), .to = {"q/j1", "", "q/j2"}},
              {.channel = "grip",
               .rate = Vector::Constant(1, 0.5),
               .hold = "load/n",
               .at = 230.0,
               .span = 50.0,
               .brake = true}};
  up.support = "base";
  up.brakes = {"SP", "_grip_1"};
  up.posture = "all";
  up.keys = {{0.5, {{"j 1", -0.2}, {"j2", kThird}}}, {1.0, {}}};
  up.park = Park{.body = "case",
                 .ahead = -2.4,
                 .left = 0.3,
                 .heading = kThird,
                 .speed = 0.25,
                 .yaw_rate = 0.75};
  up.done = {{"q/j1", false, -0.45, 0.1}, {"q/j2", true, kThird, 0.0}};
  up.within = 3.0;
  up.late = {{ReactionKind::Hold, "", 0.5, 1},
             {ReactionKind::Back, "up there", 0.0, 2},
             {ReactionKind::Abort}};
  up.troubles = {
      {{"q/j2", true, 2.0, 0.0}, {{ReactionKind::Ask, "", 5.0, 1}, {ReactionKind::Lower}}}};
  up.note = "# waves: 30 degrees, twice";
  up.last = true;
  file.table.phases = {up, {.name = "way back", .stack = "joints", .next = "up there"}};
  file.table.measures = {
      {"reached_rad", "q/j1", Measure::Take::Smallest, {"up there", "way back"}, -1.0, kThird}};
  return file;
}

template <class Action>
void expect_error(Action&& action, const std::string& wanted) {
  const std::string told = error_text(action);
  EXPECT_TRUE(contains(told, wanted)) << "told: " << told << "\nwanted: " << wanted;
}

std::string lines() {
  return table_lines(made_up(), "bytes");
}

std::string with(const std::string& old, const std::string& other) {
  std::string text = lines();
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), other);
}

TEST(TableFile, HoldsAllThatATableSays) {
  const TableFile file = parse_table(lines(), "wave.table");
  EXPECT_EQ(table_lines(file, "bytes"), lines());
  EXPECT_EQ(file.setup.name, "wave");
  EXPECT_EQ(file.setup.max_tilt, kThird);
  EXPECT_EQ(file.setup.container_stand, 2.0);
  ASSERT_EQ(file.table.phases.size(), 2u);
  const Phase& up = file.table.phases[0];
  const Phase wanted = made_up().table.phases[0];
  EXPECT_EQ(up.note, wanted.note);
  EXPECT_EQ(up.seconds, kThird);
  EXPECT_TRUE(up.last);
  EXPECT_EQ(file.table.phases[1].next, "up there");
  EXPECT_EQ(up.brakes, wanted.brakes);
  ASSERT_EQ(up.leads.size(), 3u);
  EXPECT_EQ(up.leads[0].rate, wanted.leads[0].rate);
  EXPECT_EQ(up.leads[1].to, wanted.leads[1].to);
  EXPECT_EQ(up.leads[1].way, INFINITY);
  EXPECT_EQ(up.leads[2].hold, "load/n");
  ASSERT_EQ(up.keys.size(), 2u);
  EXPECT_EQ(up.keys[0].angles, wanted.keys[0].angles);
  ASSERT_TRUE(up.park);
  EXPECT_EQ(up.park->heading, kThird);
  EXPECT_EQ(up.park->yaw_rate, 0.75);
  ASSERT_EQ(up.done.size(), 2u);
  EXPECT_FALSE(up.done[0].above);
  EXPECT_EQ(up.done[1].value, kThird);
  ASSERT_EQ(up.late.size(), 3u);
  EXPECT_EQ(up.late[1].phase, "up there");
  EXPECT_EQ(up.late[1].times, 2);
  ASSERT_EQ(up.troubles.size(), 1u);
  EXPECT_EQ(up.troubles[0].reactions[0].seconds, 5.0);
  EXPECT_EQ(file.table.phases[1].within, INFINITY);
  ASSERT_EQ(file.table.measures.size(), 1u);
  EXPECT_EQ(file.table.measures[0].take, Measure::Take::Smallest);
  EXPECT_EQ(file.table.measures[0].most, kThird);
}

TEST(TableFile, CommentsAndEmptyLinesSayNothing) {
  const std::string text = with("  stack posture\n", "\n    # as before\r\n  stack posture\r\n");
  EXPECT_EQ(table_lines(parse_table(text, "wave.table"), "bytes"), lines());
}

TEST(TableFile, ABrokenLineIsToldWithItsNumberAndWhatExists) {
  const auto told = [](const std::string& text, const std::string& wanted) {
    expect_error([&] { (void)parse_table(text, "wave.table"); }, wanted);
  };
  told(with("  stack posture", "  stock posture"),
       "wave.table, line 19: word 'stock' does not exist; there are: ");
  told(with("  stack posture", "  stock posture"), "stack");
  told(with("  seconds 0.3", "  seconds soon 0.3"),
       "wave.table, line 20: seconds: wanted a number, 'soon 0.3");
  told(with("rate 0.1 ", "rate 0.1, "), "rate: wanted a number, '0.1,' came");
  told(with("angle j2 ", "angle j2"), "angle: wanted a name and a number, 'j2");
  told(with("q/j1 <= ", "q/j1 < "), "done: condition 'q/j1 < -0.45 for 0.1 s': wanted 'QUANTITY");
  told(with("late abort", "late give up"), "late: reaction 'give up': wanted 'back to PHASE'");
  told(with("take smallest", "take least"), "take 'least' does not exist; there are: ");
  told(with("  last\n", "  last true\n"), "last: wanted nothing after it, 'true' came");
  told(with("    body case", "      body case"),
       "'body' wants 4 spaces before it, or fewer, 6 came");
  told(with("  within 3\n", "  within 3\n  within 4\n"), "'within' stands twice below one row");
  told(with("controller lift\n", ""), "wave.table wants a line 'controller'");
}

TEST(TableFile, AFileThatIsCutOffOrSomethingElseIsTold) {
  const std::string text = lines();
  for (std::size_t size = text.size() - 1; size-- > 1;) {
    EXPECT_THROW((void)parse_table(text.substr(0, size), "wave.table"), Error) << size;
  }
  expect_error([&] { (void)parse_table(text.substr(0, text.size() / 2), "wave.table"); },
               "wave.table is cut off: its last line wants to be 'end'");
  expect_error([] { (void)parse_table("[mission]\n", "wave.toml"); },
               "wave.toml is no table of a mission: its first line wants to be 'hurcules-table 1', "
               "it is '[mission]");
  expect_error([] { (void)read_table("/nowhere/wave.table"); },
               "file '/nowhere/wave.table' cannot be read");
}

TEST(TableFile, ANoteOfTwoLinesIsRefused) {
  TableFile file = made_up();
  file.table.phases[0].note = "waves\ntwice";
  expect_error([&] { (void)table_lines(file, ""); }, "a table file wants one line for note");
}

TEST(TableFile, TheModelIsTheOneItWasWrittenWith) {
  const std::filesystem::path folder = testing::TempDir();
  const std::string path = (folder / "wave.table").string(), bytes = "no model";
  TableFile file = parse_table(table_lines(made_up(), bytes), path);
  std::filesystem::remove(folder / file.model);
  expect_error([&] { (void)load_model_of(file, path); }, "my wave.mjb' of '");
  std::ofstream(folder / file.model) << bytes.substr(1);
  expect_error([&] { (void)load_model_of(file, path); },
               "my wave.mjb' is not the one that was written with");
  std::ofstream(folder / file.model) << bytes;
  expect_error([&] { (void)load_model_of(file, path); }, "my wave.mjb' cannot be loaded");
  file.mujoco = "3.0.0";
  expect_error([&] { (void)load_model_of(file, path); }, "was written by MuJoCo 3.0.0, this is ");
}

TEST(TableWords, AreReadAsTheyAreWritten) {
  for (const char* text : {"q/j1 >= 0.3", "q/j1 <= -1e-05 for 2.5 s"}) {
    EXPECT_EQ(exact_text(read_condition(text)), text);
  }
  EXPECT_EQ(exact_text(read_condition(" q/j1>=3 for 2s ")), "q/j1 >= 3 for 2 s");
  EXPECT_EQ(exact_text(read_reaction(" back to set down ")), "back to set down");
  for (const char* text :
       {"back to set down, 3 times", "hold 0.5 s", "ask 30 s, 2 times", "lower", "abort"}) {
    EXPECT_EQ(exact_text(read_reaction(text)), text);
  }
  for (const char* text : {"", "q/j1 > 3", "q/j1 >= much", "two words >= 3", "q/j1 >= 3 for s",
                           "q/j1 >= 3 4", "q/j1 >= 3 for 2", ">= 3"}) {
    expect_error([&] { (void)read_condition(text); }, "wanted 'QUANTITY >= NUMBER'");
  }
  for (const char* text : {"", "retreat", "hold", "hold 2", "lower, many times", "back to ",
                           "lower, 3", "lower, 2 times, 3 times", "abort 2 s"}) {
    expect_error([&] { (void)read_reaction(text); }, "wanted 'back to PHASE'");
  }
}

TEST(TableController, AnUnknownNameAndAnotherRobotAreTold) {
  const ModelPtr arm = load_model_text(kArm);
  expect_error([&] { (void)table_controller("lft", arm, "lexicographic"); },
               "controller of a table 'lft' does not exist; there are: disposal, lift");
  EXPECT_THROW((void)table_controller("lift", arm, "lexicographic"), Error);
  EXPECT_THROW((void)table_controller("disposal", arm, "lexicographic"), Error);
}

}  // namespace

// mission: tables of phases as data, and the simulation that runs one.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "annotated.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/mission/mission_simulation.hpp"
#include "hurcules/mission/table_controllers.hpp"
#include "hurcules/mission/table_file.hpp"
#include "hurcules/mission/table_words.hpp"
#include "mujoco_pointer.hpp"
#include "options.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_mission(py::module_& module);

namespace {

constexpr const char* kCondition = R"(A quantity on one side of a value, for some time on end.

Args:
  quantity: a column of the log (`simulation.channels`), or of the scene: position/OBJECT/x, joint/JOINT, sensor/SENSOR, contact_force/BODY.
  above: the quantity is at least the value; False: at most.
  value: in the unit of the quantity.
  seconds: [s].
)";
constexpr const char* kReaction = R"(What a mission does about trouble.

Args:
  kind: "back" to a phase, "hold" or "ask" for some seconds, "lower" to the way to safety, "abort".
  phase: of "back"; the present one begins anew.
  seconds: [s] of "hold" and "ask".
  times: in a run; then the next reaction in the row.
)";
constexpr const char* kTrouble = R"(What must not be, and the reactions to it.

Args:
  when: Condition.
  reactions: list of Reaction; the first that is left; the last is "lower" or "abort".
)";
constexpr const char* kLead = R"(What a phase does to one channel.

Args:
  channel: of the controller.
  rate: (k,) SI at which it is led, or
  way: until so much has been given [SI s]; inf: on and on.
  by: (k,) the way [SI s] that it is led in the seconds of the phase, smoothly.
  to: look and move: quantities, one an entry of `by` or `value`, that are added to it as they are
    when the phase begins; "" adds nothing.
  hold: a quantity that the rate holds at a value: in full where it is `span` or more below, backwards
    above; "": none.
  at: that value, in the quantity's unit.
  span: in the same unit, above 0.
  value: (k,) what a `Target` or a `ForceReference` is set to, in its unit.
  follow: the quantities of `to` are added to the value as they are now, tick by tick.
  brake: of a channel of joints: once `hold` is at its value their brakes bear it, until it has fallen
    by `span`; then the rate acts in full.
)";
constexpr const char* kKey = R"(Angles of coordinates, or places of joints, at a share of a motion.

Args:
  share: 0 to 1.
  angles: by coordinate [rad], or by joint [rad] or [m]; the others stay as at the beginning.
)";
constexpr const char* kPark = R"(Where a phase parks the robot: its centre of mass, on the ground.

Args:
  body: from which the pose counts, as it is when the phase begins: ahead along its heading, its y
    axis to its left; "": from where the robot stood as the run began.
  ahead: [m].
  left: [m].
  heading: [rad] to the left.
  speed: [m/s] at most.
  yaw_rate: [rad/s] at most, turning in place.
)";
constexpr const char* kPhase = R"(One row of a mission's table.

Args:
  name: of the row.
  stack: of the controller, which rules, or "joints": none rules, joints are moved one by one.
  seconds: [s] that ways and postures take, the least duration.
  leads: list of Lead; channels that are not led hold.
  support: body that the robot stands on from here on; "": that of the row before.
  brakes: joints that rest behind their brakes in this phase, "SP" both; all others are open.
  posture: channel of a PostureTask over all coordinates; of the stack "joints" a JointRates.
  keys: list of PostureKey, where it leads to.
  park: Park, or None: drives there; where that fails, what is done when it takes too long.
  done: list of Condition, all of them, when all motions have ended.
  within: [s].
  late: list of Reaction, when it takes longer.
  troubles: list of Trouble.
  note: what it is for, in words: for the printed table and the film.
  next: name of the phase that it goes on to; "": the one below.
  last: the run is over after it; what follows is only reached from elsewhere.
)";
constexpr const char* kMeasure = R"(A figure of a run: a quantity over some phases.

Args:
  name: of the figure, with its unit.
  quantity: a column of the log (`simulation.channels`), or of the scene as in Condition.
  take: "largest", "smallest", "span" (largest less smallest) or "last".
  phases: list of names, none: all.
  least: below, the mission failed.
  most: above, the mission failed.
)";
constexpr const char* kTable = R"(A mission as data.

Args:
  phases: list of Phase, in their order.
  safety: name of the phase that "lower" goes to.
  measures: list of Measure.
)";
constexpr const char* kTableText =
    R"(The table as text: a line a phase, note, conditions and reactions below.)";
constexpr const char* kSetup = R"(What a mission wants of its run.

Args:
  name: of the mission.
  support: body that the robot stands on.
  max_seconds: [s] it fails when it takes longer.
  min_height: [m] of `fall_frame` above the support; below, the robot fell.
  max_tilt: [rad] of the support against its start; above, the robot fell. 0: nobody looks.
  fall_frame: body or site whose height is watched; "": none is, `max_tilt` alone tells.
  casualty: what stands before the names of the person to watch, "" for nobody.
  stand_off: [m] of the robot's centre of mass from the person's where it stands square to the body;
    from the centre of the load likewise.
  load: body of a thing to carry, with sites LOAD_left and LOAD_right to grasp; "" for none.
  container: body of what it is put into, "" for none.
  container_stand: [m] of the robot's centre of mass from its centre where it stands square to it.
)";

constexpr const char* kReadCondition = R"(Reads "QUANTITY >= 0.3 for 2 s".

Raises:
  Error: it is none.
)";
constexpr const char* kReadReaction =
    R"(Reads "back to PHASE", "hold 2 s", "ask 30 s", "lower" or "abort", maybe with ", 3 times".

Raises:
  Error: it is none.
)";
constexpr const char* kWords = "As text, which reads back as the same, all bits of its numbers.";
constexpr const char* kTableController =
    R"(The controller that the table of a mission commands; its robot stands at the start.

"lift" (of lift and casualty) has the stacks `arms`, `press` (force control downwards) and `posture`;
"disposal" has `hands` (place and direction of both, then pelvis, then posture) and `posture`, and the
channels `left_grip` and `right_grip` of the fingers. Both have a channel a task, `drive` for the
tracks, and `joints` for all joints but belts and fingers, one by one.

Args:
  name: "lift" or "disposal".
  model: mujoco.MjModel of its scene.
  method: how the hierarchy is solved, one of `rhqp.method_names()`.

Raises:
  Error: another name, or a scene without the robot.
)";
constexpr const char* kLiftStart =
    R"(Where a lift starts, beside the keyframe `stretch`: angles [rad] by coordinate.

"KN" means the coordinate of this name, or both sides'.
)";
constexpr const char* kTableLines = R"(The text of a table file, which `hurcules-sim` runs.

Args:
  setup: MissionSetup.
  table: MissionTable.
  controller: name of a `table_controller`.
  model: name of the model's file, which lies beside it.
  model_bytes: of that file, as mj_saveModel writes it.

Raises:
  Error: a name or a note of more than one line.
)";
constexpr const char* kCheckRows =
    R"(Checks what of a table can be told without a controller: phases, reactions, time-outs, ways.

Args:
  table: MissionTable.

Raises:
  Error: naming the row, with what was wanted and what came.
)";
constexpr const char* kReadTable = R"(What stands in a table file: MissionSetup and MissionTable.

Args:
  path: of the file.

Raises:
  Error: it cannot be read, with its line, what was wanted and what exists.
)";

const std::vector<std::pair<std::string, ReactionKind>>& kinds() {
  static const std::vector<std::pair<std::string, ReactionKind>> all = {
      {"back", ReactionKind::Back},   {"hold", ReactionKind::Hold},   {"ask", ReactionKind::Ask},
      {"lower", ReactionKind::Lower}, {"abort", ReactionKind::Abort},
  };
  return all;
}

template <class Value>
Value named(const std::vector<std::pair<std::string, Value>>& all, const char* what,
            const std::string& text) {
  std::vector<std::string> names;
  for (const auto& [name, value] : all) {
    if (name == text) return value;
    names.push_back(name);
  }
  throw Error(unknown_name(what, text, names));
}

template <class Value>
std::string name_of(const std::vector<std::pair<std::string, Value>>& all, Value wanted) {
  for (const auto& [name, value] : all) {
    if (value == wanted) return name;
  }
  return "";
}

void bind_files(py::module_& module) {
  module.def(
      "table_controller",
      [](const std::string& name, const ModelObject& model, const std::string& method) {
        return table_controller(name, held_model(model), method);
      },
      "name"_a, "model"_a, "method"_a = "lexicographic", kTableController);
  module.def(
      "lift_start",
      [] {
        const auto& start = lift_start();
        return std::map<std::string, double>(start.begin(), start.end());
      },
      kLiftStart);
  module.def(
      "table_lines",
      [](const MissionSetup& setup, const MissionTable& table, const std::string& controller,
         const std::string& model, const py::bytes& model_bytes) {
        TableFile file;
        file.setup = setup;
        file.controller = controller;
        file.model = model;
        file.table = table;
        return table_lines(std::move(file), std::string_view(model_bytes));
      },
      "setup"_a, "table"_a, "controller"_a, "model"_a, "model_bytes"_a, kTableLines);
  module.def(
      "read_table",
      [](const std::string& path) {
        TableFile file = read_table(path);
        return std::pair(std::move(file.setup), std::move(file.table));
      },
      "path"_a, kReadTable);
}

void bind_rows(py::module_& module) {
  bind_options<Condition>(
      module, "Condition", kCondition,
      {required("quantity", &Condition::quantity), field("above", &Condition::above),
       field("value", &Condition::value), field("seconds", &Condition::seconds)})
      .def(
          "words", [](const Condition& self) { return exact_text(self); }, kWords)
      .def_static("read", &read_condition, "text"_a, kReadCondition);
  bind_options<Reaction>(
      module, "Reaction", kReaction,
      {text_field<Reaction>(
           "kind", [](const Reaction& self) { return name_of(kinds(), self.kind); },
           [](Reaction& self, const std::string& text) {
             self.kind = named(kinds(), "reaction", text);
           }),
       field("phase", &Reaction::phase), field("seconds", &Reaction::seconds),
       field("times", &Reaction::times)})
      .def(
          "words", [](const Reaction& self) { return exact_text(self); }, kWords)
      .def_static("read", &read_reaction, "text"_a, kReadReaction);
  bind_options<Trouble>(
      module, "Trouble", kTrouble,
      {required("when", &Trouble::when), required("reactions", &Trouble::reactions)});
  bind_options<Lead>(
      module, "Lead", kLead,
      {required("channel", &Lead::channel), field("rate", &Lead::rate), field("way", &Lead::way),
       field("by", &Lead::by), field("to", &Lead::to), field("hold", &Lead::hold),
       field("at", &Lead::at), field("span", &Lead::span), field("value", &Lead::value),
       field("follow", &Lead::follow), field("brake", &Lead::brake)});
  bind_options<PostureKey>(
      module, "PostureKey", kKey,
      {field("share", &PostureKey::share), field("angles", &PostureKey::angles)});
  bind_options<Park>(module, "Park", kPark,
                     {field("body", &Park::body), field("ahead", &Park::ahead),
                      field("left", &Park::left), field("heading", &Park::heading),
                      field("speed", &Park::speed), field("yaw_rate", &Park::yaw_rate)});
  bind_options<Phase>(
      module, "Phase", kPhase,
      {required("name", &Phase::name), required("stack", &Phase::stack),
       field("seconds", &Phase::seconds), field("leads", &Phase::leads),
       field("posture", &Phase::posture), field("keys", &Phase::keys), field("done", &Phase::done),
       field("within", &Phase::within), field("late", &Phase::late),
       field("troubles", &Phase::troubles), field("support", &Phase::support),
       field("brakes", &Phase::brakes), field("park", &Phase::park), field("note", &Phase::note),
       field("next", &Phase::next), field("last", &Phase::last)});
}

}  // namespace

void bind_mission(py::module_& module) {
  bind_rows(module);
  bind_options<Measure>(
      module, "Measure", kMeasure,
      {required("name", &Measure::name), required("quantity", &Measure::quantity),
       text_field<Measure>(
           "take", [](const Measure& self) { return name_of(take_words(), self.take); },
           [](Measure& self, const std::string& text) {
             self.take = named(take_words(), "take", text);
           }),
       field("phases", &Measure::phases), field("least", &Measure::least),
       field("most", &Measure::most)});
  bind_options<MissionTable>(
      module, "MissionTable", kTable,
      {required("phases", &MissionTable::phases), field("safety", &MissionTable::safety),
       field("measures", &MissionTable::measures)})
      .def("text", &table_text, kTableText);
  bind_options<MissionSetup>(
      module, "MissionSetup", kSetup,
      {required("name", &MissionSetup::name), field("support", &MissionSetup::support),
       field("max_seconds", &MissionSetup::max_seconds),
       field("min_height", &MissionSetup::min_height), field("max_tilt", &MissionSetup::max_tilt),
       field("fall_frame", &MissionSetup::fall_frame), field("casualty", &MissionSetup::casualty),
       field("stand_off", &MissionSetup::stand_off), field("load", &MissionSetup::load),
       field("container", &MissionSetup::container),
       field("container_stand", &MissionSetup::container_stand)});
  bind_files(module);
  module.def("check_rows", &check_rows, "table"_a, kCheckRows);
}

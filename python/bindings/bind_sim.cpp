// sim and mission: the closed loop, missions, and one physics step with tracks.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "annotated.hpp"
#include "bind_sensors.hpp"
#include "bind_sim_docs.hpp"
#include "command.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/mission/mission_simulation.hpp"
#include "hurcules/sim/quantities.hpp"
#include "hurcules/sim/simulation.hpp"
#include "in_use.hpp"
#include "mujoco_pointer.hpp"
#include "options.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_sim(py::module_& module);

namespace {

double now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since).count();
}

void step_physics(const ModelObject& model, const DataObject& data, int n) {
  const Scene scene = scene_of(model, data);
  require(n >= 0, "step wants a number of steps >= 0, got " + std::to_string(n));
  const InUse in_use("MjData", scene.data);
  const py::gil_scoped_release release;
  const Tracks tracks(scene.model);
  for (int i = 1; i < n; ++i) step_unseen(scene.model, scene.data, tracks);
  if (n > 0) step(scene.model, scene.data, tracks);
}

std::unique_ptr<Simulation> make_simulation(const ModelObject& model, const DataObject& data,
                                            const std::string& mission,
                                            const MissionOptions& options) {
  const Scene scene = scene_of(model, data);
  return std::make_unique<MissionSimulation>(held_model(model), mission, options, scene.data);
}

std::unique_ptr<Simulation> make_table(const ModelObject& model, const DataObject& data,
                                       const std::shared_ptr<WholeBodyController>& controller,
                                       const MissionTable& table, const MissionSetup& setup,
                                       const MissionOptions& options) {
  const Scene scene = scene_of(model, data);
  auto mission = std::make_unique<Mission>(setup, table, *controller, options.variation);
  return std::make_unique<MissionSimulation>(held_model(model), controller, std::move(mission),
                                             options, scene.data);
}

std::unique_ptr<Simulation> make_own(const ModelObject& model, const DataObject& data,
                                     const std::shared_ptr<WholeBodyController>& controller,
                                     const MissionOptions& options) {
  const Scene scene = scene_of(model, data);
  return std::make_unique<Simulation>(held_model(model), controller, options, nullptr, scene.data);
}

// held, so that another simulation may take it; it lives in this one
std::shared_ptr<WholeBodyController> controller_of(const py::object& self) {
  auto& simulation = self.cast<Simulation&>();
  return {&simulation.controller(), [self](WholeBodyController*) {}};
}

// in pieces, so that Ctrl-C is heard
int step_simulation(Simulation& self, int n, const CommandObject& given) {
  constexpr int kPiece = 1000;
  const std::optional<Vector> command = command_of(self.controller(), given);
  require(n >= 0, "step wants a number of ticks >= 0, got " + std::to_string(n));
  InUse in_use("Simulation", &self, &self.controller());
  int done = 0;
  do {
    const int piece = std::min(n - done, kPiece);
    {
      py::gil_scoped_release release;
      done += self.step(piece, command ? &*command : nullptr, done == 0);
    }
    in_use.let_read();
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  } while (done < n && !self.finished());
  return done;
}

// what reads a simulation, between the ticks of another thread
template <class Read>
auto at_rest(const Read& read) {
  return [read](const Simulation& self) {
    InUse::wait(&self);
    return read(self);
  };
}

py::dict series(const Recorder& recorder) {
  py::dict result;
  for (std::size_t i = 0; i < recorder.columns(); ++i) {
    result[py::str(recorder.channels()[i])] = recorder.series(i);
  }
  return result;
}

py::dict excess(const Excess& worst) {
  return py::dict("position_rad"_a = worst.position, "velocity"_a = worst.velocity,
                  "torque"_a = worst.torque);
}

py::dict limit_violation(const Simulation& self) {
  py::dict result = excess(self.limits().measured());
  result["commanded"] = excess(self.limits().commanded());
  return result;
}

py::dict figures(const Simulation& self) {
  py::dict result;
  for (const Figure& figure : self.figures()) result[py::str(figure.name)] = figure.value;
  return result;
}

py::dict thesis_figures(const Simulation& self) {
  py::dict result;
  if (!self.supervisor()) return result;
  for (const Figure& figure : self.supervisor()->figures()) {
    if (figure.thesis == figure.thesis) result[py::str(figure.name)] = figure.thesis;
  }
  return result;
}

py::dict wanted_figures(const Simulation& self) {
  py::dict result;
  for (const Figure& figure : self.figures()) {
    if (std::isinf(figure.least) && std::isinf(figure.most)) continue;
    result[py::str(figure.name)] = py::make_tuple(figure.least, figure.most);
  }
  return result;
}

py::dict solver(const Simulation& self) {
  const Telemetry& now = self.telemetry();
  return py::dict("status"_a = now.status, "factorizations"_a = now.factorizations,
                  "changes"_a = now.changes, "optimality"_a = now.optimality);
}

std::vector<std::pair<double, std::string>> events(const Simulation& self) {
  std::vector<std::pair<double, std::string>> result;
  for (const Event& event : self.events().events()) {
    result.emplace_back(event.time, self.text(event));
  }
  return result;
}

std::vector<std::string> phase_names(const Simulation& self) {
  return self.supervisor() ? self.supervisor()->phase_names() : std::vector<std::string>{};
}

std::vector<std::string> phase_notes(const Simulation& self) {
  std::vector<std::string> notes;
  if (const auto* mission = dynamic_cast<const Mission*>(self.supervisor())) {
    for (const Phase& phase : mission->table().phases) notes.push_back(phase.note);
  }
  return notes;
}

std::string phase(const Simulation& self) {
  if (!self.supervisor()) return "";
  return phase_names(self)[self.supervisor()->phase()];
}

void go(Simulation& self, const std::string& phase) {
  const std::vector<std::string> names = phase_names(self);
  const auto found = std::find(names.begin(), names.end(), phase);
  require(names.empty() || found != names.end(), unknown_name("phase", phase, names));
  self.go(static_cast<std::size_t>(found - names.begin()));
}

void pause_simulation(Simulation& self) {
  const InUse in_use("Simulation", &self);
  self.pause();
}

void resume_simulation(Simulation& self) {
  const InUse in_use("Simulation", &self);
  self.resume();
}

void answer(Simulation& self, bool yes) {
  const InUse in_use("Simulation", &self);
  self.answer(yes);
}

const std::vector<std::string>& command_names(const Simulation& self) {
  return self.controller().command_names();
}

const Vector& command_scale(const Simulation& self) {
  return self.controller().scale();
}

constexpr double kRounding = 1e-6;  // [rad] or [m] beyond a range

void require_in_range(const JointActuator& joint, const ConstVectorRef& position) {
  for (Index i = 0; i < position.size(); ++i) {
    const double most = std::max(joint.lower - position[i], position[i] - joint.upper);
    if (most <= kRounding) continue;
    throw Error("follow: joint '" + joint.joint + "' goes from " + std::to_string(joint.lower) +
                " to " + std::to_string(joint.upper) + ", row " + std::to_string(i) + " wants " +
                std::to_string(position[i]));
  }
}

// the reference of joints, row by row: one tick each
int follow(Simulation& self, const std::vector<std::string>& joints, const Matrix& position,
           const Matrix& velocity) {
  const auto m = static_cast<Index>(joints.size());
  require(position.cols() == m && velocity.cols() == m && position.rows() == velocity.rows() &&
              position.allFinite() && velocity.allFinite(),
          "positions and velocities want shape (ticks, " + std::to_string(m) +
              ") each and finite numbers; (" + std::to_string(position.rows()) + ", " +
              std::to_string(position.cols()) + ") and (" + std::to_string(velocity.rows()) + ", " +
              std::to_string(velocity.cols()) + ") came");
  const JointServo& servo = self.controller().servo();
  for (Index k = 0; k < m; ++k) {
    const Index found = servo.find(joints[static_cast<std::size_t>(k)]);
    require_in_range(servo.actuator(found), position.col(k));
  }
  const InUse in_use("Simulation", &self, &self.controller());
  int done = 0;
  for (Index i = 0; i < position.rows() && !self.finished(); ++i) {
    {
      py::gil_scoped_release release;
      for (Index k = 0; k < m; ++k) {
        self.controller().move(joints[static_cast<std::size_t>(k)], position(i, k), velocity(i, k));
      }
      done += self.step(1);
    }
    if (i % 1000 == 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return done;
}

Vector state(const Simulation& self) {
  const std::vector<double> values = self.state();
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

void restore(Simulation& self, const Vector& state) {
  const InUse in_use("Simulation", &self);
  self.restore(std::vector<double>(state.begin(), state.end()));
}

py::dict servo_table(const Robot& robot) {
  py::dict table;
  for (const ServoGains& row : model_servo_gains(joint_actuators(robot))) {
    table[py::str(row.joint)] = py::make_tuple(row.inertia, row.bandwidth);
  }
  return table;
}

py::dict mode_ranges(const std::string& mode) {
  py::dict ranges;
  for (const ModeRange& range : ranges_of_mode(mode)) {
    ranges[py::str(range.coordinate)] = py::make_tuple(range.lower, range.upper);
  }
  return ranges;
}

// whether there is a clock
Field<MissionOptions> timed() {
  using Options = MissionOptions;
  const auto get = [](const Options& self) { return self.clock != nullptr; };
  const auto set = [](Options& self, bool timed) { self.clock = timed ? now : nullptr; };
  return {.name = "timed",
          .type = "bool",
          .get = [get](const Options& self) { return py::bool_(get(self)); },
          .set = [set](Options& self, py::handle value) { set(self, value.cast<bool>()); },
          .equal = [get](const Options& a, const Options& b) { return get(a) == get(b); },
          .bind = [=](py::class_<Options>& bound) { bound.def_property("timed", get, set); }};
}

void bind_simulation_options(py::module_& module) {
  using Options = MissionOptions;
  py::enum_<BaseSource>(module, "BaseSource", "Where the planner's support stands.")
      .value("Held", BaseSource::Held, "where it stood at the start")
      .value("Sensed", BaseSource::Sensed, "where it is now");
  py::enum_<Ending>(module, "Ending", "Why a run is over.")
      .value("Running", Ending::Running, "it is not")
      .value("Completed", Ending::Completed, "the mission, with all figures within their bounds")
      .value("Missed", Ending::Missed, "the mission, or aborted, with one out of them")
      .value("TimeUp", Ending::TimeUp)
      .value("Fell", Ending::Fell)
      .value("Diverged", Ending::Diverged, "numbers out of range")
      .value("SolverFailed", Ending::SolverFailed)
      .value("Held", Ending::Held, "its sensors could not be believed");
  bind_options<FallOptions>(
      module, "FallOptions", kFall,
      {field("frame", &FallOptions::frame), field("min_height", &FallOptions::min_height, "[m]"),
       field("max_tilt", &FallOptions::max_tilt, "[rad]")},
      Arguments::Positional);
  bind_options<Options>(
      module, "SimulationOptions", kOptions,
      {field<Options>("seed", &Options::seed), field("variation", &Options::variation),
       field("method", &Options::method), field<Options>("record", &Options::record), timed(),
       field("base", &Options::base), field<Options>("sensors", &Options::sensors),
       field<Options>("monitors", &Options::monitors),
       field<Options>("max_seconds", &Options::max_seconds,
                      "[s] the run ends when it takes longer"),
       field<Options>("physics", &Options::physics,
                      "false: the robot is where it is commanded to be"),
       field<Options>("fall", &Options::fall, "when the robot counts as fallen"),
       field<Options>("adds_command", &Options::adds_command,
                      "a command is added to the mission's own"),
       field<Options>("loaded_springs", &Options::loaded_springs,
                      "springs start where they bear what hangs on them")});
}

void bind_run(py::class_<Simulation>& simulation) {
  simulation.def("step", &step_simulation, "n"_a = 1, "command"_a = py::none(), kStep)
      .def(
          "reset",
          [](Simulation& self, std::uint64_t seed, const std::optional<Vector>& start) {
            const InUse in_use("Simulation", &self);
            self.reset(seed, start ? &*start : nullptr);
          },
          "seed"_a, "start"_a = py::none(), kReset)
      .def(
          "read",
          [](const Simulation& self, const Quantities& quantities) {
            InUse::wait(&self);
            Vector values(quantities.size());
            quantities.read(self, values);
            return values;
          },
          "quantities"_a, "(m,) their present values.")
      .def("state", at_rest(state), kState)
      .def("restore", &restore, "state"_a, kRestore)
      .def("operator_command", &Simulation::operator_command, kOperatorCommand)
      .def("go", &go, "phase"_a, kGo)
      .def("pause", &pause_simulation, kPause)
      .def("resume", &resume_simulation, kResume)
      .def("answer", &answer, "yes"_a.noconvert(), kAnswer)
      .def("heartbeat", waiting(&Simulation::heartbeat), kHeartbeat)
      .def_property_readonly("paused", &Simulation::paused, "its mission stands still: `pause`")
      .def_property_readonly("question", &Simulation::question, kQuestion)
      .def_property_readonly("dt", &Simulation::dt, "[s]")
      .def_property_readonly("physics", &Simulation::physics, "False: it moves without forces")
      .def_property_readonly("records", &Simulation::records, "False: `log` is empty")
      .def_property_readonly("time", &Simulation::time, "[s] since reset")
      .def_property_readonly("finished", &Simulation::finished)
      .def_property_readonly("success", &Simulation::success)
      .def_property_readonly("reason", &Simulation::reason, kReason)
      .def_property_readonly("ending", &Simulation::ending, "Ending: the reason as a number")
      .def_property_readonly("phase", &phase, "of the mission; '' without one")
      .def_property_readonly("phases", &phase_names)
      .def_property_readonly("phase_notes", &phase_notes, "of each, what it is for")
      .def_property_readonly("command_names", &command_names)
      .def_property_readonly("command_scale", &command_scale, py::return_value_policy::copy,
                             "(k,) SI")
      .def_property_readonly("controller", &controller_of, "WholeBodyController of the loop")
      .def_property_readonly(
          "plant", [](Simulation& self) -> Plant& { return self.plant(); },
          py::return_value_policy::reference_internal, "Plant that it steps")
      .def_property_readonly(
          "brakes", [](Simulation& self) -> Brakes& { return self.plant().brakes(); },
          py::return_value_policy::reference_internal, "Brakes of the joints' drives")
      .def("follow", &follow, "joints"_a, "positions"_a, "velocities"_a, kFollow);
}

void bind_results(py::class_<Simulation>& simulation) {
  simulation
      .def("observation",
           at_rest([](const Simulation& self) { return self.observation().snapshot(); }),
           kObservation)
      .def_property_readonly("observation_names",
                             [](const Simulation& self) { return self.observation().channels(); })
      .def_property_readonly("levels", &Simulation::levels, "decreasing priority")
      .def("level_errors",
           at_rest([](const Simulation& self) { return self.telemetry().level_error_measured; }),
           kLevelErrors)
      .def("commanded_level_errors",
           at_rest([](const Simulation& self) { return self.telemetry().level_error; }),
           kCommandedErrors)
      .def("solver", at_rest(solver), kSolver)
      .def_property_readonly("channels",
                             [](const Simulation& self) { return self.log().channels(); })
      .def("log", at_rest([](const Simulation& self) { return series(self.log()); }), kLog)
      .def("timings", at_rest([](const Simulation& self) { return series(self.timings()); }),
           kTimings)
      .def("figures", at_rest(figures), kFigures)
      .def("thesis_figures", at_rest(thesis_figures), kThesisFigures)
      .def("wanted_figures", at_rest(wanted_figures), kWantedFigures)
      .def("events", at_rest(events), kEvents)
      .def("limit_violation", at_rest(limit_violation), kViolation);
}

}  // namespace

void bind_sim(py::module_& module) {
  module.def("step", &step_physics, "model"_a, "data"_a, "n"_a = 1, kStepPhysics);
  module.def("missions", &mission_names, kMissions);
  module.def(
      "mission_scene", [](const std::string& mission) { return mission_setup(mission).scene; },
      "mission"_a, kMissionScene);
  module.def("servo_table", &servo_table, "robot"_a, kServoTable);
  module.def("mode_ranges", &mode_ranges, "mode"_a, kModeRanges);
  bind_sensors(module);
  bind_simulation_options(module);
  py::class_<Simulation> simulation(module, "Simulation", kSimulation);
  simulation
      .def(py::init(&make_simulation), "model"_a, "data"_a, "mission"_a = "stretch",
           "options"_a = MissionOptions{}, py::keep_alive<1, 2>(), py::keep_alive<1, 3>())
      .def(py::init(&make_table), "model"_a, "data"_a, "controller"_a, "table"_a, "setup"_a,
           "options"_a = MissionOptions{}, py::keep_alive<1, 2>(), py::keep_alive<1, 3>())
      .def(py::init(&make_own), "model"_a, "data"_a, "controller"_a, "options"_a = MissionOptions{},
           py::keep_alive<1, 2>(), py::keep_alive<1, 3>());
  py::class_<Quantities>(module, "Quantities", kQuantities)
      .def(py::init<const Simulation&, const std::vector<std::string>&>(), "simulation"_a,
           "names"_a)
      .def_property_readonly("names", &Quantities::names)
      .def_property_readonly("sizes", &Quantities::sizes, "of each name")
      .def("__len__", &Quantities::size);
  bind_run(simulation);
  bind_results(simulation);
  bind_sensor_results(simulation);
}

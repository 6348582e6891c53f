// hurcules-sim: runs a mission without Python, says how it went, and how long each stage took.
//
// Ends with 0 when the mission succeeded or was stopped by --seconds, 1 when it failed, 2 for wrong
// usage, 128 and the signal's number after Ctrl-C, SIGTERM or SIGHUP (130, 143, 129); what was
// recorded until then is saved.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/mission/mission_simulation.hpp"
#include "hurcules/mission/table_controllers.hpp"
#include "hurcules/mission/table_file.hpp"
#include "hurcules/sim/realistic_sensors.hpp"
#include "report.hpp"

namespace {

using namespace hurcules_sim;

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2, kSignal = 128 };

volatile std::sig_atomic_t interrupted = 0;  // by which signal

double now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since).count();
}

// opened before the run, so that a place that cannot be written is told at once
std::ofstream open(const std::string& file) {
  std::ofstream out;
  if (file.empty()) return out;
  out.open(file);
  hurcules::require(out.is_open(),
                    "file '" + file + "' cannot be written: " + std::strerror(errno));
  return out;
}

hurcules::MissionSimulation from_table(const Arguments& arguments,
                                       const hurcules::MissionOptions& options) {
  hurcules::require(arguments.model.empty(), "--model: a table names its own model");
  const hurcules::TableFile file = hurcules::read_table(arguments.mission);
  const hurcules::ModelPtr model = hurcules::load_model_of(file, arguments.mission);
  const auto controller = hurcules::table_controller(file.controller, model, options.method);
  auto mission =
      std::make_unique<hurcules::Mission>(file.setup, file.table, *controller, options.variation);
  return {model, controller, std::move(mission), options};
}

hurcules::MissionSimulation make_simulation(const Arguments& arguments) {
  hurcules::MissionOptions options;
  options.seed = arguments.seed;
  options.variation = arguments.variation;
  if (arguments.sensors) options.sensors = hurcules::realistic_sensors();
  options.record = !arguments.csv.empty();
  options.clock = now;
  if (arguments.mission.ends_with(kTableEnding)) return from_table(arguments, options);
  const std::vector<std::string> names = hurcules::mission_names();
  hurcules::require(std::find(names.begin(), names.end(), arguments.mission) != names.end(),
                    hurcules::unknown_name("mission", arguments.mission, names) +
                        ", and what hurcules mission NAME --out FILE.table writes");
  const hurcules::MissionSetup& setup = hurcules::mission_setup(arguments.mission);
  if (arguments.model.empty()) {
    return {hurcules::load_model(find_model(setup.scene)), arguments.mission, options};
  }
  const hurcules::ModelPtr model = hurcules::load_model(arguments.model);
  try {
    return {model, arguments.mission, options};
  } catch (const hurcules::Error& error) {
    throw hurcules::Error("model '" + arguments.model + "' does not fit '" + arguments.mission +
                          "': " + error.what());
  }
}

// in pieces, so that Ctrl-C is heard
void simulate(hurcules::Simulation& simulation, const Arguments& arguments) {
  constexpr std::int64_t kPiece = 20;  // ticks
  std::int64_t left = -1;
  if (arguments.seconds) left = std::llround(*arguments.seconds / simulation.dt());
  while (!simulation.finished() && left != 0 && !interrupted) {
    const std::int64_t piece = left < 0 ? kPiece : std::min(left, kPiece);
    simulation.step(static_cast<int>(piece));
    if (left > 0) left -= piece;
  }
}

std::string reason(const hurcules::Simulation& simulation) {
  if (simulation.finished()) return simulation.reason();
  char time[32];
  std::snprintf(time, sizeof time, "%.3f s", simulation.time());
  return interrupted ? std::string("interrupted at ") + time
                     : std::string("stopped at ") + time + ", as asked";
}

// true when the file has all that was written to it
bool close(std::ofstream& out, const std::string& file) {
  out.close();
  if (!out) std::cerr << "hurcules-sim: file '" << file << "' could not be written completely\n";
  return !out.fail();
}

bool save(const Run& run, std::ofstream& json, std::ofstream& csv) {
  bool saved = true;
  if (json.is_open()) {
    write_json(run, json);
    saved = close(json, run.arguments.json) && saved;
  }
  if (csv.is_open()) {
    write_csv(run.simulation, csv);
    saved = close(csv, run.arguments.csv) && saved;
  }
  if (interrupted) {
    std::string files = run.arguments.json;
    files += (files.empty() || run.arguments.csv.empty() ? "" : ", ") + run.arguments.csv;
    std::cout << "\ninterrupted; " << (files.empty() ? "no file was asked for" : "saved: " + files)
              << '\n';
  }
  return saved;
}

int run(const Arguments& arguments) {
  hurcules::MissionSimulation simulation = make_simulation(arguments);
  std::ofstream json = open(arguments.json), csv = open(arguments.csv);
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, [](int which) { interrupted = which; }) == SIG_IGN)
      std::signal(number, SIG_IGN);  // nohup
  const double started = now();
  simulate(simulation, arguments);
  const Run result{arguments, simulation, now() - started, reason(simulation)};
  print(result, std::cout);
  const bool saved = save(result, json, csv);
  if (!std::cout.flush())
    std::cerr << "hurcules-sim: the summary could not be written completely\n";
  if (!saved || !std::cout) return kFailed;
  if (interrupted) return kSignal + interrupted;
  return simulation.success() || !simulation.finished() ? kDone : kFailed;
}

}  // namespace

int main(int count, char** words) {
  try {
    const Arguments arguments = parse(count, words);
    if (arguments.version) {
      std::cout << "hurcules-sim " << HURCULES_VERSION << '\n';
      return kDone;
    }
    if (arguments.help) {
      std::cout << kHelp;
      return kDone;
    }
    return run(arguments);
  } catch (const hurcules::Error& error) {
    std::cerr << "hurcules-sim: " << error.what() << '\n';
    return kUsage;
  } catch (const std::exception& error) {
    std::cerr << "hurcules-sim: " << error.what() << '\n';
    return kFailed;
  }
}

// What the command line asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace hurcules_sim {

inline constexpr const char* kHelp =
    "usage: hurcules-sim MISSION|FILE.table [--seconds S] [--seed N] [--variation X] [--sensors]"
    " [--json FILE] [--csv FILE] [--model FILE] | --help | --version\n\n"
    "--variation: scale of what differs between seeds, 1 unless given. --sensors: with noise, bias,"
    " delay and resolution. --model: another scene for a MISSION.\n"
    "The missions lift, casualty, crossing and disposal are tables: hurcules mission NAME --out "
    "FILE.table\n";
inline constexpr const char* kTableEnding = ".table";

struct Arguments {
  std::string mission;            // by name, or the file of a table
  std::optional<double> seconds;  // [s] stop after this time
  std::uint64_t seed = 0;
  double variation = 1.0;  // scale of what differs between seeds
  bool sensors = false;    // with the noise of hurcules::realistic_sensors
  std::string json, csv;   // files to write, "" for none
  std::string model;       // scene, "" for the mission's own
  bool help = false, version = false;
};

// throws hurcules::Error with one line that says what was wanted and what came
[[nodiscard]] Arguments parse(int count, const char* const* words);

// path of a file under models/: beside this program, in ../share/hurcules, or where it was built;
// throws hurcules::Error with the places that were looked at
[[nodiscard]] std::string find_model(const std::string& file);

}  // namespace hurcules_sim

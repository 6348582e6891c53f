#include "arguments.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <system_error>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/mission/mission_simulation.hpp"

namespace hurcules_sim {

namespace {

using hurcules::Error;

Error not_wanted(const std::string& option, const std::string& word, const std::string& wanted) {
  return Error(option + ": wanted " + wanted + ", got '" + word + "'");
}

// a finite number from least to most
double number_in(const std::string& option, const std::string& word, const std::string& wanted,
                 double least, double most) {
  const std::optional<double> value = hurcules::number_of<double>(word);
  // the comparisons are false for nan
  if (value && std::isfinite(*value) && *value >= least && *value <= most) return *value;
  throw not_wanted(option, word, wanted);
}

std::uint64_t whole_number(const std::string& option, const std::string& word) {
  const std::optional<std::uint64_t> value = hurcules::number_of<std::uint64_t>(word);
  if (value) return *value;
  throw not_wanted(option, word, "a whole number of 0 or more");
}

void require_option(const std::string& option) {
  const std::vector<std::string> known = {"--seconds", "--seed", "--variation", "--sensors",
                                          "--json",    "--csv",  "--model"};
  if (std::find(known.begin(), known.end(), option) == known.end()) {
    throw Error(hurcules::unknown_name("option", option, known));
  }
}

void set(Arguments& arguments, const std::string& option, const std::string& word) {
  if (option == "--sensors") throw not_wanted(option, word, "no value");
  if (word.empty()) throw not_wanted(option, word, "a value");
  if (option == "--seconds") {
    arguments.seconds = number_in(option, word, "a time from 0.001 to 1e6 s", 1e-3, 1e6);
  } else if (option == "--seed") {
    arguments.seed = whole_number(option, word);
  } else if (option == "--variation") {
    arguments.variation = number_in(option, word, "a finite number of 0 or more", 0.0,
                                    std::numeric_limits<double>::infinity());
  } else if (option == "--json") {
    arguments.json = word;
  } else if (option == "--csv") {
    arguments.csv = word;
  } else if (option == "--model") {
    arguments.model = word;
  }
}

}  // namespace

Arguments parse(int count, const char* const* words) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--help" || word == "-h") {
      arguments.help = true;
    } else if (word == "--version") {
      arguments.version = true;
    } else if (word == "--sensors") {
      arguments.sensors = true;
    } else if (word.starts_with("-")) {
      const std::size_t sign = word.find('=');
      const std::string option = word.substr(0, sign);
      require_option(option);
      hurcules::require(sign != word.npos || i + 1 < count, option + ": wanted a value after it");
      set(arguments, option, sign != word.npos ? word.substr(sign + 1) : words[++i]);
    } else {
      hurcules::require(arguments.mission.empty(), "one mission is wanted, got '" +
                                                       arguments.mission + "' and '" + word + "'");
      arguments.mission = word;
    }
  }
  if (arguments.help || arguments.version) return arguments;
  hurcules::require(arguments.json.empty() || arguments.json != arguments.csv,
                    "--json and --csv name one file, '" + arguments.csv + "'");
  if (arguments.mission.empty()) {
    std::string names;
    for (const std::string& name : hurcules::mission_names()) {
      names += (names.empty() ? "" : ", ") + name;
    }
    throw Error("a mission is wanted: " + names +
                ", or the FILE.table of another (hurcules-sim --help says more)");
  }
  return arguments;
}

std::string find_model(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<fs::path> folders = {program / "models", program / "../share/hurcules/models"};
  const std::string built = HURCULES_MODELS;
  if (!built.empty()) folders.emplace_back(built);
  std::string looked;
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / file, error)) return (folder / file).lexically_normal().string();
    looked += (looked.empty() ? "" : ", ") + folder.lexically_normal().string();
  }
  throw Error("model '" + file + "' was not found in " + looked + "; name it with --model");
}

}  // namespace hurcules_sim

#include "arguments.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/mission_simulation.hpp"

namespace hurcules_sim {

namespace {

using hurcules::Error;

template <typename Number>
Number number(const std::string& option, const std::string& word, const std::string& wanted) {
  Number value{};
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || rest != end) {
    throw Error(option + ": wanted " + wanted + ", got '" + word + "'");
  }
  return value;
}

double seconds(const std::string& word) {
  const char* const wanted = "a time of 0.001 s or more";
  const auto value = number<double>("--seconds", word, wanted);
  // the comparison is false for nan
  if (std::isfinite(value) && value >= 1e-3 && value <= 1e6) return value;
  throw Error(std::string("--seconds: wanted ") + wanted + ", got '" + word + "'");
}

double variation(const std::string& word) {
  const char* const wanted = "a finite number of 0 or more";
  const auto value = number<double>("--variation", word, wanted);
  if (std::isfinite(value) && value >= 0.0) return value;
  throw Error(std::string("--variation: wanted ") + wanted + ", got '" + word + "'");
}

void set(Arguments& arguments, const std::string& option, const std::string& word) {
  if (option == "--seconds") {
    arguments.seconds = seconds(word);
  } else if (option == "--seed") {
    arguments.seed = number<std::uint64_t>(option, word, "a whole number of 0 or more");
  } else if (option == "--variation") {
    arguments.variation = variation(word);
  } else if (option == "--json") {
    arguments.json = word;
  } else if (option == "--csv") {
    arguments.csv = word;
  } else if (option == "--model") {
    arguments.model = word;
  } else {
    throw Error(hurcules::unknown_name(
        "option", option,
        {"--seconds", "--seed", "--variation", "--sensors", "--json", "--csv", "--model"}));
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
      if (i + 1 == count) set(arguments, word, "");  // an unknown option is told first
      hurcules::require(i + 1 < count, word + ": wanted a value after it");
      set(arguments, word, words[++i]);
    } else {
      hurcules::require(arguments.mission.empty(), "one mission is wanted, got '" +
                                                       arguments.mission + "' and '" + word + "'");
      arguments.mission = word;
    }
  }
  if (arguments.help || arguments.version) return arguments;
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

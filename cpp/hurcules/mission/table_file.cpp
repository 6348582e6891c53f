#include "hurcules/mission/table_file.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/row_lines.hpp"

namespace hurcules {

using namespace row_lines;

namespace {

constexpr const char* kFirstLine = "hurcules-table 1";
constexpr const char* kLastLine = "end";

Words<MissionSetup> setup_words() {
  return {one("mission", &MissionSetup::name),
          one("support", &MissionSetup::support),
          one("max_seconds", &MissionSetup::max_seconds),
          one("min_height", &MissionSetup::min_height),
          one("max_tilt", &MissionSetup::max_tilt),
          one("fall_frame", &MissionSetup::fall_frame),
          one("casualty", &MissionSetup::casualty),
          one("stand_off", &MissionSetup::stand_off),
          one("load", &MissionSetup::load),
          one("container", &MissionSetup::container),
          one("container_stand", &MissionSetup::container_stand)};
}

Words<Lead> lead_words() {
  return {one("rate", &Lead::rate),  one("way", &Lead::way),     one("by", &Lead::by),
          each("to", &Lead::to),     one("hold", &Lead::hold),   one("at", &Lead::at),
          one("span", &Lead::span),  one("value", &Lead::value), one("follow", &Lead::follow),
          one("brake", &Lead::brake)};
}

Words<Park> park_words() {
  return {one("body", &Park::body),   one("ahead", &Park::ahead),
          one("left", &Park::left),   one("heading", &Park::heading),
          one("speed", &Park::speed), one("yaw_rate", &Park::yaw_rate)};
}

Words<Phase> phase_words() {
  return {one("note", &Phase::note),
          one("stack", &Phase::stack),
          one("seconds", &Phase::seconds),
          one("support", &Phase::support),
          each("brake", &Phase::brakes),
          one("next", &Phase::next),
          one("last", &Phase::last),
          rows("lead", &Phase::leads, &Lead::channel, lead_words()),
          one("posture", &Phase::posture),
          rows("key", &Phase::keys, &PostureKey::share, {each("angle", &PostureKey::angles)}),
          maybe("park", &Phase::park, park_words()),
          each("done", &Phase::done),
          one("within", &Phase::within),
          each("late", &Phase::late),
          rows("trouble", &Phase::troubles, &Trouble::when, {each("do", &Trouble::reactions)})};
}

Words<Measure> figure_words() {
  return {one("quantity", &Measure::quantity), one("take", &Measure::take),
          each("phase", &Measure::phases), one("least", &Measure::least),
          one("most", &Measure::most)};
}

Words<TableFile> file_words() {
  Words<TableFile> words;
  add_part(words, &TableFile::setup, setup_words());
  words.push_back(one("controller", &TableFile::controller));
  words.push_back(one("model", &TableFile::model));
  words.push_back(one("checksum", &TableFile::checksum));
  words.push_back(one("mujoco", &TableFile::mujoco));
  add_part(words, &TableFile::table,
           {one("safety", &MissionTable::safety),
            rows("phase", &MissionTable::phases, &Phase::name, phase_words()),
            rows("figure", &MissionTable::measures, &Measure::name, figure_words())});
  return words;
}

std::string checksum_of(std::string_view bytes) {
  char text[17];  // no stream: beside a Python package with a libstdc++ of its own one crashed
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_of(bytes)));
  return text;
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("file '" + path + "' cannot be read");
  if (std::filesystem::is_directory(path)) {  // which opens
    throw Error("file '" + path + "' cannot be read: it is a folder");
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string table_lines(TableFile file, std::string_view model_bytes) {
  file.checksum = checksum_of(model_bytes);
  file.mujoco = mujoco_version();
  Writer writer;
  writer.add(0, kFirstLine);
  write_row(file, file_words(), 0, writer);
  writer.add(0, kLastLine);
  return writer.text();
}

TableFile parse_table(const std::string& text, const std::string& path) {
  Reader reader(text, path, kFirstLine, kLastLine);
  TableFile file;
  read_row(file, file_words(), 0, reader);
  const std::pair<const char*, const std::string&> wanted[] = {{"mission", file.setup.name},
                                                               {"controller", file.controller},
                                                               {"model", file.model},
                                                               {"checksum", file.checksum},
                                                               {"mujoco", file.mujoco}};
  for (const auto& [word, value] : wanted) {
    require(!value.empty(), path + " wants a line '" + word + "' with a value");
  }
  return file;
}

TableFile read_table(const std::string& path) {
  return parse_table(contents(path), path);
}

ModelPtr load_model_of(const TableFile& file, const std::string& path) {
  const std::string model = (std::filesystem::path(path).parent_path() / file.model).string();
  const std::string remedy = ": write both anew (hurcules mission " + file.setup.name + " --out)";
  require(std::filesystem::exists(model),
          "model '" + model + "' of '" + path + "' does not exist" + remedy);
  require(file.mujoco == mujoco_version(), "model '" + model + "' was written by MuJoCo " +
                                               file.mujoco + ", this is " + mujoco_version() +
                                               remedy);
  require(checksum_of(contents(model)) == file.checksum,
          "model '" + model + "' is not the one that was written with '" + path +
              "', or it is cut off" + remedy);
  return load_model(model);
}

}  // namespace hurcules

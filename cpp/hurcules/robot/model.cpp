// Models out of files, text and other hands; MuJoCo's complaints become our Error.
#include <mujoco/mujoco.h>

#include <array>
#include <filesystem>
#include <mutex>
#include <sstream>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {
namespace {

// MuJoCo writes warnings to a file in the working folder unless somebody listens. The listener is
// one for the process, so models are read one after the other.
class WarningListener {
 public:
  WarningListener() : turn_(mutex()), previous_(mju_user_warning) {
    text().clear();
    mju_user_warning = [](const char* message) { text() += message; };
  }
  ~WarningListener() { mju_user_warning = previous_; }
  WarningListener(const WarningListener&) = delete;
  WarningListener& operator=(const WarningListener&) = delete;

  static std::string& text() {
    thread_local std::string heard;
    return heard;
  }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }

  std::lock_guard<std::mutex> turn_;
  void (*previous_)(const char*);
};

class VirtualFiles {
 public:
  VirtualFiles() { mj_defaultVFS(&files_); }
  ~VirtualFiles() { mj_deleteVFS(&files_); }
  VirtualFiles(const VirtualFiles&) = delete;
  VirtualFiles& operator=(const VirtualFiles&) = delete;
  mjVFS* get() { return &files_; }

 private:
  mjVFS files_;
};

using ErrorText = std::array<char, 2000>;

// MuJoCo writes its complaints over several lines
std::string in_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line, word;
  while (words >> word) line += (line.empty() ? "" : " ") + word;
  return line;
}

ModelPtr owned(mjModel* model, const std::string& what, const std::string& complaint) {
  if (!model) throw Error(what + " cannot be loaded: " + in_one_line(complaint));
  return {model, [](const mjModel* m) { mj_deleteModel(const_cast<mjModel*>(m)); }};
}

}  // namespace

ModelPtr load_model(const std::string& path) {
  check_mujoco_version();
  require(
      !path.starts_with('<'),
      "a model's path is wanted, a text of XML came; of MJCF it is for load_model_text (C++) or "
      "mujoco.MjModel.from_xml_string (Python)");
  if (!std::filesystem::exists(path)) throw Error("model '" + path + "' does not exist");
  if (std::filesystem::is_directory(path)) {
    throw Error("model '" + path + "': wanted a file, it is a folder");
  }
  const WarningListener listener;
  const std::filesystem::path suffix = std::filesystem::path(path).extension();
  if (suffix == ".mjb")
    return owned(mj_loadModel(path.c_str(), nullptr), "model '" + path + "'", listener.text());
  if (suffix == ".urdf") {
    // MuJoCo's own reading drops limits of speed and effort, motors and fixed links
    throw Error("model '" + path + "' is a URDF: convert it once, in Python: " +
                "mujoco.mj_saveModel(hurcules.load_urdf('" + path + "'), 'robot.mjb')");
  }
  ErrorText error{};
  mjModel* model = mj_loadXML(path.c_str(), nullptr, error.data(), error.size());
  return owned(model, "model '" + path + "'", error.data());
}

namespace {

// of the first element of a text of XML, "" where there is none
std::string root_of(const std::string& xml) {
  std::size_t at = xml.find('<');
  while (at != std::string::npos && at + 1 < xml.size()) {
    const bool comment = xml.compare(at, 4, "<!--") == 0;
    if (!comment && xml[at + 1] != '?' && xml[at + 1] != '!') {
      const std::size_t end = xml.find_first_of(" \t\r\n/>", at);
      return xml.substr(at + 1, end - at - 1);
    }
    at = xml.find('<', comment ? xml.find("-->", at) : at + 1);
  }
  return "";
}

}  // namespace

ModelPtr load_model_text(const std::string& mjcf, const std::string& folder) {
  check_mujoco_version();
  require(root_of(mjcf) != "robot",
          "the text is a URDF: in Python hurcules.load_urdf reads it, with its limits and motors");
  const WarningListener listener;
  // a file that stands only in memory, so that what it includes is looked for beside it
  const std::string path = (std::filesystem::path(folder) / "model_text.xml").string();
  VirtualFiles files;
  const int length = static_cast<int>(mjcf.size());
  if (mj_addBufferVFS(files.get(), path.c_str(), mjcf.data(), length) != 0)
    throw Error("model text of " + std::to_string(length) + " bytes cannot be read");
  ErrorText error{};
  mjModel* model = mj_loadXML(path.c_str(), files.get(), error.data(), error.size());
  return owned(model, "model text", error.data());
}

ModelPtr borrow_model(const mjModel* model) {
  require(model != nullptr, "a model is wanted, a null pointer came");
  check_mujoco_version();
  return {model, [](const mjModel*) {}};
}

void check_mujoco_version() {
  if (mj_version() == mjVERSION_HEADER) return;
  throw Error("MuJoCo " + std::to_string(mjVERSION_HEADER) + " is wanted (built with it), " +
              std::to_string(mj_version()) + " is loaded");
}

std::string mujoco_version() {
  return mj_versionString();
}

}  // namespace hurcules

// A table of phases in a file that needs no library to be read, beside the compiled model of its
// scene: all that hurcules-sim runs it from.
//
//   hurcules-table 1
//   mission lift
//   controller lift              of table_controllers.hpp
//   model lift.mjb               in the same folder
//   phase press
//     stack press
//     lead L_press
//       rate -0.025
//     done mission/force/L_press <= -4 for 0.3 s
//     late back to settle
//     late abort
//   end
//
// A line is a word and its value. What belongs to a row stands below it, two spaces further in;
// what may be several stands on a line each; what is left out keeps its default. Empty lines and
// those that begin with # say nothing. Numbers keep all their bits.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hurcules/mission/mission_setup.hpp"
#include "hurcules/mission/table.hpp"

namespace hurcules {

struct TableFile {
  MissionSetup setup;           // without scene and keyframe: the model's
  std::string controller = "";  // by name
  std::string model = "";       // file name, MJB
  std::string checksum = "";    // of that file's bytes
  std::string mujoco = "";      // version that wrote it
  MissionTable table;
};

// the text of such a file for a model with these bytes (mj_saveModel). Throws Error for a name or a
// note of more than one line.
[[nodiscard]] std::string table_lines(TableFile file, std::string_view model_bytes);
// the contents of a file. Throws Error with file, line, what was wanted and what exists.
[[nodiscard]] TableFile read_table(const std::string& path);
// the same from text; `path` for the errors
[[nodiscard]] TableFile parse_table(const std::string& text, const std::string& path);
// the model beside a file that was read from this path. Throws Error where it is missing, is not the
// one that the file was written with, or was written by another MuJoCo.
[[nodiscard]] ModelPtr load_model_of(const TableFile& file, const std::string& path);

}  // namespace hurcules

// A mission as data: its phases in their order, the way to safety, and what a run is measured by.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hurcules/control/whole_body_controller.hpp"
#include "hurcules/mission/phase.hpp"

namespace hurcules {

// A figure of a run: a quantity over some phases, and between what it must lie in the end.
struct Measure {
  enum class Take { Largest, Smallest, Span, Last };  // Span: largest - smallest
  std::string name;                                   // with its unit
  std::string quantity;                               // a column of the log
  Take take = Take::Last;
  std::vector<std::string> phases = {};  // none: all
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

// of a phase in which no stack rules
inline constexpr const char* kJoints = "joints";

struct MissionTable {
  std::vector<Phase> phases;
  std::string safety = "";  // the phase that Lower goes to, "" for none
  std::vector<Measure> measures = {};
};

[[nodiscard]] std::string to_string(ReactionKind kind);
[[nodiscard]] std::string to_text(double number);  // "0.3"
[[nodiscard]] std::string to_string(const Condition& condition,
                                    std::string (*number)(double) = to_text);

// What can be told without a controller. Throws Error, naming the row: an unknown phase with those
// that exist; two of a name; two leads of a channel, one without a way or a rate or one that never
// ends while nothing else ends the phase; a time-out that is not above 0, shorter than the phase or
// without a reaction, reactions without a time-out; parking without a time-out; reactions that do not
// end in safety (Lower or Abort); a jump without a count, or rows that go on to each other for ever;
// a row that goes on, but is the last; shares of a posture that do not rise to 1.
void check_rows(const MissionTable& table);
// All of it, and what depends on the controller: an unknown stack, channel, coordinate or support
// with those that exist; a lead of the wrong size, of a task where no stack rules, or by a way that
// its channel's scale does not reach in time; a posture beyond the range of a coordinate or joint;
// parking without tracks, or beside a lead of them. Quantities are checked when a simulation brings
// its log.
void check_table(const MissionTable& table, const WholeBodyController& controller);

// as text: a line a phase, its note, conditions and reactions below
[[nodiscard]] std::string table_text(const MissionTable& table);

// throws Error unless it is "" or a body of the robot; `where` for the text
void check_support(const std::string& support, const Robot& plan, const std::string& where);

// place of a phase; throws Error with the names that exist; `where` for the text
[[nodiscard]] std::size_t find_phase(const std::vector<Phase>& phases, const std::string& name,
                                     const std::string& where);
// place of the phase that one goes on to where it is done, none: the run is over
[[nodiscard]] std::optional<std::size_t> phase_after(const std::vector<Phase>& phases,
                                                     std::size_t phase);
// what the robot stands on in each phase: its own, else that of the row above; `first` before them
[[nodiscard]] std::vector<std::string> supports_of(const std::vector<Phase>& phases,
                                                   std::string first);
// first command and channel of this name; throws Error with the names that exist
struct ChannelPlace {
  const Channel* channel = nullptr;
  Index row = 0;
};
[[nodiscard]] ChannelPlace find_channel(const WholeBodyController& controller,
                                        const std::string& name, const std::string& where);
// first command of the channel that drives the tracks; throws Error where there is none
[[nodiscard]] Index find_tracks(const WholeBodyController& controller, const std::string& where);

}  // namespace hurcules

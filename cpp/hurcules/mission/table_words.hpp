// Conditions and reactions in words, as tables are written in TOML and in table files; numbers with
// all their bits.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hurcules/mission/table.hpp"

namespace hurcules {

// the shortest text that reads back as the same number: "0.3", "1e-05", "inf"
[[nodiscard]] std::string exact_text(double number);

// "QUANTITY >= 0.3 for 2 s"
[[nodiscard]] std::string exact_text(const Condition& condition);
// "back to PHASE", "hold 2 s", "ask 30 s", "lower" or "abort", maybe with ", 3 times"
[[nodiscard]] std::string exact_text(const Reaction& reaction);
// of such texts; throw Error with what was wanted
[[nodiscard]] Condition read_condition(const std::string& text);
[[nodiscard]] Reaction read_reaction(const std::string& text);

// what a figure takes of its quantity, by its words
[[nodiscard]] const std::vector<std::pair<std::string, Measure::Take>>& take_words();

}  // namespace hurcules

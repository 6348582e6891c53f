#include "hurcules/mission/table_words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <sstream>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"

namespace hurcules {

namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, end + 1 - begin);
}

// the number [s] of "2 s" or "2s"
std::optional<double> seconds_of(const std::string& given) {
  std::string text = trimmed(given);
  if (!text.ends_with('s')) return std::nullopt;
  text.pop_back();
  const std::vector<std::string> words = words_of(text);
  return words.size() == 1 ? number_of<double>(words[0]) : std::nullopt;
}

// "VALUE" or "VALUE for 2 s"
bool read_value(const std::string& text, Condition& condition) {
  const std::string value = text.substr(0, text.find(" for "));
  const std::vector<std::string> words = words_of(value);
  const std::optional<double> number =
      words.size() == 1 ? number_of<double>(words[0]) : std::nullopt;
  if (number) condition.value = *number;
  if (value.size() == text.size()) return number.has_value();
  const std::optional<double> seconds = seconds_of(text.substr(value.size() + 5));
  if (seconds) condition.seconds = *seconds;
  return number && seconds;
}

// takes ", 3 times" off the text; false: it says something else
bool take_times(std::string& text, int& times) {
  const std::size_t comma = text.find(", ");
  if (comma == std::string::npos) return true;
  const std::vector<std::string> words = words_of(text.substr(comma + 2));
  text.erase(comma);
  if (words.size() != 2 || (words[1] != "times" && words[1] != "time")) return false;
  const std::optional<int> count = number_of<int>(words[0]);
  if (count) times = *count;
  return count.has_value();
}

bool read_kind(const std::string& text, Reaction& reaction) {
  for (const ReactionKind kind : {ReactionKind::Lower, ReactionKind::Abort}) {
    reaction.kind = kind;
    if (text == to_string(kind)) return true;
  }
  for (const ReactionKind kind : {ReactionKind::Hold, ReactionKind::Ask}) {
    const std::string word = to_string(kind) + " ";
    if (!text.starts_with(word)) continue;
    reaction.kind = kind;
    const std::optional<double> seconds = seconds_of(text.substr(word.size()));
    if (seconds) reaction.seconds = *seconds;
    return seconds.has_value();
  }
  const std::string back = "back to ";
  reaction.kind = ReactionKind::Back;
  if (text.starts_with(back)) reaction.phase = text.substr(back.size());
  return !reaction.phase.empty();
}

}  // namespace

std::string exact_text(double number) {
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), end};
}

std::string exact_text(const Condition& condition) {
  return to_string(condition, exact_text);
}

std::string exact_text(const Reaction& reaction) {
  std::string text = to_string(reaction.kind);
  if (reaction.kind == ReactionKind::Back) text.append(" to ").append(reaction.phase);
  if (reaction.kind == ReactionKind::Hold || reaction.kind == ReactionKind::Ask) {
    text.append(" ").append(exact_text(reaction.seconds)).append(" s");
  }
  if (reaction.times > 1) text.append(", ").append(std::to_string(reaction.times)).append(" times");
  return text;
}

Condition read_condition(const std::string& text) {
  Condition condition;
  const std::size_t sign = std::min(text.find(">="), text.find("<="));
  if (sign != std::string::npos) {
    const std::vector<std::string> names = words_of(text.substr(0, sign));
    condition.above = text[sign] == '>';
    if (names.size() == 1 && read_value(text.substr(sign + 2), condition)) {
      condition.quantity = names[0];
      return condition;
    }
  }
  throw Error("condition '" + text + "': wanted 'QUANTITY >= NUMBER' or <=, maybe 'for NUMBER s'");
}

Reaction read_reaction(const std::string& text) {
  Reaction reaction;
  std::string rest = trimmed(text);
  if (take_times(rest, reaction.times) && read_kind(rest, reaction)) return reaction;
  throw Error("reaction '" + text +
              "': wanted 'back to PHASE', 'hold 2 s', 'ask 30 s', 'lower' or 'abort', maybe ', 3 "
              "times'");
}

const std::vector<std::pair<std::string, Measure::Take>>& take_words() {
  static const std::vector<std::pair<std::string, Measure::Take>> all = {
      {"largest", Measure::Take::Largest},
      {"smallest", Measure::Take::Smallest},
      {"span", Measure::Take::Span},
      {"last", Measure::Take::Last},
  };
  return all;
}

}  // namespace hurcules

#include "hurcules/mission/row_lines.hpp"

#include <sstream>

#include "hurcules/base/number_text.hpp"
#include "hurcules/mission/table_words.hpp"

namespace hurcules::row_lines {

namespace {

double number_in(const std::string& text) {
  const std::optional<double> number = number_of<double>(text);
  if (!number) throw Error("wanted a number, '" + text + "' came");
  return *number;
}

}  // namespace

Reader::Reader(const std::string& text, std::string path, const std::string& first,
               const std::string& last)
    : path_(std::move(path)) {
  std::istringstream stream(text);
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    const std::size_t spaces = line.find_first_not_of(' ');
    if (spaces == std::string::npos || line[spaces] == '#') continue;
    const std::size_t end = std::min(line.find(' ', spaces), line.size());
    lines_.push_back({number, spaces, line.substr(spaces, end - spaces),
                      line.substr(std::min(end + 1, line.size()))});
  }
  const std::string head = lines_.empty() ? "" : lines_[0].word + " " + lines_[0].value;
  require(head == first, path_ + " is no table of a mission: its first line wants to be '" + first +
                             "', it is '" + head + "'");
  const Line& tail = lines_.back();
  require(tail.word == last && tail.depth == 0, path_ + " is cut off: its last line wants to be '" +
                                                    last + "', it is '" + tail.word + " " +
                                                    tail.value + "'");
  lines_.pop_back();
  next_ = 1;
}

const Line* Reader::next(std::size_t depth) {
  if (next_ == lines_.size() || lines_[next_].depth < depth) return nullptr;
  const Line& line = lines_[next_++];
  if (line.depth != depth) {
    fail(line, "'" + line.word + "' wants " + std::to_string(depth) + " spaces before it, or " +
                   "fewer, " + std::to_string(line.depth) + " came");
  }
  return &line;
}

void Reader::fail(const Line& line, const std::string& what) const {
  throw Error(path_ + ", line " + std::to_string(line.number) + ": " + what);
}

void Writer::add(std::size_t depth, const std::string& word, const std::string& value) {
  require(value.find_first_of("\r\n") == std::string::npos,
          "a table file wants one line for " + word + ", '" + value + "' came");
  text_.append(depth, ' ').append(word);
  if (!value.empty()) text_.append(" ").append(value);
  text_ += '\n';
}

std::string text_of(const std::string& text) {
  return text;
}
std::string text_of(double number) {
  return exact_text(number);
}
std::string text_of(bool /*flag*/) {
  return "";
}
std::string text_of(const Vector& numbers) {
  std::string text;
  for (const double number : numbers) text.append(text.empty() ? "" : " ") += exact_text(number);
  return text;
}
std::string text_of(const std::pair<std::string, double>& angle) {
  return angle.first + " " + exact_text(angle.second);
}
std::string text_of(const Condition& condition) {
  return exact_text(condition);
}
std::string text_of(const Reaction& reaction) {
  return exact_text(reaction);
}
std::string text_of(Measure::Take take) {
  for (const auto& [word, value] : take_words()) {
    if (value == take) return word;
  }
  return "";
}

void read(const std::string& text, std::string& value) {
  value = text;
}
void read(const std::string& text, double& value) {
  value = number_in(text);
}
void read(const std::string& text, bool& value) {
  require(text.empty(), "wanted nothing after it, '" + text + "' came");
  value = true;
}
void read(const std::string& text, Vector& value) {
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (std::string word; stream >> word;) numbers.push_back(number_in(word));
  value = Eigen::Map<const Vector>(numbers.data(), static_cast<Index>(numbers.size()));
}
void read(const std::string& text, std::pair<std::string, double>& value) {
  const std::size_t space = text.rfind(' ');
  require(space != std::string::npos, "wanted a name and a number, '" + text + "' came");
  value = {text.substr(0, space), number_in(text.substr(space + 1))};
}
void read(const std::string& text, Condition& value) {
  value = read_condition(text);
}
void read(const std::string& text, Reaction& value) {
  value = read_reaction(text);
}
void read(const std::string& text, Measure::Take& value) {
  std::vector<std::string> known;
  for (const auto& [word, take] : take_words()) {
    known.push_back(word);
    value = take;
    if (word == text) return;
  }
  throw Error(unknown_name("take", text, known));
}

}  // namespace hurcules::row_lines

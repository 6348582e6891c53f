#include "hurcules/mission/table_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/table_words.hpp"

namespace hurcules {

namespace {

constexpr const char* kFirstLine = "hurcules-table 1";
constexpr const char* kLastLine = "end";
constexpr std::size_t kIndent = 2;  // [spaces] of a row below its line

struct Line {
  std::size_t number = 0, depth = 0;
  std::string word, value;
};

// The lines of a file, one after the other. Throws Errors that name file and line.
class Reader {
 public:
  Reader(const std::string& text, std::string path) : path_(std::move(path)) {
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
    const std::string first = lines_.empty() ? "" : lines_[0].word + " " + lines_[0].value;
    require(first == kFirstLine, path_ + " is no table of a mission: its first line wants to be '" +
                                     kFirstLine + "', it is '" + first + "'");
    const Line& last = lines_.back();
    require(last.word == kLastLine && last.depth == 0,
            path_ + " is cut off: its last line wants to be '" + kLastLine + "', it is '" +
                last.word + " " + last.value + "'");
    lines_.pop_back();
    next_ = 1;
  }

  // the next line, null where it belongs to a row further out
  [[nodiscard]] const Line* next(std::size_t depth) {
    if (next_ == lines_.size() || lines_[next_].depth < depth) return nullptr;
    const Line& line = lines_[next_++];
    if (line.depth != depth) {
      fail(line, "'" + line.word + "' wants " + std::to_string(depth) + " spaces before it, or " +
                     "fewer, " + std::to_string(line.depth) + " came");
    }
    return &line;
  }

  [[noreturn]] void fail(const Line& line, const std::string& what) const {
    throw Error(path_ + ", line " + std::to_string(line.number) + ": " + what);
  }

 private:
  std::string path_;
  std::vector<Line> lines_;
  std::size_t next_ = 0;
};

class Writer {
 public:
  void add(std::size_t depth, const std::string& word, const std::string& value = "") {
    require(value.find_first_of("\r\n") == std::string::npos,
            "a table file wants one line for " + word + ", '" + value + "' came");
    text_.append(depth, ' ').append(word);
    if (!value.empty()) text_.append(" ").append(value);
    text_ += '\n';
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string text_of(const std::string& text) {
  return text;
}
std::string text_of(double number) {
  return exact_text(number);
}
std::string text_of(bool /*true*/) {
  return "";  // its word says it
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

double number_in(const std::string& text) {
  const std::optional<double> number = number_of(text);
  if (!number) throw Error("wanted a number, '" + text + "' came");
  return *number;
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

// the value of a line, told with its place where it cannot be read
template <class Value>
void read(const Line& line, Reader& reader, Value& value) {
  try {
    read(line.value, value);
  } catch (const Error& error) {
    reader.fail(line, line.word + ": " + error.what());
  }
}

// One word of the lines below a row: how its values are written and read.
template <class Row>
struct Word {
  std::string word;
  std::function<void(const Row&, std::size_t depth, Writer&)> write;
  std::function<void(Row&, const Line&, Reader&)> read;
  bool several = false;  // lines of it below one row
};
template <class Row>
using Words = std::vector<Word<Row>>;

template <class Row>
void write_row(const Row& row, const Words<Row>& words, std::size_t depth, Writer& writer) {
  for (const Word<Row>& one : words) one.write(row, depth, writer);
}

template <class Row>
void read_row(Row& row, const Words<Row>& words, std::size_t depth, Reader& reader) {
  std::set<std::string> seen;
  while (const Line* const line = reader.next(depth)) {
    const auto found = std::find_if(words.begin(), words.end(),
                                    [&](const Word<Row>& one) { return one.word == line->word; });
    if (found == words.end()) {
      std::vector<std::string> known;
      for (const Word<Row>& one : words) known.push_back(one.word);
      reader.fail(*line, unknown_name("word", line->word, known));
    }
    if (!seen.insert(line->word).second && !found->several) {
      reader.fail(*line, "'" + line->word + "' stands twice below one row");
    }
    found->read(row, *line, reader);
  }
}

template <class Value>
bool equal(const Value& one, const Value& other) {
  if constexpr (std::is_same_v<Value, Vector>) {
    return one.size() == other.size() && one == other;
  } else {
    return one == other;
  }
}

// a value, left out where it is the default
template <class Row, class Value>
Word<Row> one(const std::string& word, Value Row::* member) {
  return {word,
          [=](const Row& row, std::size_t depth, Writer& writer) {
            if (!equal(row.*member, Row{}.*member)) writer.add(depth, word, text_of(row.*member));
          },
          [=](Row& row, const Line& line, Reader& reader) { read(line, reader, row.*member); }};
}

// values, a line each
template <class Row, class Value>
Word<Row> each(const std::string& word, std::vector<Value> Row::* member) {
  return {word,
          [=](const Row& row, std::size_t depth, Writer& writer) {
            for (const Value& value : row.*member) writer.add(depth, word, text_of(value));
          },
          [=](Row& row, const Line& line, Reader& reader) {
            read(line, reader, (row.*member).emplace_back());
          },
          true};
}

// rows, each below a line that tells its head
template <class Row, class Child, class Head>
Word<Row> rows(const std::string& word, std::vector<Child> Row::* member, Head Child::* head,
               const Words<Child>& words) {
  return {word,
          [=](const Row& row, std::size_t depth, Writer& writer) {
            for (const Child& child : row.*member) {
              writer.add(depth, word, text_of(child.*head));
              write_row(child, words, depth + kIndent, writer);
            }
          },
          [=](Row& row, const Line& line, Reader& reader) {
            Child& child = (row.*member).emplace_back();
            read(line, reader, child.*head);
            read_row(child, words, line.depth + kIndent, reader);
          },
          true};
}

// a row that there may be, below its word alone
template <class Row, class Child>
Word<Row> maybe(const std::string& word, std::optional<Child> Row::* member,
                const Words<Child>& words) {
  return {word,
          [=](const Row& row, std::size_t depth, Writer& writer) {
            if (!(row.*member)) return;
            writer.add(depth, word);
            write_row(*(row.*member), words, depth + kIndent, writer);
          },
          [=](Row& row, const Line& line, Reader& reader) {
            bool there = false;
            read(line, reader, there);
            read_row((row.*member).emplace(), words, line.depth + kIndent, reader);
          }};
}

// the words of a part stand among those of the whole
template <class Row, class Part>
void add_part(Words<Row>& all, Part Row::* part, const Words<Part>& words) {
  for (const Word<Part>& one : words) {
    all.push_back(
        {one.word,
         [=](const Row& row, std::size_t depth, Writer& writer) {
           one.write(row.*part, depth, writer);
         },
         [=](Row& row, const Line& line, Reader& reader) { one.read(row.*part, line, reader); },
         one.several});
  }
}

Words<MissionSetup> setup_words() {
  return {one("mission", &MissionSetup::name),
          one("support", &MissionSetup::support),
          one("max_seconds", &MissionSetup::max_seconds),
          one("min_height", &MissionSetup::min_height),
          one("max_tilt", &MissionSetup::max_tilt),
          one("casualty", &MissionSetup::casualty),
          one("stand_off", &MissionSetup::stand_off),
          one("load", &MissionSetup::load),
          one("container", &MissionSetup::container),
          one("container_stand", &MissionSetup::container_stand)};
}

Words<Lead> lead_words() {
  return {one("rate", &Lead::rate), one("way", &Lead::way),   one("by", &Lead::by),
          each("to", &Lead::to),    one("hold", &Lead::hold), one("at", &Lead::at),
          one("span", &Lead::span)};
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

// FNV-1a
std::string checksum_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << hash;
  return text.str();
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("file '" + path + "' cannot be read");
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
  Reader reader(text, path);
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
  require(file.mujoco == mujoco_version(), "model '" + model + "' was written by MuJoCo " +
                                               file.mujoco + ", this is " + mujoco_version() +
                                               remedy);
  require(checksum_of(contents(model)) == file.checksum,
          "model '" + model + "' is not the one that was written with '" + path +
              "', or it is cut off" + remedy);
  return load_model(model);
}

}  // namespace hurcules

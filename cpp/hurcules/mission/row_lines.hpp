// Rows as lines of text and back: how a table file (table_file.hpp) writes and reads its structs.
//
// A struct is a list of words, each for one of its members:
//
//   Words<Lead> words = {one("rate", &Lead::rate), each("to", &Lead::to)};
//   write_row(lead, words, 4, writer);    //     rate 0.1 0
//                                         //     to load/ahead_m
// What belongs to a row stands kIndent further in than its own line. Defaults are left out.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/table.hpp"

namespace hurcules::row_lines {

inline constexpr std::size_t kIndent = 2;  // [spaces]

struct Line {
  std::size_t number = 0, depth = 0;  // depth [spaces]
  std::string word, value;
};

// The lines of a file between its first and its last one, one after the other; empty ones and
// comments (#) are left out.
class Reader {
 public:
  // `path` for the errors. Throws Error for another first or last line.
  Reader(const std::string& text, std::string path, const std::string& first,
         const std::string& last);
  // the next line, null where it belongs to a row further out; throws Error where it stands too far
  // in
  [[nodiscard]] const Line* next(std::size_t depth);
  // throws Error with file and line
  [[noreturn]] void fail(const Line& line, const std::string& what) const;

 private:
  std::string path_;
  std::vector<Line> lines_;
  std::size_t next_ = 0;
};

class Writer {
 public:
  // throws Error for a value of more than one line
  void add(std::size_t depth, const std::string& word, const std::string& value = "");
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// values in words
[[nodiscard]] std::string text_of(const std::string& text);
[[nodiscard]] std::string text_of(double number);
[[nodiscard]] std::string text_of(bool flag);  // "": its word says that it is true
[[nodiscard]] std::string text_of(const Vector& numbers);
[[nodiscard]] std::string text_of(const std::pair<std::string, double>& angle);
[[nodiscard]] std::string text_of(const Condition& condition);
[[nodiscard]] std::string text_of(const Reaction& reaction);
[[nodiscard]] std::string text_of(Measure::Take take);
// and out of them; throw Error with what was wanted
void read(const std::string& text, std::string& value);
void read(const std::string& text, double& value);
void read(const std::string& text, bool& value);
void read(const std::string& text, Vector& value);
void read(const std::string& text, std::pair<std::string, double>& value);
void read(const std::string& text, Condition& value);
void read(const std::string& text, Reaction& value);
void read(const std::string& text, Measure::Take& value);

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

}  // namespace hurcules::row_lines

// All rows of a hierarchy in one list, so that a row has one number whatever level it stands in.
#pragma once

#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules {

struct Row {
  int level = 0;
  int row = 0;            // its place in the level
  bool equality = false;  // lower == upper
  double lower = 0.0;     // -inf when absent
  double upper = 0.0;     // +inf when absent
  double norm = 0.0;      // |a|
  const double* a =
      nullptr;  // n entries, or null for a simple bound: a is the unit vector of `row`
};

class RowTable {
 public:
  // memory for `rows` rows in `levels` levels
  void reserve(Index rows, Index levels);
  // a table by hand: clear, then add the rows of a level and end it
  void clear();
  void add(const Row& row) { rows_.push_back(row); }
  void end_level() { begin_.push_back(size()); }
  // reads the rows; false when a number is NaN, a shape is off, or lower > upper
  [[nodiscard]] bool read(HierarchyView hierarchy, Index unknowns);

  [[nodiscard]] int size() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] const Row& operator[](int i) const { return rows_[i]; }
  // rows of level k are begin(k) .. begin(k + 1) - 1
  [[nodiscard]] int begin(int level) const { return begin_[level]; }
  [[nodiscard]] int levels() const { return static_cast<int>(begin_.size()) - 1; }
  // true when levels, row kinds and bounds stand as in the table read before
  [[nodiscard]] bool same_pattern() const { return same_pattern_; }

  [[nodiscard]] double dot(int i, const Vector& x) const;  // a_i . x
  void add_to(int i, double scale, Vector& y) const;       // y += scale a_i
  // the pattern, so that a restored solver knows whether its working sets still fit
  void save_pattern(StateWriter& writer) const;
  void restore_pattern(StateReader& reader);
  // signed distance of a_i . x to [lower, upper]
  [[nodiscard]] double violation(int i, double value) const;

 private:
  [[nodiscard]] bool read_row(const LevelView& level, int k, int i, Index unknowns);

  std::vector<Row> rows_;
  std::vector<int> begin_{0};
  std::vector<char> pattern_, old_pattern_;
  bool same_pattern_ = false;
};

}  // namespace hurcules

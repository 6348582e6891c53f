#include "hurcules/solver/row_table.hpp"

#include <cmath>
#include <limits>

#include "hurcules/solver/kernels.hpp"

namespace hurcules {

namespace {

constexpr Index kMostRows = 1'000'000;  // in a snapshot
constexpr double kAbsent = std::numeric_limits<double>::infinity();

enum Pattern : char { kEquality, kInequality, kBoundEquality, kBoundInequality, kEndOfLevel };

}  // namespace

void RowTable::reserve(Index rows, Index levels) {
  rows_.reserve(rows);
  begin_.reserve(levels + 1);
  pattern_.reserve(rows + levels);
  old_pattern_.reserve(rows + levels);
}

void RowTable::clear() {
  rows_.clear();
  begin_.assign(1, 0);
}

bool RowTable::read(HierarchyView hierarchy, Index unknowns) {
  std::swap(pattern_, old_pattern_);
  pattern_.clear();
  clear();
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    const LevelView& level = hierarchy[k];
    const bool fits = level.bounds ? level.rows() == unknowns
                                   : level.A.rows() == level.rows() &&
                                         (level.rows() == 0 || level.A.cols() == unknowns);
    if (!fits || level.upper.size() != level.rows() || !(level.rho >= 0.0)) return false;
    for (int i = 0; i < level.rows(); ++i) {
      if (!read_row(level, static_cast<int>(k), i, unknowns)) return false;
    }
    end_level();
    pattern_.push_back(kEndOfLevel);
  }
  same_pattern_ = pattern_ == old_pattern_;
  return true;
}

bool RowTable::read_row(const LevelView& level, int k, int i, Index unknowns) {
  Row row;
  row.level = k;
  row.row = i;
  row.lower = level.lower[i] <= -kInfinity ? -kAbsent : level.lower[i];
  row.upper = level.upper[i] >= kInfinity ? kAbsent : level.upper[i];
  row.equality = row.lower == row.upper;
  row.a = level.bounds ? nullptr : level.A.data() + i * unknowns;
  row.norm = level.bounds ? 1.0 : std::sqrt(kernels::dot(unknowns, row.a, row.a));
  rows_.push_back(row);
  pattern_.push_back(row.equality ? (level.bounds ? kBoundEquality : kEquality)
                                  : (level.bounds ? kBoundInequality : kInequality));
  return row.lower <= row.upper && row.lower < kAbsent && row.upper > -kAbsent &&
         std::isfinite(row.norm);
}

double RowTable::dot(int i, const Vector& x) const {
  return rows_[i].a ? kernels::dot(x.size(), rows_[i].a, x.data()) : x[rows_[i].row];
}

void RowTable::add_to(int i, double scale, Vector& y) const {
  if (rows_[i].a) {
    kernels::axpy(y.size(), scale, rows_[i].a, y.data());
  } else {
    y[rows_[i].row] += scale;
  }
}

void RowTable::save_pattern(StateWriter& writer) const {
  writer.put(static_cast<double>(pattern_.size()));
  for (char kind : pattern_) writer.put(kind);
}

void RowTable::restore_pattern(StateReader& reader) {
  pattern_.resize(static_cast<std::size_t>(reader.get_count(kMostRows)));
  for (char& kind : pattern_) kind = static_cast<char>(reader.get_count(kEndOfLevel));
}

double RowTable::violation(int i, double value) const {
  return value > rows_[i].upper ? value - rows_[i].upper
                                : (value < rows_[i].lower ? value - rows_[i].lower : 0.0);
}

}  // namespace hurcules

#include "hurcules/solver/problem/row_table.hpp"

#include <cmath>
#include <functional>

namespace hurcules {

namespace {

constexpr Index kMostRows = 1'000'000;  // in a snapshot

enum Pattern : char {
  kEquality,
  kInequality,
  kBoundEquality,
  kBoundInequality,
  kEndOfLevel,
  kUnlimited
};

char kind_of(const LevelView& level, Index i) {
  if (level.lower[i] == level.upper[i]) return level.bounds ? kBoundEquality : kEquality;
  if (level.bounds) return kBoundInequality;
  return level.lower[i] <= -kInfinity && level.upper[i] >= kInfinity ? kUnlimited : kInequality;
}

bool alike_kinds(char a, char b) {
  const auto is_dense = [](char kind) { return kind == kInequality || kind == kUnlimited; };
  return a == b || (is_dense(a) && is_dense(b));
}

}  // namespace

void RowTable::reserve(Index unknowns, Index rows, Index levels) {
  unknowns_ = unknowns;
  rows_.reserve(rows);
  for (auto* v : {&begin_, &equalities_, &inequalities_}) v->reserve(levels + 1);
  for (auto* v : {&block_level_, &level_block_}) v->reserve(levels);
  row_of_dense_.reserve(rows);
  dense_.reserve(rows, unknowns);
  dense_.shape(unknowns);
  // padding behind each block of bounds and behind the dense rows
  const Index candidates = rows + 4 * levels + 8;
  row_of_candidate_.reserve(candidates);
  for (PaddedVector* v : {&asked_lower_, &asked_upper_, &norm_}) v->reserve(candidates);
  for (PaddedVector* v : {&target_, &dense_norm_, &dense_norm2_}) v->reserve(rows + 4);
  pattern_.reserve(rows + levels);
  arranged_ = false;
}

bool RowTable::shapes_fit(HierarchyView hierarchy) const {
  for (const LevelView& level : hierarchy) {
    const bool fits = level.bounds ? level.rows() == unknowns_
                                   : level.A.rows() == level.rows() &&
                                         (level.rows() == 0 || level.A.cols() == unknowns_);
    if (!fits || level.upper.size() != level.rows() || !(level.rho >= 0.0) ||
        std::isinf(level.rho)) {
      return false;
    }
  }
  return true;
}

template <class Same>
bool RowTable::pattern_stands(HierarchyView hierarchy, Same&& same_kind) const {
  const char* kind = pattern_.data();
  const char* const end = kind + pattern_.size();
  for (const LevelView& level : hierarchy) {
    const Index count = level.rows();
    if (end - kind <= count) return false;
    bool same = kind[count] == kEndOfLevel;
    for (Index i = 0; i < count; ++i) same &= same_kind(kind[i], kind_of(level, i));
    if (!same) return false;
    kind += count + 1;
  }
  return kind == end;
}

void RowTable::read_pattern(HierarchyView hierarchy) {
  same_pattern_ = pattern_stands(hierarchy, std::equal_to<char>());
  alike_ = same_pattern_ || pattern_stands(hierarchy, alike_kinds);
  if (same_pattern_) return;
  pattern_.clear();
  for (const LevelView& level : hierarchy) {
    for (Index i = 0; i < level.rows(); ++i) pattern_.push_back(kind_of(level, i));
    pattern_.push_back(kEndOfLevel);
  }
}

void RowTable::arrange(HierarchyView hierarchy) {
  rows_.clear();
  for (auto* v : {&begin_, &equalities_, &inequalities_}) v->assign(1, 0);
  block_level_.clear();
  level_block_.assign(hierarchy.size(), -1);
  row_of_dense_.clear();
  row_of_candidate_.clear();
  any_unlimited_ = false;
  const char* kind = pattern_.data();
  for (int k = 0; k < static_cast<int>(hierarchy.size()); ++k, ++kind) {
    const LevelView& level = hierarchy[k];
    int equal = equalities_.back(), unequal = inequalities_.back();
    const int block = static_cast<int>(block_level_.size() * stride());
    if (level.bounds) {
      level_block_[k] = bounds_blocks();
      block_level_.push_back(k);
      row_of_candidate_.resize(block + stride(), -1);
    }
    for (int i = 0; i < level.rows(); ++i, ++kind) {
      Row row{.level = k, .row = i, .bound = level.bounds, .norm = 1.0};
      row.equality = *kind == kEquality || *kind == kBoundEquality;
      row.unlimited = *kind == kUnlimited;
      if (row.equality) row.dense = equal++;
      if (*kind == kInequality) row.dense = unequal++;
      if (*kind == kBoundInequality) row.candidate = block + i;
      if (row.candidate >= 0) row_of_candidate_[row.candidate] = size();
      rows_.push_back(row);
    }
    begin_.push_back(size());
    equalities_.push_back(equal);
    inequalities_.push_back(unequal);
  }
  row_of_dense_.resize(dense());
  row_of_candidate_.resize(candidates(levels()), -1);
  for (int i = 0; i < size(); ++i) {
    Row& row = rows_[i];
    if (row.unlimited) place_unlimited(row);
    if (row.dense < 0 || row.unlimited) continue;
    if (!row.equality) {
      row.candidate = first_dense_candidate() + row.dense;
      row_of_candidate_[row.candidate] = i;
      row.dense += equalities();
    }
    row_of_dense_[row.dense] = i;
  }
  const Index count = candidates(levels()) + (any_unlimited_ ? 1 : 0);
  std::fill_n(asked_lower_.data(), count, -kAbsent);
  std::fill_n(asked_upper_.data(), count, kAbsent);
  std::fill_n(norm_.data(), count, 1.0);
  dense_.set_zero(dense_rows());
  // simple bounds that are equalities are rows of the identity
  for (const Row& row : rows_) {
    if (row.bound && row.equality) dense_.row(row.dense)[row.row] = 1.0;
  }
  arranged_ = true;
}

// behind all others: a row of zeros, and a candidate without limits
void RowTable::place_unlimited(Row& row) {
  row.dense = dense();
  row.candidate = static_cast<int>(candidates(levels()));
  row.norm = 0.0;
  any_unlimited_ = true;
}

bool RowTable::read_limits(HierarchyView hierarchy) {
  bool good = true;
  Row* row = rows_.data();
  for (const LevelView& level : hierarchy) {
    for (Index r = 0; r < level.rows(); ++r, ++row) {
      const double lower = level.lower[r], upper = level.upper[r];
      good &= lower <= upper && lower < kInfinity && upper > -kInfinity;
      row->lower = lower <= -kInfinity ? -kAbsent : lower;
      row->upper = upper >= kInfinity ? kAbsent : upper;
      if (row->equality) {
        target_[row->dense] = lower;
      } else {
        asked_lower_[row->candidate] = row->lower;
        asked_upper_[row->candidate] = row->upper;
      }
    }
  }
  return good;
}

void RowTable::read_rows(HierarchyView hierarchy) {
  const kernels::Table& kernel = *kernels::chosen;
  for (int k = 0; k < levels(); ++k) {
    const LevelView& level = hierarchy[k];
    const int first = begin(k), count = begin(k + 1) - first;
    if (level.bounds || count == 0) continue;
    const int equal = equalities(k + 1) - equalities(k);
    // rows of one kind stand one behind the other
    if (equal == count || inequalities(k + 1) - inequalities(k) == count) {
      kernel.copy_rows(level.A.data(), count, unknowns_, dense_.row(rows_[first].dense), stride());
      continue;
    }
    for (int r = 0; r < count; ++r) {
      if (rows_[first + r].unlimited) continue;
      kernel.copy_rows(level.A.data() + r * unknowns_, 1, unknowns_,
                       dense_.row(rows_[first + r].dense), stride());
    }
  }
}

// of those that are not stored
bool RowTable::unlimited_are_finite(HierarchyView hierarchy) const {
  bool good = true;
  for (const Row& row : rows_) {
    if (!row.unlimited) continue;
    good &= hierarchy[row.level].A.row(row.row).squaredNorm() <= kLongestRow * kLongestRow;
  }
  return good;
}

bool RowTable::read_numbers(HierarchyView hierarchy) {
  bool good = read_limits(hierarchy) && (!any_unlimited_ || unlimited_are_finite(hierarchy));
  read_rows(hierarchy);
  kernels::chosen->norms2(dense_row(0), dense(), stride(), dense_norm2_.data());
  for (int d = 0; d < dense(); ++d) {
    const double norm = std::sqrt(dense_norm2_[d]);
    good &= norm <= kLongestRow;
    dense_norm_[d] = rows_[row_of_dense_[d]].norm = norm;
  }
  std::copy_n(dense_norm_.data() + equalities(), inequalities(),
              norm_.data() + first_dense_candidate());
  return good;
}

bool RowTable::read(HierarchyView hierarchy) {
  if (!shapes_fit(hierarchy)) {
    // the table no longer holds what was read before
    arranged_ = same_pattern_ = alike_ = false;
    pattern_.clear();
    return false;
  }
  read_pattern(hierarchy);
  if (!same_pattern_ || !arranged_) arrange(hierarchy);
  return read_numbers(hierarchy);
}

double RowTable::dot(int i, const double* x) const {
  const Row& row = rows_[i];
  return row.dense < 0 ? x[row.row] : kernels::chosen->dot(stride(), dense_row(row.dense), x);
}

void RowTable::add_to(int i, double scale, double* y) const {
  const Row& row = rows_[i];
  if (row.dense < 0) {
    y[row.row] += scale;
  } else {
    kernels::chosen->axpy(stride(), scale, dense_row(row.dense), y);
  }
}

void RowTable::values(int level, const double* x, double* value) const {
  for (int b = 0; b < bounds_blocks(); ++b) std::copy_n(x, stride(), value + b * stride());
  if (inequalities(level) == 0) return;
  kernels::chosen->dots(dense_row(equalities()), inequalities(level), stride(), x,
                        value + first_dense_candidate());
}

void RowTable::own_values(int level, const double* x, double* value) const {
  const Range own = own_candidates(level);
  if (own.count == 0) return;
  if (level_block_[level] >= 0) {
    std::copy_n(x, own.count, value + own.first);
  } else {
    kernels::chosen->dots(dense_row(equalities() + inequalities(level)), own.count, stride(), x,
                          value + own.first);
  }
}

double RowTable::violation(int i, double value) const {
  return value > rows_[i].upper ? value - rows_[i].upper
                                : (value < rows_[i].lower ? value - rows_[i].lower : 0.0);
}

double RowTable::dot(int i, const Vector& x) const {
  const Row& row = rows_[i];
  if (row.dense < 0) return x[row.row];
  return Eigen::Map<const Vector>(dense_row(row.dense), unknowns_).dot(x);
}

void RowTable::add_to(int i, double scale, Vector& y) const {
  const Row& row = rows_[i];
  if (row.dense < 0) {
    y[row.row] += scale;
  } else {
    y += scale * Eigen::Map<const Vector>(dense_row(row.dense), unknowns_);
  }
}

void RowTable::save_pattern(StateWriter& writer) const {
  writer.put(static_cast<double>(pattern_.size()));
  for (char kind : pattern_) writer.put(kind);
}

void RowTable::restore_pattern(StateReader& reader) {
  pattern_.resize(static_cast<std::size_t>(reader.get_count(kMostRows)));
  for (char& kind : pattern_) kind = static_cast<char>(reader.get_count(kUnlimited));
  arranged_ = false;
}

}  // namespace hurcules

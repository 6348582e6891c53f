// All rows of a hierarchy in one list, so that a row has one number whatever level it stands in,
// and in the memory that the inner loops want: equality rows by level, then dense inequality rows
// by level, padded; simple bounds as blocks of n.
//
// An inequality row is also a candidate: a place in the arrays of limits and values. Blocks of
// simple bounds come first, then the dense inequality rows, so that the candidates of levels 0..k
// are the first `candidates(k + 1)` (bounds of lower levels count as absent until their turn).
//
// A row without limits asks for nothing: it keeps its number only. All such share a row of zeros and a
// candidate behind the others.
#pragma once

#include <limits>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/solver/hierarchy.hpp"
#include "hurcules/solver/kernels/kernels.hpp"
#include "hurcules/solver/kernels/padded.hpp"

namespace hurcules {

// a limit that is not there, on either side
inline constexpr double kAbsent = std::numeric_limits<double>::infinity();

struct Row {
  int level = 0;
  int row = 0;             // its place in the level
  bool equality = false;   // lower == upper
  bool unlimited = false;  // no bound, both sides absent
  bool bound = false;      // a simple bound: a is the unit vector of `row`
  int dense = -1;          // place among the dense rows; -1 for a bound that is no equality
  int candidate = -1;      // place among the candidates; -1 for an equality
  double lower = 0.0;      // -inf when absent
  double upper = 0.0;      // +inf when absent
  double norm = 0.0;       // |a|
};

class RowTable {
 public:
  // memory for hierarchies up to this number of rows and levels over n unknowns
  void reserve(Index unknowns, Index rows, Index levels);
  // reads the rows; false when a number is NaN, a shape is off, or lower > upper
  [[nodiscard]] bool read(HierarchyView hierarchy);

  [[nodiscard]] Index unknowns() const { return unknowns_; }
  [[nodiscard]] int size() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] const Row& operator[](int i) const { return rows_[i]; }
  // rows of level k are begin(k) .. begin(k + 1) - 1
  [[nodiscard]] int begin(int level) const { return begin_[level]; }
  [[nodiscard]] int levels() const { return static_cast<int>(begin_.size()) - 1; }
  // true when levels, row kinds and bounds stand as in the table read before
  [[nodiscard]] bool same_pattern() const { return same_pattern_; }
  // the same but for rows that have limits now, or have lost them
  [[nodiscard]] bool alike() const { return alike_; }

  // dense storage: equality rows of level k are equalities(k) .. equalities(k + 1) - 1
  [[nodiscard]] int equalities(int level) const { return equalities_[level]; }
  [[nodiscard]] int equalities() const { return equalities_.back(); }
  // dense inequality rows of levels below `level`; they start behind all equality rows
  [[nodiscard]] int inequalities(int level) const { return inequalities_[level]; }
  [[nodiscard]] int inequalities() const { return inequalities_.back(); }
  [[nodiscard]] int dense() const { return equalities() + inequalities(); }
  // these and the row of zeros, where there is one
  [[nodiscard]] int dense_rows() const { return dense() + (any_unlimited_ ? 1 : 0); }
  [[nodiscard]] const double* dense_row(int d) const { return dense_.row(d); }
  // by dense row: the target of an equality, |a| and |a|^2
  [[nodiscard]] const double* targets() const { return target_.data(); }
  [[nodiscard]] const double* dense_norms() const { return dense_norm_.data(); }
  [[nodiscard]] const double* dense_norms2() const { return dense_norm2_.data(); }
  [[nodiscard]] Index stride() const { return dense_.stride(); }
  [[nodiscard]] int row_of_dense(int d) const { return row_of_dense_[d]; }

  // blocks of simple bounds, `stride()` candidates each
  [[nodiscard]] int bounds_blocks() const { return static_cast<int>(block_level_.size()); }
  [[nodiscard]] int block_level(int block) const { return block_level_[block]; }
  [[nodiscard]] int first_dense_candidate() const {
    return static_cast<int>(bounds_blocks() * stride());
  }
  // a multiple of four; the few behind the last row are absent
  [[nodiscard]] Index candidates(int level) const {
    return padded(first_dense_candidate() + inequalities(level));
  }
  // row behind a candidate, or -1
  [[nodiscard]] int row_of_candidate(Index c) const { return row_of_candidate_[c]; }
  // the candidates of one level: `count` from `first` on (of simple bounds with their padding)
  struct Range {
    Index first, count;
  };
  [[nodiscard]] Range own_candidates(int level) const {
    const int b = level_block_[level];
    if (b >= 0) return {b * stride(), stride()};
    return {first_dense_candidate() + inequalities(level),
            inequalities(level + 1) - inequalities(level)};
  }
  // limits as the hierarchy asks for them, by candidate; absent until `own_limits` of their level
  [[nodiscard]] const double* asked_lower() const { return asked_lower_.data(); }
  [[nodiscard]] const double* asked_upper() const { return asked_upper_.data(); }
  [[nodiscard]] const double* norms() const { return norm_.data(); }

  // x and y padded to stride()
  [[nodiscard]] double dot(int i, const double* x) const;        // a_i . x
  void add_to(int i, double scale, double* y) const;             // y += scale a_i
  void values(int level, const double* x, double* value) const;  // of candidates of levels < level
  void own_values(int level, const double* x, double* value) const;  // of candidates of one level
  // signed distance of a_i . x to [lower, upper]
  [[nodiscard]] double violation(int i, double value) const;
  // the same on Eigen vectors, (n)
  [[nodiscard]] double dot(int i, const Vector& x) const;
  void add_to(int i, double scale, Vector& y) const;

  // the pattern, so that a restored solver knows whether its working sets still fit
  void save_pattern(StateWriter& writer) const;
  void restore_pattern(StateReader& reader);

 private:
  [[nodiscard]] bool shapes_fit(HierarchyView hierarchy) const;
  void read_pattern(HierarchyView hierarchy);
  template <class Same>
  [[nodiscard]] bool pattern_stands(HierarchyView hierarchy, Same&& same_kind) const;
  // places of all rows in storage and among the candidates, from the pattern
  void arrange(HierarchyView hierarchy);
  void place_unlimited(Row& row);
  [[nodiscard]] bool read_numbers(HierarchyView hierarchy);
  [[nodiscard]] bool read_limits(HierarchyView hierarchy);
  [[nodiscard]] bool unlimited_are_finite(HierarchyView hierarchy) const;
  void read_rows(HierarchyView hierarchy);

  Index unknowns_ = 0;
  std::vector<Row> rows_;
  std::vector<int> begin_{0}, equalities_{0}, inequalities_{0};
  std::vector<int> block_level_, level_block_, row_of_dense_, row_of_candidate_;
  PaddedRows dense_;
  PaddedVector asked_lower_, asked_upper_, norm_;
  PaddedVector target_, dense_norm_, dense_norm2_;
  std::vector<char> pattern_;
  bool same_pattern_ = false, alike_ = false, arranged_ = false, any_unlimited_ = false;
};

}  // namespace hurcules

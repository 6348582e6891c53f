// What the inequality rows allow at the level that is being solved, by candidate (row_table.hpp).
//
// A row of a level above must not get worse than it is: its limits are those asked for, or the
// value that it has, whichever is wider (solver.md §1). A row that a working set holds is absent
// here as long as it is held.
#pragma once

#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules {

class Candidates {
 public:
  void reserve(Index most);
  // before the first level: nothing is limited
  void start(const RowTable& rows);
  // the rows of `level` count from here on, as asked for; `x`, where the levels above ended, gives
  // their values
  void open(const RowTable& rows, int level, const double* x);
  // The level is solved, with `value` at its answer: its rows and those above may not get worse.
  // What is within rounding in x (of size x_scale) of a limit, on either side, is limited where it
  // is: more rows may meet in a point than there are directions, and only those values agree on it.
  // `held`: some row was held.
  void close(const RowTable& rows, int level, double x_scale, bool held);

  // some inequality row of `level` is violated at `value`, beyond rounding in x of size x_scale
  [[nodiscard]] static bool violated(const RowTable& rows, int level, const PaddedVector& value,
                                     double x_scale);

  [[nodiscard]] kernels::LimitArrays limits(const RowTable& rows) const {
    return {lower_.data(), upper_.data(), rows.norms()};
  }
  [[nodiscard]] double lower(Index c) const { return lower_[c]; }
  [[nodiscard]] double upper(Index c) const { return upper_[c]; }
  void set(Index c, double lower, double upper) {
    lower_[c] = lower;
    upper_[c] = upper;
  }

  PaddedVector above;   // values where the levels above ended
  PaddedVector value;   // at the point of interest
  PaddedVector target;  // where a move wants to take them

 private:
  PaddedVector lower_, upper_;
  bool widened_ = false;  // some row may be at a limit, or beyond
};

}  // namespace hurcules

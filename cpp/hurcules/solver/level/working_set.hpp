// The rows that a level's answer rests on: each held at one side of its limits.
//
// With M the images of the held rows, signed by their sides (level_problem.hpp), and M = F V (F
// lower triangular, V orthonormal rows):
//     y = V' g,  F g = limits - values at x_free,       multipliers = -F^-T g
// is the point of least norm on the held limits.
#pragma once

#include <vector>

#include "hurcules/solver/kernels/orthogonal_factor.hpp"
#include "hurcules/solver/level/level_problem.hpp"
#include "hurcules/solver/problem/candidates.hpp"
#include "hurcules/solver/solution.hpp"

namespace hurcules {

// A place in the working set, as opposed to the number of a row.
struct ActiveSlot {
  int row = 0;  // in the table
  Side side = Side::Upper;
  double limit = 0.0;
  double lower = 0.0, upper = 0.0;  // what the row allows when it is let go
  double multiplier = 0.0;          // >= 0 at the optimum
};

class WorkingSet {
 public:
  void reserve(Index rows, Index dimension);
  // empty, for the level of `problem` around x_free
  void start(const RowTable& rows, const LevelProblem& problem, Candidates& candidates,
             const double* x_free);

  // Plans a row for `factor`; ignored when it has no limit at that side.
  void plan(int row, Side side);
  // factors all planned rows at once, those that depend on the others left out
  void factor();
  // Adds a row. False, and nothing is changed, when it depends on the rows that are held.
  bool add(int row, Side side);
  void drop(Index slot);
  // lets all rows go
  void clear();

  // y of the held rows
  void solve(double* y);
  // y of the held rows from that without the row that was added last
  void add_newest(double* y) const;
  void find_multipliers();
  // moves y by the least amount that changes each held row by its entry of `change` (slots)
  void correct(double* change, double* y);
  // slot of the most negative multiplier beyond `tolerance` of the largest, or -1
  [[nodiscard]] Index most_negative(double tolerance) const;

  [[nodiscard]] Index size() const { return static_cast<Index>(slots_.size()); }
  [[nodiscard]] const std::vector<ActiveSlot>& slots() const { return slots_; }

 private:
  void hold(int row, Side side);
  void release(const ActiveSlot& slot);
  // side * (limit - value at x_free)
  [[nodiscard]] double room(const ActiveSlot& slot) const;
  // nothing in this problem can move the row
  [[nodiscard]] bool lost(int row, double norm2) const;
  void start_factor(Index rows);
  // g of a row that was just appended
  void append_room(Index slot);
  double fill_image(int row, Side side, double* m) const;

  const RowTable* rows_ = nullptr;
  const LevelProblem* problem_ = nullptr;
  Candidates* candidates_ = nullptr;
  const double* x_free_ = nullptr;
  OrthogonalFactor factor_;
  bool started_ = false;
  std::vector<ActiveSlot> slots_;
  PaddedVector norm2_, g_, work_;
};

}  // namespace hurcules

// A level whose working set of the last solve still stands: its rows are factored at once, the
// answer is checked, and nothing is searched.
#pragma once

#include <span>
#include <vector>

#include "hurcules/solver/kernels/orthogonal_factor.hpp"
#include "hurcules/solver/level/level_problem.hpp"
#include "hurcules/solver/level/working_set_cache.hpp"
#include "hurcules/solver/problem/candidates.hpp"

namespace hurcules {

class WarmStart {
 public:
  void reserve(Index unknowns, Index most_rows, Index most_own);
  // The answer x of a level that holds the rows `kept`, and candidates.value its values. False,
  // and nothing that counts is changed, when they are not the working set of the level as it is
  // now. x_scale is what rounding in x is relative to.
  bool solve(const RowTable& rows, LevelProblem& problem, Candidates& candidates, double rho,
             double x_scale, std::span<const KeptRow> kept, double* x);
  // the rows and their multipliers, times scale
  void keep(double scale, std::vector<HeldRow>& held) const;

 private:
  struct Slot {
    const Row* row;
    int place;  // of the row in the table
    Side side;
    double limit;
  };

  bool factor(std::span<const KeptRow> kept);
  // the point of the slots in y and x, and the values there
  void evaluate(double* x);
  // brings the slots onto their limits where rounding left them off
  void refine(double x_scale, double* x);
  [[nodiscard]] double largest_miss();
  // false when some is negative
  bool find_multipliers();
  [[nodiscard]] bool none_broken(double x_scale);

  const RowTable* rows_ = nullptr;
  LevelProblem* problem_ = nullptr;
  Candidates* candidates_ = nullptr;
  OrthogonalFactor factor_;
  std::vector<Slot> slots_;
  Index size_ = 0;  // slots in use
  PaddedVector norm2_, g_, multiplier_, y_, change_;
};

}  // namespace hurcules

// The part of a step that limits and own rows settle in a large level whose regularisation is
// nothing.
//
// With the step (t_1, t_2) in the directions of the own equality rows and in the others, these rows
// A t_1 = b have no part in t_2, and of t_1 they settle all. So what else is settled is told by the
// parts of limits and violated rows in t_2 alone, u of its directions: no own row is asked whether
// it gives a direction. With the limits C (t_1, u) = d, reflections H that make C H' = (L, 0) leave
//     (t_1, u) = H' (y_1, y_2),   L y_1 = d,
//     min |A t_1 - b|^2 + |V (t_1, u) - w|^2 over y_2    (V: violated rows),
// the least squares by reflections of the rows.
#pragma once

#include <span>
#include <vector>

#include "hurcules/solver/kernels/orthogonal_factor.hpp"
#include "hurcules/solver/kernels/padded.hpp"
#include "hurcules/solver/level/level_problem.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/small_rho/grouped_row.hpp"

namespace hurcules {

class SettledStep {
 public:
  // limits, and violated rows behind them, with their coordinates in directions beside the own ones
  struct Held {
    std::span<GroupedRow> rows;
    Index limits;
    const OrthogonalFactor& beside;
    Index settled;  // directions of `beside` in which they have a part
  };

  void reserve(Index unknowns, Index rows);
  // of a level from x_above
  void start(const RowTable& rows, const NullspaceBasis& nullspace, LevelProblem& level,
             const double* x_above);
  // (t_1, u)
  const double* solve(const Held& held);
  // multipliers of the limits against the violations at x, with the values of the candidates there
  void balance(const Held& held, const double* x, const double* values);

 private:
  void gather_own(const Held& held);
  void add(const double* e);
  void add(const Held& held, Index i);
  void end_rows();
  void reduce_limits(const Held& held);
  void meet_limits(const Held& held);
  void reflect(const double* v, Index first);
  void least_squares(const Held& held);
  double find_force(const Held& held, const double* x, const double* values);
  [[nodiscard]] double rest(const GroupedRow& row) const;

  const RowTable* rows_ = nullptr;
  const NullspaceBasis* nullspace_ = nullptr;
  LevelProblem* level_ = nullptr;
  const double* x_above_ = nullptr;
  bool condensed_ = false;  // R and c of the level stand in for its equality rows
  Index columns_ = 0, count_ = 0, rank_ = 0;
  PaddedRows held_;     // limits, then own rows, reflected; a column for what a kernel writes
  PaddedRows mirror_;   // v of the reflections 1 - v v'
  PaddedRows block_;    // the least squares
  PaddedVector asked_;  // what the own rows ask for
  PaddedVector y_, t_, force_, wide_, violation_, work_;
  std::vector<Index> pivot_;  // the limit of each reflection
};

}  // namespace hurcules

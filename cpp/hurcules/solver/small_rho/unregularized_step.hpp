// The step that held rows ask for in a level whose regularisation is nothing, or small against its
// rows, and their multipliers.
//
// In the free directions the rows in the order
//     limits that push against the level | own equality and violated rows | limits that hold only
//     the smallest step
// are met one after the other: the limits exactly, the own rows by least squares, the last with
// what is left. In a large level settled_step.hpp does the first two.
#pragma once

#include <span>
#include <vector>

#include "hurcules/solver/kernels/orthogonal_factor.hpp"
#include "hurcules/solver/kernels/padded.hpp"
#include "hurcules/solver/level/level_problem.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/small_rho/grouped_row.hpp"
#include "hurcules/solver/small_rho/settled_step.hpp"

namespace hurcules {

class UnregularizedStep {
 public:
  void reserve(Index unknowns, Index rows);
  // of a level from x_above; `by_rows`: each row is asked for its direction in a large level, too
  void start(const RowTable& rows, const NullspaceBasis& nullspace, LevelProblem& level,
             const double* x_above, bool by_rows);
  // the point x (n, padded) that the rows ask for
  void solve(const GroupedRows& groups, double rho, double* x);
  // multipliers of the limits against the violations at x, with the values of the candidates there,
  // and against the regularisation
  void balance_violation(double rho, const double* x, const double* values);
  // multipliers of all rows against the step; those of the last group are theirs
  void balance_step();

  // the last step was that of a large level
  [[nodiscard]] bool large() const { return large_; }
  // the rows of all groups, in their order; in a large level without its equality rows
  [[nodiscard]] const std::vector<GroupedRow>& rows() const { return all_; }
  [[nodiscard]] Index begin(RowGroup group) const { return group == 0 ? 0 : end_[group - 1]; }
  [[nodiscard]] Index end(RowGroup group) const { return end_[group]; }
  // the rows that gave a direction, in their order, and what they push against the step
  [[nodiscard]] Index directions() const { return factor_.rank(); }
  [[nodiscard]] const GroupedRow& row_of(Index j) const { return all_[factor_.pivot(j)]; }
  [[nodiscard]] double push(Index j) const { return push_[j]; }
  [[nodiscard]] bool is_smallest(Index j) const { return j >= rank_[kOwn]; }

 private:
  void gather(const GroupedRows& groups);
  void solve_large(double* x);
  [[nodiscard]] SettledStep::Held settled() {
    return {{all_.data(), all_.data() + end_[kOwn]}, end_[kLimits], factor_, rank_[kOwn]};
  }
  void factor();
  double own_rank(double& weakest, Index& seen);
  // from the point x that the rows before the group ask for
  void meet(RowGroup group, const double* x);
  void least_squares(double rho);
  void add_smallest(double rho, Index& count);
  // x moves along the first directions of the factor, those of the level from `first` on
  void step(Index first, double* x);
  // directions before those of a group
  [[nodiscard]] Index first(RowGroup group) const { return group == 0 ? 0 : rank_[group - 1]; }

  const RowTable* rows_ = nullptr;
  const NullspaceBasis* nullspace_ = nullptr;
  LevelProblem* level_ = nullptr;
  const double* x_above_ = nullptr;
  bool by_rows_ = false;
  bool large_ = false;        // the factor is of the directions beside the own ones
  double limits_rank_ = 0.0;  // what is rounding of an own row outside the limits
  std::vector<GroupedRow> all_;
  Index end_[kRowGroups] = {}, rank_[kRowGroups] = {};
  OrthogonalFactor factor_;
  SettledStep settled_;
  PaddedRows block_;
  PaddedVector norm2_, y_, t_, force_, push_, work_;
};

}  // namespace hurcules

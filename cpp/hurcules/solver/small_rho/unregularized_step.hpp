// The step that held rows ask for in a level whose regularisation is nothing, or small against its
// rows, and their multipliers.
//
// In the free directions the rows in the order
//     limits that push against the level | own equality and violated rows | limits that hold only
//     the smallest step
// are met one after the other: the limits exactly, the own rows by least squares, the last with
// what is left.
#pragma once

#include <array>
#include <vector>

#include "hurcules/solver/kernels/orthogonal_factor.hpp"
#include "hurcules/solver/kernels/padded.hpp"
#include "hurcules/solver/level/level_problem.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/solution.hpp"

namespace hurcules {

enum RowGroup { kLimits, kOwn, kSmallest, kRowGroups };

// a row that is held in one of the groups
struct GroupedRow {
  int row;  // in the table
  Side side;
  double limit;
  double lower, upper;  // what the row allows when it is let go
  double multiplier;
  bool pinned;  // it came back from the last group once

  // which way it pushes
  [[nodiscard]] double sign() const { return static_cast<double>(side); }
};
using GroupedRows = std::array<std::vector<GroupedRow>, kRowGroups>;

class UnregularizedStep {
 public:
  void reserve(Index unknowns, Index rows);
  // of a level from x_above
  void start(const RowTable& rows, const NullspaceBasis& nullspace, const LevelProblem& level,
             const double* x_above);
  // the point x (n, padded) that the rows ask for
  void solve(const GroupedRows& groups, double rho, double* x);
  // multipliers of the limits against the violations at x, with the values of the candidates there,
  // and against the regularisation
  void balance_violation(double rho, const double* x, const double* values);
  // multipliers of all rows against the step; those of the last group are theirs
  void balance_step();

  // the rows of all groups, in their order
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
  void factor();
  double own_rank(double& weakest, Index& seen);
  void meet(RowGroup group);
  void least_squares(double rho);
  void add_smallest(double rho, Index& count);
  void step(double* x);
  // directions before those of a group
  [[nodiscard]] Index first(RowGroup group) const { return group == 0 ? 0 : rank_[group - 1]; }

  const RowTable* rows_ = nullptr;
  const NullspaceBasis* nullspace_ = nullptr;
  const LevelProblem* level_ = nullptr;
  const double* x_above_ = nullptr;
  double limits_rank_ = 0.0;  // what is rounding of an own row outside the limits
  std::vector<GroupedRow> all_;
  Index end_[kRowGroups] = {}, rank_[kRowGroups] = {};
  OrthogonalFactor factor_;
  PaddedRows block_;
  PaddedVector norm2_, y_, t_, force_, push_, work_;
};

}  // namespace hurcules

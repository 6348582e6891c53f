// A copy of a solved hierarchy: its rows, x after every level, and the rows that held.
//
// It owns all of its numbers, so that what is asked later (multipliers, sensitivity, level reports)
// is answered for that solve, whatever has become of the caller's arrays and of the solver.
#pragma once

#include <span>
#include <vector>

#include "hurcules/solver/optimality/optimality.hpp"
#include "hurcules/solver/problem/row_table.hpp"
#include "hurcules/solver/solution.hpp"

namespace hurcules {

// what was done about singularities
struct SingularRules {
  int handed_to = -1;      // the first level that has weak directions of those above; -1: none
  bool adaptive = false;   // rho follows the smallest singular value
  double threshold = 0.0;  // below this
};

class SolvedHierarchy {
 public:
  // what a method has at the end of a solve; a record a level
  SolvedHierarchy(const RowTable& rows, std::span<const LevelRecord> records,
                  std::span<const HeldRow> held, const Solution& solution,
                  const SingularRules& rules);

  [[nodiscard]] Index unknowns() const { return unknowns_; }
  [[nodiscard]] SolverStatus status() const { return status_; }
  [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
  // levels known to be optimal: only they have rho, x and held rows
  [[nodiscard]] int final_levels() const { return final_levels_; }

  // rows of level k are begin(k) .. begin(k + 1) - 1
  [[nodiscard]] int begin(int k) const { return k < levels() ? levels_[k].begin : size(); }
  [[nodiscard]] int size() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] const Row& row(int i) const { return rows_[i]; }
  [[nodiscard]] bool is_bounds(int k) const { return levels_[k].bounds; }
  [[nodiscard]] Vector dense(int i) const;  // a_i, (n)
  // signed distance of a_i x to its interval
  [[nodiscard]] double violation(int i, const Vector& x) const;

  // the regularisation that was used
  [[nodiscard]] double rho(int k) const { return levels_[k].rho; }
  // the one that was asked for; of every level
  [[nodiscard]] double asked_rho(int k) const { return levels_[k].asked_rho; }
  [[nodiscard]] const SingularRules& rules() const { return rules_; }
  [[nodiscard]] bool handed_over() const { return rules_.handed_to >= 0; }
  // x after level k, (n); before the first level it is zero
  [[nodiscard]] Vector x(int k) const;
  // the rows that push back in the problem of level k, and those that only keep its step (rho = 0)
  [[nodiscard]] std::span<const HeldRow> held(int k) const;
  [[nodiscard]] std::span<const HeldRow> smallest_step(int k) const;

 private:
  struct SolvedLevel {
    int begin = 0, first_held = 0, held = 0, smallest = 0;
    double rho = 0.0, asked_rho = 0.0;
    bool bounds = false;
  };

  [[nodiscard]] Eigen::Map<const Vector> stored(Index place) const;

  Index unknowns_ = 0;
  SolverStatus status_ = SolverStatus::Solved;
  int final_levels_ = 0;
  SingularRules rules_;
  std::vector<Row> rows_;
  std::vector<SolvedLevel> levels_;
  std::vector<HeldRow> held_;
  std::vector<double> numbers_;  // x of every final level, then the rows by Row::dense
};

// throws Error on null: the method keeps no such copy
void require_solved(const SolvedHierarchy* solved);

// multipliers[k][j] (m_j) of the rows of level j in the optimality of level k, j <= k [T 3.4.116]
[[nodiscard]] std::vector<std::vector<Vector>> multipliers(const SolvedHierarchy& solved);

}  // namespace hurcules

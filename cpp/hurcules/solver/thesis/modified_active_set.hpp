// Algorithm 1 of the thesis: one working set over all levels, changed without step lengths
// [T alg. 1], [T §3.4.2].
//
// Repeat: solve all levels as if the rows held were equalities (primal and multipliers of every
// pair of levels); add the row that is violated most; if none is, drop the row with the lowest
// multiplier when it is negative, unless the row was ever strongly active (set S): then, or when
// there is none, end. Three methods differ in how a level is factored and what the multipliers
// contain: kRhqpThesis, kHqp, kDlsHqp. Where it goes wrong: solver.md §8.
#pragma once

#include <span>
#include <vector>

#include "hurcules/solver/method.hpp"
#include "hurcules/solver/problem/row_table.hpp"
#include "hurcules/solver/thesis/decomposition.hpp"

namespace hurcules {

// what the three methods differ in
struct ActiveSetRules {
  FactorKind factor = FactorKind::SingularValues;
  bool regularized = true;           // false: every rho counts as 0
  bool regularization_error = true;  // mu_k = v_k + u_k [T 3.4.108]; false: v_k alone [T §3.5]
};

// The method of the thesis, literally: singular values, and multipliers that contain the
// regularisation error [T 3.3.37], [T 3.4.108-116]. One repair: every violated row blocks, also
// where (3.4.117) finds alpha >= 1 because its limit is negative.
inline constexpr ActiveSetRules kRhqpThesis = {};
// The unregularised hierarchical quadratic program: every rho counts as 0, complete orthogonal
// decompositions [T 3.3.28], [T §3.5].
inline constexpr ActiveSetRules kHqp = {.factor = FactorKind::CompleteOrthogonal,
                                        .regularized = false};
// HQP with a damped inverse [T 3.5.123-126]: the same x as kRhqpThesis for the same working set,
// but multipliers without the regularisation error u_k. So it cycles near singularities and fails
// to release limits [T 4.3.3], [T 4.3.4].
inline constexpr ActiveSetRules kDlsHqp = {.factor = FactorKind::CompleteOrthogonal,
                                           .regularization_error = false};

class ModifiedActiveSet : public Method {
 public:
  ModifiedActiveSet(Index unknowns, const SolverOptions& options, const ActiveSetRules& rules);
  void reserve(HierarchyView hierarchy) override;
  const Solution& solve(HierarchyView hierarchy) override;
  [[nodiscard]] const Solution& solution() const override { return solution_; }
  [[nodiscard]] std::vector<std::vector<Vector>> multipliers() const override;
  void reset() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

 private:
  // the lowest multiplier of M that is negative beyond rounding [T alg. 1, line 9]
  struct Lowest {
    int row = -1;
    double multiplier = 0.0;
  };

  [[nodiscard]] bool fits(HierarchyView hierarchy) const;
  // changes the set until the algorithm ends by itself; false at the limit of iterations
  bool iterate();
  // decomposition, primal and dual of the present set; false when x is beyond double arithmetic
  bool evaluate();
  void list_held();
  bool solve_primal();
  void solve_dual(bool regularization_error);
  void remember_best();
  // the row that x violates most among those not held at that side, or -1  [T 3.4.117]
  [[nodiscard]] int blocking_row() const;
  [[nodiscard]] Lowest lowest_multiplier() const;
  void mark_strongly_active();

  [[nodiscard]] std::span<const HeldLimit> held(int k) const;
  [[nodiscard]] auto multiplier(int k) { return M_.row(k).head(begin_[k + 1]); }
  [[nodiscard]] auto multiplier(int k) const { return M_.row(k).head(begin_[k + 1]); }
  [[nodiscard]] double negative_tolerance(int k) const;
  // worst relative residual of the conditions 3.4.100-107 at level k
  [[nodiscard]] double residual(int k);
  void fill_solution();
  void prove();
  void fill_working_set();
  const Solution& refuse();

  Index unknowns_;
  SolverOptions options_;
  ActiveSetRules rules_;
  Solution solution_;
  RowTable rows_;
  HierarchicalDecomposition decomposition_;
  std::vector<double> rho_;        // a level
  std::vector<char> side_, best_;  // a row: -1, 0, 1; a point: 1
  std::vector<char> strong_;       // a row: in S
  std::vector<HeldLimit> held_;    // by level
  std::vector<int> begin_;         // held_[begin_[k]] is the first of level k
  Vector x_, gradient_;            // (n)
  Vector value_;                   // a row: a x
  Vector violation_, least_;       // a level: norm now; of the best set
  Vector error_, infeasible_;      // a held row: e_k = v_k + u_k, v_k  [T 3.3.76-80]
  Vector scale_;                   // a level: size of the numbers in e_k, for rounding
  Matrix M_;                       // (levels, held rows)  [T 3.4.116]
  Index reserved_rows_ = 0;
  bool kept_ = false;  // side_ holds the working set of the last solve
};

}  // namespace hurcules

// The default method: the loop over the levels, and all memory that it needs (solver.md §1).
#pragma once

#include <vector>

#include "hurcules/solver/chain.hpp"
#include "hurcules/solver/level_problem.hpp"
#include "hurcules/solver/method.hpp"
#include "hurcules/solver/optimality.hpp"
#include "hurcules/solver/row_table.hpp"
#include "hurcules/solver/settled_level.hpp"

namespace hurcules {

class Lexicographic : public Method {
 public:
  Lexicographic(Index unknowns, const SolverOptions& options);
  void reserve(HierarchyView hierarchy) override;
  const Solution& solve(HierarchyView hierarchy) override;
  [[nodiscard]] const Solution& solution() const override { return solution_; }
  [[nodiscard]] std::vector<std::vector<Vector>> multipliers() const override;
  void reset() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

 private:
  [[nodiscard]] bool fits(HierarchyView hierarchy) const;
  // solves level k from x_above_ into x_; false when the solve has to end here
  bool solve_level(const LevelView& level, int k);
  bool solve_first_bounds(int k);  // simple bounds with nothing above: every coordinate by itself
  bool solve_regularized(double rho, int k);
  bool solve_unregularized(int k);  // rho = 0: proximal steps, then the smallest step
  bool proximal_steps(double epsilon, int k);
  bool smallest_step();
  [[nodiscard]] bool has_kept(int k) const;
  // the rows that level k held in the last solve, as candidates of this one
  void collect_kept(int k);
  // from previous_ when there is one, else from the centre: to the optimal working set
  bool find_working_set();
  // slots -> held rows, multipliers times scale; a fixed slot is Idle
  void keep_held(double scale, Role unfixed);

  void finish_level(double rho, int k);
  void keep_working_sets();
  void fill_solution();
  const Solution& refuse();

  Index unknowns_;
  SolverOptions options_;
  Solution solution_;
  RowTable rows_;
  Chain chain_;
  LevelProblem problem_;
  SettledLevel settled_level_;
  Optimality optimality_;
  Vector x_, x_above_, centre_;
  std::vector<LevelRecord> records_;
  std::vector<HeldRow> held_;
  std::vector<KeptRow> kept_;         // of the last solve
  std::vector<ActiveSlot> previous_;  // a working set to start from
  std::vector<char> settled_;         // (rows)
  int begin_held_ = 0, begin_norm_ = 0;
  bool unsettled_ = false;  // the proximal steps of this level still moved at their end
  Index reserved_rows_ = 0;
  std::size_t reserved_levels_ = 0;
};

}  // namespace hurcules

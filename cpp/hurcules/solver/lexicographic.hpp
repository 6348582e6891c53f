// The default method: the loop over the levels, and all memory that it needs (solver.md §1).
//
// A level has up to three ways to its answer, from the quickest to the most careful; the first
// whose answer proves itself counts.
#pragma once

#include <vector>

#include "hurcules/solver/active_set.hpp"
#include "hurcules/solver/candidates.hpp"
#include "hurcules/solver/careful_level.hpp"
#include "hurcules/solver/certificate.hpp"
#include "hurcules/solver/chain_segments.hpp"
#include "hurcules/solver/kept_level.hpp"
#include "hurcules/solver/level_problem.hpp"
#include "hurcules/solver/method.hpp"
#include "hurcules/solver/optimality.hpp"
#include "hurcules/solver/row_table.hpp"
#include "hurcules/solver/settled_level.hpp"
#include "hurcules/solver/solved_hierarchy.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

class Lexicographic : public Method {
 public:
  Lexicographic(Index unknowns, const SolverOptions& options);
  void reserve(HierarchyView hierarchy) override;
  const Solution& solve(HierarchyView hierarchy) override;
  [[nodiscard]] const Solution& solution() const override { return solution_; }
  [[nodiscard]] std::vector<std::vector<Vector>> multipliers() const override;
  [[nodiscard]] std::shared_ptr<const SolvedHierarchy> solved() const override;
  void reset() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

 private:
  // CarefulWithoutRho: a rho so small that its square is lost in rounding counts as 0
  enum class Way { Warm, Cold, Careful, CarefulWithoutRho };

  [[nodiscard]] bool fits(HierarchyView hierarchy) const;
  // solves level k from x_above_ into x_; false when the solve has to end here
  bool solve_level(const LevelView& level, int k);
  // somebody asks for singular values
  [[nodiscard]] bool uses_svd() const {
    return options_.handover == Handover::Smooth ||
           options_.regularization == Regularization::Adaptive;
  }
  [[nodiscard]] SingularRules rules() const;
  // rho of level k, constant or adapted to its singular values
  double regularization(double rho, int k);
  // where there is nothing to do, or no limit in the way
  bool solve_at_once(const LevelView& level, double rho, int k);
  [[nodiscard]] bool satisfied(int k) const;
  // simple bounds with nothing above: every coordinate by itself
  void solve_first_bounds(int k);
  // without limits in the way
  bool solve_free(double rho);
  // the first way whose answer proves itself: its worst residual; `done` when it came to an end
  double try_ways(double rho, int k, bool& done);
  // Limits of rows above that are nearly parallel may leave a level no way but rounding: then
  // x_above_ is its answer. `residual` when that is proven.
  bool proven_to_stay(double rho, int k, double& residual);
  // rho is large enough for the least-distance form
  [[nodiscard]] bool regularized(double rho) const {
    return rho >= tolerance::kSmall * problem_.own_norm();
  }
  bool solve(Way way, double rho, int k);
  bool solve_regularized(Way way, double rho, int k);
  // with the rows of the last solve, if they are the working set
  bool solve_kept(double rho, int k);
  // rho nothing or small: the settled level; or proximal steps and the smallest step
  bool solve_settled(Way way, double rho, int k);
  bool solve_carefully(double rho);
  // from the rows of the last solve, or from those that the active set holds now
  bool settle_kept(double rho, int k);
  bool settle_held(double rho, double epsilon);

  // to the optimal working set, from x_above_
  bool find_cold();
  // the answer of the active set, brought onto its limits
  void take_refined();
  // slots -> held rows, multipliers times scale
  void keep_held(double scale);
  [[nodiscard]] bool has_kept(int k) const { return kept_begin_[k] < kept_begin_[k + 1]; }

  // forgets what a way left behind
  void start_way();
  // the record of a level, and its proof: the worst residual
  double prove(Way way, double rho, int k);
  // the rows that are held -> the record
  void list_held(LevelRecord& record);
  // multipliers sought anew, where those that the way found prove nothing; the worst residual
  double prove_anew(double residual, int k);
  // no proof was asked for, and the way is usually right
  [[nodiscard]] bool believed(Way way) const;
  // by how much rows above moved or got worse, relative to |a| |x|
  double harm_above(int k);
  void lose_precision(int k);
  // no kept rows where they do not fit the present rows
  void check_kept();
  void keep_working_sets();
  ActiveRow* list_active(const LevelRecord& record, int k, ActiveRow* active);
  KeptRow* keep_roles(const LevelRecord& record, int k, KeptRow* kept);
  void fill_solution();
  void fill_violations(int k);
  const Solution& refuse();
  void take(const double* x) { std::copy_n(x, rows_.stride(), x_); }

  Index unknowns_;
  SolverOptions options_;
  Solution solution_;
  RowTable rows_;
  ChainSegments chains_;
  LevelSvd svd_;
  Candidates candidates_;
  LevelProblem problem_;
  KeptLevel kept_level_;
  ActiveSet active_set_;
  SettledLevel settled_level_;
  CarefulLevel careful_level_;
  Optimality optimality_;
  Certificate certificate_;
  Budget budget_;
  Chain* chain_ = nullptr;           // of the level
  double* x_ = nullptr;              // answer of the level, in its record
  const double* x_above_ = nullptr;  // answer of the level above, in its record; or zero_
  PaddedVector zero_, equality_values_;
  std::vector<LevelRecord> records_;
  std::vector<HeldRow> held_;
  std::vector<KeptRow> kept_;    // of the last solve, by level
  std::vector<int> kept_begin_;  // where those of each level begin
  bool restored_ = false;        // they come from a snapshot
  std::vector<KeptRow> found_;   // by the active set, for the settled level
  std::vector<char> listed_;     // (rows)
  double above_scale_ = 1.0;     // max(1, |x_above_|)
  double x_scale_ = 1.0;         // max(1, |x_|), of the last answer that was proven
  std::size_t begin_held_ = 0;
  int begin_norm_ = 0;
  bool values_known_ = false;  // candidates_.value belongs to x_
  Index reserved_rows_ = 0, reserved_own_ = 0;
  std::size_t reserved_levels_ = 0;
};

}  // namespace hurcules

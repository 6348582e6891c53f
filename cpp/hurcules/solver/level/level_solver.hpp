// One level: the strategies to its answer, from the quickest to the most careful. The first whose
// answer proves itself is accepted (solver.md §4).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "hurcules/solver/extended_precision/extended_precision_active_set.hpp"
#include "hurcules/solver/level/active_set.hpp"
#include "hurcules/solver/level/level_problem.hpp"
#include "hurcules/solver/level/warm_start.hpp"
#include "hurcules/solver/level/working_set_cache.hpp"
#include "hurcules/solver/optimality/certificate.hpp"
#include "hurcules/solver/optimality/optimality.hpp"
#include "hurcules/solver/problem/candidates.hpp"
#include "hurcules/solver/problem/tolerances.hpp"
#include "hurcules/solver/small_rho/step_multipliers.hpp"
#include "hurcules/solver/small_rho/unregularized_active_set.hpp"

namespace hurcules {

class LevelSolver {
 public:
  void reserve(Index unknowns, Index rows, Index most_own, Index levels);
  // A solve of these rows begins. Without `proof` the answers of quick strategies are believed.
  void start(const RowTable& rows, int max_changes, bool proof);

  struct Answer {
    SolverStatus status = SolverStatus::Solved;
    double residual = 0.0;  // of the optimality conditions
  };
  // Level k with the regularisation rho from x_above, the answer of the levels above. `kept`: the
  // rows that it held in the last solve. Fills `record`; its rows come behind those of held().
  Answer solve(NullspaceBasis& nullspace, int k, double rho, const double* x_above,
               std::span<const KeptRow> kept, LevelRecord& record);

  [[nodiscard]] int changes() const { return budget_.used; }
  [[nodiscard]] int factorizations() const { return factorizations_; }
  [[nodiscard]] const std::vector<HeldRow>& held() const { return held_; }  // by level
  // of the inequality rows at the answer of the last level
  [[nodiscard]] PaddedVector& values() { return candidates_.above; }
  // by how much equality rows of `levels` proven levels moved since, relative to |a| max(1, |x|);
  // `value`: their values now, by dense row
  [[nodiscard]] double moved_since(int levels, const double* value) const {
    return optimality_.moved_since(*rows_, *nullspace_, levels, value) / x_scale_;
  }

 private:
  // ColdByRows: where rounding was taken for a direction of a large level.
  // ExtendedPrecisionWithoutRho: a rho so small that its square is lost in rounding counts as 0
  enum class Strategy {
    WarmStart,
    Cold,
    ColdByRows,
    ExtendedPrecision,
    ExtendedPrecisionWithoutRho
  };

  SolverStatus end(bool done, double residual);
  // where there is nothing to do, or no limit in the way
  bool solve_at_once();
  [[nodiscard]] bool satisfied() const;
  // simple bounds with nothing above: every coordinate by itself
  void solve_first_bounds();
  bool solve_free();
  // the first strategy whose answer proves itself: its worst residual; `done` when it came to an
  // end
  double try_strategies(bool& done);
  [[nodiscard]] bool applies(Strategy strategy) const;
  // Limits of rows above that are nearly parallel may leave a level no way but rounding: then
  // x_above is its answer. The residual of that.
  double residual_of_staying();
  bool solve_by(Strategy strategy);
  bool solve_warm();
  bool solve_cold();
  bool solve_in_extended_precision(double rho);
  // rho is large enough for the least-distance form
  [[nodiscard]] bool regularized() const { return rho_ >= tolerance::kSmall * problem_.own_norm(); }
  // to the working set of the level with the regularisation `epsilon`, from x_above
  bool find_working_set(double epsilon);
  // without the least-distance form: from the rows of the last solve, or those that the active set
  // holds
  bool solve_unregularized();
  bool solve_unregularized_from(double epsilon);

  // forgets what a strategy left behind
  void forget();
  void take(const double* x) { std::copy_n(x, rows_->stride(), x_); }
  // the record of the level, and its proof: the worst residual; multipliers are not sought anew for
  // a point that was not finished
  double prove(Strategy strategy, double rho, bool done = true);
  // Multipliers sought anew, where those that the strategy found prove nothing: after a warm start
  // those of the step, in the basis; else all, in long double.
  double prove_step(double residual);
  double prove_anew(double residual);
  // the rows that are held -> the record
  void list_held();
  // no proof was asked for, and the strategy is usually right
  [[nodiscard]] bool believed(Strategy strategy) const {
    return !proof_ && strategy < Strategy::ExtendedPrecision;
  }
  // by how much rows above moved or got worse, relative to |a| |x|
  double harm_above();

  const RowTable* rows_ = nullptr;
  Candidates candidates_;
  LevelProblem problem_;
  WarmStart warm_start_;
  ActiveSet active_set_;
  UnregularizedActiveSet unregularized_;
  ExtendedPrecisionActiveSet extended_precision_;
  Optimality optimality_;
  Certificate certificate_;
  StepMultipliers step_multipliers_;
  Budget budget_;
  std::vector<HeldRow> held_;
  std::vector<KeptRow> found_;  // by the active set, for the unregularised one
  int factorizations_ = 0;
  bool proof_ = true;

  // the level
  NullspaceBasis* nullspace_ = nullptr;
  int level_ = 0;
  double rho_ = 0.0;
  const double* x_above_ = nullptr;
  std::span<const KeptRow> kept_;
  LevelRecord* record_ = nullptr;
  double* x_ = nullptr;       // its answer, in the record
  double above_scale_ = 1.0;  // max(1, |x_above|)
  double x_scale_ = 1.0;      // max(1, |x|), of the last answer that was looked at
  std::size_t begin_held_ = 0;
  int begin_norm_ = 0;
  bool values_known_ = false;  // candidates_.value belongs to x_
};

}  // namespace hurcules

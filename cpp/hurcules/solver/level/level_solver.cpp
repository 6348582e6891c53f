#include "hurcules/solver/level/level_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/kernels/kernels.hpp"

namespace hurcules {

void LevelSolver::reserve(Index unknowns, Index rows, Index most_own, Index levels) {
  candidates_.reserve(rows + 4 * levels);
  problem_.reserve(unknowns, rows, most_own);
  warm_start_.reserve(unknowns, rows, most_own);
  active_set_.reserve(unknowns, rows, most_own);
  unregularized_.reserve(unknowns, rows);
  extended_precision_.reserve(unknowns, rows);
  optimality_.reserve(unknowns, rows);
  certificate_.reserve(unknowns, rows);
  step_multipliers_.reserve(unknowns, rows);
  // every level may hold every row, once for its violation and once for its smallest step
  held_.reserve(2 * (levels + 1) * rows);  // ... and the last one what was sought anew
  found_.reserve(rows);
}

void LevelSolver::start(const RowTable& rows, int max_changes, bool proof) {
  rows_ = &rows;
  proof_ = proof;
  budget_ = {.used = 0, .most = max_changes};
  factorizations_ = 0;
  held_.clear();
  x_scale_ = 1.0;
  candidates_.start(rows);
}

LevelSolver::Answer LevelSolver::solve(NullspaceBasis& nullspace, int k, double rho,
                                       const double* x_above, std::span<const KeptRow> kept,
                                       LevelRecord& record) {
  nullspace_ = &nullspace;
  level_ = k;
  rho_ = rho;
  x_above_ = x_above;
  kept_ = kept;
  record_ = &record;
  x_ = record.x.data();
  above_scale_ = x_scale_;
  problem_.start(*rows_, nullspace, k, x_above);
  candidates_.open(*rows_, k, x_above);
  begin_held_ = held_.size();
  forget();
  if (rows_->begin(k) < rows_->begin(k + 1)) ++factorizations_;
  bool done = true;
  double residual = 0.0;
  const bool at_once = solve_at_once();
  if (at_once) residual = prove(Strategy::WarmStart, rho);
  if (!at_once || residual > tolerance::kProven) residual = try_strategies(done);
  const SolverStatus status = end(done, residual);
  active_set_.clear();
  candidates_.close(*rows_, k, x_scale_, held_.size() > begin_held_);
  return {status, residual};
}

SolverStatus LevelSolver::end(bool done, double residual) {
  if (!std::isfinite(residual) || !std::isfinite(x_scale_)) {
    forget();
    take(x_above_);
    prove(Strategy::ExtendedPrecision, 0.0, false);
    x_scale_ = std::max(1.0, kernels::chosen->largest(rows_->stride(), x_));
    return SolverStatus::LostPrecision;
  }
  if (!done) {
    // what was reached on the way counts only where it keeps the levels above
    if (harm_above() > tolerance::kBroken) {
      forget();
      take(x_above_);
      prove(Strategy::ExtendedPrecision, rho_, false);
    }
    return SolverStatus::IterationLimit;
  }
  // the proof decides, whatever the strategy thought of itself
  return residual > tolerance::kProven ? SolverStatus::ReducedAccuracy : SolverStatus::Solved;
}

bool LevelSolver::solve_at_once() {
  if (satisfied()) {
    take(x_above_);
    return true;
  }
  if (rows_->begin(level_) == 0 && (*rows_)[0].bound) {
    solve_first_bounds();
    return true;
  }
  return kept_.empty() && solve_free();
}

bool LevelSolver::satisfied() const {
  return problem_.equalities_met(above_scale_) &&
         !Candidates::violated(*rows_, level_, candidates_.above, above_scale_);
}

void LevelSolver::solve_first_bounds() {
  take(x_above_);
  for (int i = rows_->begin(level_); i < rows_->begin(level_ + 1); ++i) {
    const Row& row = (*rows_)[i];
    double& x = x_[row.row];
    if (x >= row.lower && x <= row.upper) continue;
    const Side side = x < row.lower ? Side::Lower : Side::Upper;
    x = side == Side::Lower ? row.lower : row.upper;
    held_.push_back({i, side, std::abs(x), Role::SmallestStep});  // t + nu side a = 0
  }
}

bool LevelSolver::solve_free() {
  active_set_.start(*rows_, problem_, candidates_, rho_, x_above_, above_scale_);
  if (!active_set_.free_is_feasible()) return false;
  take(active_set_.x_free());
  values_known_ = true;
  return true;
}

double LevelSolver::try_strategies(bool& done) {
  double residual = 0.0, harm = 0.0;
  const auto go = [&](Strategy strategy) {
    forget();
    done = solve_by(strategy);
    // what a quick strategy left unfinished needs no proof, and one is sought for long
    if (!done && (strategy == Strategy::WarmStart ||
                  (strategy < Strategy::ExtendedPrecision && !budget_.spent()))) {
      return false;
    }
    residual = prove(strategy, rho_, done);
    harm = believed(strategy) ? 0.0 : harm_above();
    residual = std::max(residual, harm);
    return done && residual <= tolerance::kProven;
  };
  // what is nearest to proven, and moves the rows above least: where nothing is better
  Strategy best = Strategy::ExtendedPrecision, last = best;
  double least = std::numeric_limits<double>::infinity();
  for (const Strategy strategy :
       {Strategy::WarmStart, Strategy::Cold, Strategy::ColdByRows, Strategy::ExtendedPrecision,
        Strategy::ExtendedPrecisionWithoutRho}) {
    if (!applies(strategy)) continue;
    if (strategy == Strategy::ColdByRows && least <= tolerance::kProven) continue;
    if (strategy == Strategy::ExtendedPrecision) {
      const double staying = residual_of_staying();
      done = true;
      if (staying <= tolerance::kProven) return staying;
    }
    const bool proven = go(last = strategy);
    if (strategy > Strategy::WarmStart && budget_.spent()) return residual;
    if (proven && (harm <= tolerance::kHarm || strategy >= Strategy::ExtendedPrecision)) {
      return residual;
    }
    if (!done || !(residual < least)) continue;
    best = strategy;
    least = residual;
  }
  if (best != last) go(best);
  return residual;
}

bool LevelSolver::applies(Strategy strategy) const {
  if (strategy == Strategy::WarmStart) return !kept_.empty();
  if (strategy == Strategy::ColdByRows) return rho_ == 0.0 && unregularized_.large();
  if (strategy != Strategy::ExtendedPrecisionWithoutRho) return true;
  return rho_ > 0.0 && rho_ <= tolerance::kTiny * problem_.own_norm();
}

double LevelSolver::residual_of_staying() {
  forget();
  take(x_above_);
  return prove(Strategy::ExtendedPrecision, rho_);
}

bool LevelSolver::solve_by(Strategy strategy) {
  nullspace_->complete(*rows_);
  unregularized_.go_by_rows(strategy == Strategy::ColdByRows);
  switch (strategy) {
    case Strategy::WarmStart:
      return regularized() ? solve_warm() : solve_unregularized();
    case Strategy::Cold:
    case Strategy::ColdByRows:
      return solve_cold();
    case Strategy::ExtendedPrecision:
      return solve_in_extended_precision(rho_);
    case Strategy::ExtendedPrecisionWithoutRho:
      return solve_in_extended_precision(0.0);
  }
  return false;
}

bool LevelSolver::solve_warm() {
  if (!warm_start_.solve(*rows_, problem_, candidates_, rho_, above_scale_, kept_, x_)) {
    return false;
  }
  warm_start_.keep(rho_ * rho_, held_);
  begin_norm_ = static_cast<int>(held_.size());
  return values_known_ = true;
}

bool LevelSolver::solve_cold() {
  if (!regularized() && problem_.own_norm() == 0.0) {
    take(x_above_);
    return true;
  }
  const double epsilon =
      regularized() ? rho_ : std::max(rho_, tolerance::kProximal * problem_.own_norm());
  if (!find_working_set(epsilon)) {
    take(active_set_.x_feasible());
    return false;
  }
  if (!regularized()) return solve_unregularized_from(epsilon);
  active_set_.refine();
  take(active_set_.x());
  values_known_ = true;
  for (const ActiveSlot& slot : active_set_.slots()) {
    held_.push_back({slot.row, slot.side, rho_ * rho_ * slot.multiplier, Role::Violation});
  }
  begin_norm_ = static_cast<int>(held_.size());
  return true;
}

bool LevelSolver::find_working_set(double epsilon) {
  active_set_.start(*rows_, problem_, candidates_, epsilon, x_above_, above_scale_);
  // it ends where steps of length zero might repeat a set
  return active_set_.primal(budget_, static_cast<int>(3 * (rows_->unknowns() + rows_->size())));
}

bool LevelSolver::solve_unregularized() {
  unregularized_.start(*rows_, *nullspace_, problem_, candidates_, x_above_, x_above_,
                       above_scale_);
  for (const KeptRow& row : kept_) unregularized_.hold(row.row, row.side, row.role);
  return unregularized_.solve(rho_, budget_, x_, held_, begin_norm_);
}

bool LevelSolver::solve_unregularized_from(double epsilon) {
  double largest = 0.0;
  const double scale = epsilon * epsilon;
  for (const ActiveSlot& slot : active_set_.slots()) {
    largest = std::max(largest, scale * slot.multiplier);
  }
  const double least = problem_.least_settling(largest, above_scale_);
  found_.clear();
  for (const ActiveSlot& slot : active_set_.slots()) {
    const bool settles = scale * slot.multiplier > least || problem_.has_slack((*rows_)[slot.row]);
    found_.push_back({0, slot.row, slot.side, settles ? Role::Violation : Role::SmallestStep});
  }
  ++factorizations_;
  active_set_.clear();
  unregularized_.start(*rows_, *nullspace_, problem_, candidates_, x_above_, active_set_.x(),
                       above_scale_);
  for (const KeptRow& row : found_) unregularized_.hold(row.row, row.side, row.role);
  return unregularized_.solve(rho_, budget_, x_, held_, begin_norm_);
}

bool LevelSolver::solve_in_extended_precision(double rho) {
  ++factorizations_;
  extended_precision_.start(*rows_, *nullspace_, problem_, x_above_, above_scale_);
  return extended_precision_.solve(rho, budget_, x_, held_, begin_norm_);
}

void LevelSolver::forget() {
  active_set_.clear();
  held_.resize(begin_held_);
  begin_norm_ = static_cast<int>(begin_held_);
  values_known_ = false;
}

double LevelSolver::prove(Strategy strategy, double rho, bool done) {
  record_->rho = rho;
  record_->own_norm = problem_.own_norm();
  list_held();
  if (!values_known_) rows_->values(level_ + 1, x_, candidates_.value.data());
  values_known_ = true;
  x_scale_ = kernels::chosen->largest(rows_->stride(), x_);
  if (!(x_scale_ > 1.0) && x_scale_ == x_scale_) x_scale_ = 1.0;
  if (believed(strategy)) return 0.0 * x_scale_;  // NaN where x is
  const double residual = optimality_.residual(*rows_, *nullspace_, candidates_, level_, x_above_,
                                               x_scale_, *record_, held_);
  if (residual <= tolerance::kProven || !done) return residual;
  // where it is not the multipliers there is nothing to gain; behind a smooth transition only
  // combinations of rows above hold x
  if (!std::isfinite(residual) || record_->worsened > tolerance::kProven ||
      !nullspace_->weighted_basis().whole()) {
    return residual;
  }
  // A cold start is sooner done than all multipliers sought anew. In double they tell no weak row
  // from rounding, so that they prove only a set that was proven before.
  return strategy == Strategy::WarmStart ? prove_step(residual) : prove_anew(residual);
}

double LevelSolver::prove_step(double residual) {
  nullspace_->complete(*rows_);
  const std::size_t end = held_.size();
  if (static_cast<std::size_t>(begin_norm_) == end ||
      !step_multipliers_.find(
          {*rows_, *nullspace_, candidates_, level_, x_above_, x_scale_, *record_}, held_)) {
    return residual;
  }
  // in front of those that the strategy found
  record_->norm = static_cast<int>(held_.size() - end);
  const auto begin = held_.begin() + begin_norm_;
  const auto found = std::rotate(begin, held_.begin() + end, held_.end());
  const double anew = optimality_.residual(*rows_, *nullspace_, candidates_, level_, x_above_,
                                           x_scale_, *record_, held_);
  const bool better = anew < residual;
  better ? held_.erase(found, held_.end()) : held_.erase(begin, found);
  list_held();
  return better ? anew : residual;
}

double LevelSolver::prove_anew(double residual) {
  const double anew = std::max(record_->worsened, certificate_.find(*rows_, *nullspace_, level_,
                                                                    x_above_, x_scale_, *record_));
  if (!(anew < residual)) return residual;
  held_.resize(begin_held_);
  certificate_.keep(held_, begin_norm_);
  list_held();
  return anew;
}

void LevelSolver::list_held() {
  record_->first_held = static_cast<int>(begin_held_);
  record_->held = begin_norm_ - record_->first_held;
  record_->first_norm = begin_norm_;
  record_->norm = static_cast<int>(held_.size()) - begin_norm_;
}

double LevelSolver::harm_above() {
  // where every equality row above has a direction of its own, a step along the others moves none
  const bool apart = nullspace_->weighted_basis().whole() &&
                     nullspace_->rank_before(level_) == rows_->equalities(level_);
  const double moved =
      apart ? 0.0 : optimality_.moved(*rows_, *nullspace_, level_, x_above_, x_) / x_scale_;
  // without a proof nobody has looked yet
  const double worse =
      proof_ ? record_->worsened : optimality_.worsened(*rows_, candidates_, level_) / x_scale_;
  return std::max(moved, worse);
}

}  // namespace hurcules

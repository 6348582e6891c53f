#include "hurcules/solver/lexicographic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

Index count_rows(HierarchyView hierarchy) {
  Index rows = 0;
  for (const LevelView& level : hierarchy) rows += level.rows();
  return rows;
}

Index most_rows(HierarchyView hierarchy) {
  Index rows = 0;
  for (const LevelView& level : hierarchy) rows = std::max(rows, level.rows());
  return rows;
}

}  // namespace

Lexicographic::Lexicographic(Index unknowns, const SolverOptions& options)
    : unknowns_(unknowns), options_(options) {
  solution_.x.setZero(unknowns);
  zero_.reserve(padded(unknowns));
  // a hierarchy without levels is solved, too
  reserve(HierarchyView());
}

bool Lexicographic::fits(HierarchyView hierarchy) const {
  if (hierarchy.size() > reserved_levels_ || count_rows(hierarchy) > reserved_rows_ ||
      most_rows(hierarchy) > reserved_own_) {
    return false;
  }
  if (solution_.violations.size() != hierarchy.size()) return false;
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    if (solution_.violations[k].size() != hierarchy[k].rows()) return false;
  }
  return true;
}

void Lexicographic::reserve(HierarchyView hierarchy) {
  reserved_rows_ = std::max(reserved_rows_, count_rows(hierarchy));
  reserved_own_ = std::max(reserved_own_, most_rows(hierarchy));
  reserved_levels_ = std::max({reserved_levels_, hierarchy.size(), std::size_t{1}});
  const Index levels = static_cast<Index>(reserved_levels_);
  rows_.reserve(unknowns_, reserved_rows_, levels);
  chains_.reserve(unknowns_, reserved_rows_, levels, options_.handover == Handover::Smooth);
  if (uses_svd()) svd_.reserve(unknowns_, reserved_own_);
  candidates_.reserve(reserved_rows_ + 4 * levels);
  problem_.reserve(unknowns_, reserved_rows_, reserved_own_);
  kept_level_.reserve(unknowns_, reserved_rows_, reserved_own_);
  active_set_.reserve(unknowns_, reserved_rows_, reserved_own_);
  settled_level_.reserve(unknowns_, reserved_rows_);
  careful_level_.reserve(unknowns_, reserved_rows_);
  optimality_.reserve(unknowns_, reserved_rows_);
  certificate_.reserve(unknowns_, reserved_rows_);
  records_.resize(reserved_levels_);
  for (LevelRecord& record : records_) record.x.reserve(padded(unknowns_));
  // every level may hold every row, once for its violation and once for its smallest step
  held_.reserve(2 * reserved_levels_ * reserved_rows_);
  kept_.reserve(2 * reserved_levels_ * reserved_rows_);
  kept_begin_.reserve(reserved_levels_ + 1);
  found_.reserve(reserved_rows_);
  solution_.working_set.reserve(2 * reserved_levels_ * reserved_rows_);
  equality_values_.reserve(reserved_rows_ + 4);
  listed_.resize(reserved_rows_);
  solution_.violations.resize(hierarchy.size());
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    solution_.violations[k].setZero(hierarchy[k].rows());
  }
}

void Lexicographic::reset() {
  kept_.clear();
  std::fill(kept_begin_.begin(), kept_begin_.end(), 0);
}

const Solution& Lexicographic::solve(HierarchyView hierarchy) {
  if (!fits(hierarchy)) reserve(hierarchy);
  held_.clear();
  solution_.status = SolverStatus::Solved;
  solution_.factorizations = solution_.final_levels = 0;
  solution_.optimality = 0.0;
  budget_ = {.used = 0, .most = options_.max_changes};
  if (!rows_.read(hierarchy)) return refuse();
  check_kept();
  x_above_ = x_ = zero_.data();
  x_scale_ = 1.0;
  chains_.start(rows_, hierarchy);
  chain_ = &chains_.of(0);
  candidates_.start(rows_);
  for (int k = 0; k < rows_.levels(); ++k) records_[k].asked_rho = hierarchy[k].rho;
  for (int k = 0; k < rows_.levels(); ++k) {
    x_ = records_[k].x.data();
    above_scale_ = x_scale_;
    chain_ = &chains_.of(k);
    if (uses_svd()) svd_.start(rows_, *chain_, k);
    const bool done = solve_level(hierarchy[k], k);
    active_set_.clear();
    candidates_.close(rows_, k, x_scale_, held_.size() > begin_held_);
    if (!done) break;
    ++solution_.final_levels;
    chains_.close(rows_, svd_, k);
    x_above_ = x_;
  }
  keep_working_sets();
  fill_solution();
  if (!options_.proof) solution_.optimality = std::numeric_limits<double>::quiet_NaN();
  return solution_;
}

bool Lexicographic::solve_level(const LevelView& level, int k) {
  problem_.start(rows_, *chain_, k, x_above_);
  candidates_.open(rows_, k, x_above_);
  begin_held_ = held_.size();
  start_way();
  if (level.rows() > 0) ++solution_.factorizations;
  const double rho = regularization(level.rho, k);
  bool done = true;
  double residual = 0.0;
  const bool at_once = solve_at_once(level, rho, k);
  if (at_once) residual = prove(Way::Warm, rho, k);
  if (!at_once || residual > tolerance::kProven) residual = try_ways(rho, k, done);
  solution_.optimality = std::max(solution_.optimality, residual);
  if (!std::isfinite(residual) || !std::isfinite(x_scale_)) {
    lose_precision(k);
    return false;
  }
  if (!done) {
    solution_.status = SolverStatus::IterationLimit;
    // what was reached on the way counts only where it keeps the levels above
    if (harm_above(k) > tolerance::kBroken) {
      start_way();
      take(x_above_);
      prove(Way::Careful, rho, k);
    }
  } else if (residual > tolerance::kProven && solution_.status == SolverStatus::Solved) {
    // the proof decides, whatever the way thought of itself
    solution_.status = SolverStatus::ReducedAccuracy;
  }
  return done;
}

bool Lexicographic::solve_at_once(const LevelView& level, double rho, int k) {
  if (satisfied(k)) {
    take(x_above_);
    return true;
  }
  if (level.bounds && rows_.begin(k) == 0) {
    solve_first_bounds(k);
    return true;
  }
  return !has_kept(k) && solve_free(rho);
}

double Lexicographic::regularization(double rho, int k) {
  const bool constant = options_.regularization == Regularization::Constant ||
                        rows_.equalities(k) == rows_.equalities(k + 1);
  if (constant || rho == 0.0) return rho;
  const double threshold = options_.singular_threshold;
  if (svd_.regular(threshold)) return 0.0;
  const double ratio = std::min(1.0, svd_.smallest() / threshold);
  return rho * std::sqrt((1.0 - ratio) * (1.0 + ratio));
}

bool Lexicographic::believed(Way way) const {
  return !options_.proof && way < Way::Careful;
}

double Lexicographic::harm_above(int k) {
  // where every equality row above has a direction of its own, a step along the others moves none
  const bool apart = chain_->basis().whole() && chain_->rank_before(k) == rows_.equalities(k);
  const double moved = apart ? 0.0 : optimality_.moved(rows_, *chain_, k, x_above_, x_) / x_scale_;
  // without a proof nobody has looked yet
  const double worse = options_.proof ? records_[k].worsened
                                      : optimality_.worsened(rows_, candidates_, k) / x_scale_;
  return std::max(moved, worse);
}

double Lexicographic::try_ways(double rho, int k, bool& done) {
  double residual = 0.0, harm = 0.0;
  bool proven = false;
  const auto go = [&](Way way) {
    start_way();
    done = solve(way, rho, k);
    proven = false;
    // what a quick way left unfinished needs no proof, and one is sought for long
    if (!done && (way == Way::Warm || (way == Way::Cold && !budget_.spent()))) return;
    residual = prove(way, rho, k);
    harm = believed(way) ? 0.0 : harm_above(k);
    residual = std::max(residual, harm);
    proven = done && residual <= tolerance::kProven;
  };
  // what is nearest to proven, and moves the rows above least: where nothing is better
  Way best = Way::Careful, last = best;
  double least = std::numeric_limits<double>::infinity();
  for (const Way way : {Way::Warm, Way::Cold, Way::Careful, Way::CarefulWithoutRho}) {
    if (way == Way::Warm && !has_kept(k)) continue;
    if (way == Way::CarefulWithoutRho &&
        (rho == 0.0 || rho > 1e-8 * problem_.own_norm())) {
      continue;
    }
    if (way == Way::Careful && proven_to_stay(rho, k, residual)) {
      done = true;
      return residual;
    }
    go(last = way);
    if ((way > Way::Warm && budget_.spent()) || (proven && harm <= tolerance::kHarm)) {
      return residual;
    }
    if (way >= Way::Careful && proven) return residual;
    if (!done || !(residual < least)) continue;
    best = way;
    least = residual;
  }
  if (best != last) go(best);
  return residual;
}

bool Lexicographic::proven_to_stay(double rho, int k, double& residual) {
  start_way();
  take(x_above_);
  const double staying = prove(Way::Careful, rho, k);
  if (!(staying <= tolerance::kProven)) return false;
  residual = staying;
  return true;
}

void Lexicographic::start_way() {
  active_set_.clear();
  held_.resize(begin_held_);
  begin_norm_ = static_cast<int>(begin_held_);
  values_known_ = false;
}

void Lexicographic::lose_precision(int k) {
  start_way();
  take(x_above_);
  prove(Way::Careful, 0.0, k);
  solution_.status = SolverStatus::LostPrecision;
  x_scale_ = std::max(1.0, kernels::chosen->largest(rows_.stride(), x_));
}

bool Lexicographic::satisfied(int k) const {
  return problem_.equalities_met(above_scale_) &&
         !Candidates::violated(rows_, k, candidates_.above, above_scale_);
}

void Lexicographic::solve_first_bounds(int k) {
  take(x_above_);
  for (int i = rows_.begin(k); i < rows_.begin(k + 1); ++i) {
    const Row& row = rows_[i];
    double& x = x_[row.row];
    if (x >= row.lower && x <= row.upper) continue;
    const Side side = x < row.lower ? Side::Lower : Side::Upper;
    x = side == Side::Lower ? row.lower : row.upper;
    held_.push_back({i, side, std::abs(x), Role::SmallestStep});  // t + nu side a = 0
  }
}

bool Lexicographic::solve_free(double rho) {
  active_set_.start(rows_, problem_, candidates_, rho, x_above_, above_scale_);
  if (!active_set_.free_is_feasible()) return false;
  take(active_set_.x_free());
  values_known_ = true;
  return true;
}

}  // namespace hurcules

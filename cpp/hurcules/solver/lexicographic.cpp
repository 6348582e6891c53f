#include "hurcules/solver/lexicographic.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

// proximal steps of a level with rho = 0; one to four are usual
constexpr int kMaxProximalSteps = 40;

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
  for (PaddedVector* v : {&x_, &x_above_, &centre_}) v->reserve(padded(unknowns));
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
  reserved_levels_ = std::max(reserved_levels_, hierarchy.size());
  const Index levels = static_cast<Index>(reserved_levels_);
  rows_.reserve(unknowns_, reserved_rows_, levels);
  chain_.reserve(unknowns_, reserved_rows_, levels);
  candidates_.reserve(reserved_rows_ + 4 * levels);
  problem_.reserve(unknowns_, reserved_rows_, reserved_own_);
  active_set_.reserve(unknowns_, reserved_rows_, reserved_own_);
  settled_level_.reserve(unknowns_, reserved_rows_);
  optimality_.reserve(unknowns_, reserved_rows_, levels);
  records_.resize(reserved_levels_);
  for (LevelRecord& record : records_) {
    record.x.reserve(padded(unknowns_));
    record.gradient.reserve(padded(unknowns_));
  }
  // every level may hold every row, once for its violation and once for its smallest step
  held_.reserve(2 * reserved_levels_ * reserved_rows_);
  kept_.reserve(2 * reserved_levels_ * reserved_rows_);
  kept_begin_.reserve(reserved_levels_ + 1);
  solution_.working_set.reserve(2 * reserved_levels_ * reserved_rows_);
  settled_.resize(reserved_rows_);
  listed_.resize(reserved_rows_);
  solution_.violations.resize(hierarchy.size());
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    solution_.violations[k].setZero(hierarchy[k].rows());
  }
}

void Lexicographic::reset() {
  kept_.clear();
}

double Lexicographic::size(const PaddedVector& x) const {
  double largest = 1.0;
  for (Index j = 0; j < rows_.stride(); ++j) largest = std::max(largest, std::abs(x[j]));
  return largest;
}

const Solution& Lexicographic::solve(HierarchyView hierarchy) {
  if (!fits(hierarchy)) reserve(hierarchy);
  held_.clear();
  solution_.status = SolverStatus::Solved;
  solution_.factorizations = solution_.changes = solution_.final_levels = 0;
  solution_.optimality = 0.0;
  if (!rows_.read(hierarchy)) return refuse();
  count_kept();
  std::fill_n(x_.data(), rows_.stride(), 0.0);
  std::fill_n(x_above_.data(), rows_.stride(), 0.0);
  chain_.build(rows_);
  candidates_.start(rows_);
  optimality_.start(rows_);
  for (int k = 0; k < rows_.levels(); ++k) {
    begin_held_ = begin_norm_ = static_cast<int>(held_.size());
    unsettled_ = false;
    const bool ended = !solve_level(hierarchy[k], k);
    if (!std::isfinite(size(x_))) {
      take(x_above_.data());
      held_.resize(begin_held_);
      solution_.status = SolverStatus::LostPrecision;
    }
    finish_level(hierarchy[k].rho, k);
    if (ended || solution_.status == SolverStatus::LostPrecision) break;
    ++solution_.final_levels;
    candidates_.close(rows_, k, x_.data());
    std::copy_n(x_.data(), rows_.stride(), x_above_.data());
  }
  keep_working_sets();
  fill_solution();
  return solution_;
}

bool Lexicographic::satisfied(int k) {
  if (problem_.relative_residual(x_above_.data()) > tolerance::kZeroResidual) return false;
  for (int i = rows_.begin(k); i < rows_.begin(k + 1); ++i) {
    const Row& row = rows_[i];
    if (row.equality) continue;
    const double value = candidates_.value[row.candidate];
    const double allowed = tolerance::kBroken * x_scale_ * row.norm;
    if (value > row.upper + allowed || value < row.lower - allowed) return false;
  }
  return true;
}

bool Lexicographic::solve_level(const LevelView& level, int k) {
  if (level.rows() == 0) return true;
  ++solution_.factorizations;
  x_scale_ = size(x_above_);
  problem_.start(rows_, chain_, k);
  candidates_.open(rows_, k, x_above_.data());
  if (satisfied(k)) return true;
  if (level.bounds && rows_.begin(k) == 0) return solve_first_bounds(k);
  return level.rho > tolerance::kTiny * problem_.own_norm() ? solve_regularized(level.rho, k)
                                                           : solve_unregularized(level.rho, k);
}

bool Lexicographic::solve_first_bounds(int k) {
  for (int i = rows_.begin(k); i < rows_.begin(k + 1); ++i) {
    const Row& row = rows_[i];
    double& x = x_[row.row];
    if (x >= row.lower && x <= row.upper) continue;
    const Side side = x < row.lower ? Side::Lower : Side::Upper;
    x = side == Side::Lower ? row.lower : row.upper;
    held_.push_back({i, side, std::abs(x), Role::SmallestStep});  // t + nu side a = 0
  }
  return true;
}

bool Lexicographic::solve_regularized(double rho, int k) {
  const bool warm = has_kept(k);
  if (warm) chain_.complete(rows_);
  active_set_.start(rows_, problem_, candidates_, rho, x_above_.data(), x_scale_);
  // without limits in the way this is the whole level  [T 3.3.38]
  if (!warm && active_set_.free_is_feasible()) {
    take(active_set_.x());
    return true;
  }
  chain_.complete(rows_);
  const bool done = find_working_set(k, warm);
  if (done) active_set_.refine();
  take(active_set_.x());
  keep_held(rho * rho, Role::Violation);
  begin_norm_ = static_cast<int>(held_.size());
  return done;
}

bool Lexicographic::solve_unregularized(double rho, int k) {
  active_set_.start(rows_, problem_, candidates_, rho, x_above_.data(), x_scale_);
  if (!has_kept(k) && active_set_.free_is_feasible()) {
    take(active_set_.x());
    return true;
  }
  if (problem_.own_norm() == 0.0) return true;
  chain_.complete(rows_);
  if (has_kept(k) && settle_kept(rho, k)) return true;
  const double epsilon = tolerance::kProximal * problem_.own_norm();
  active_set_.start(rows_, problem_, candidates_, epsilon, x_above_.data(), x_scale_);
  if (!find_working_set(k, false)) {
    take(x_above_.data());
    return false;
  }
  if (settle_held(rho, epsilon)) return true;
  active_set_.refine();
  if (!proximal_steps(epsilon)) return false;
  keep_held(epsilon * epsilon, Role::Violation);
  begin_norm_ = static_cast<int>(held_.size());
  return smallest_step(k);
}

bool Lexicographic::settle_kept(double rho, int k) {
  settled_level_.start(rows_, chain_, problem_, candidates_, x_above_.data());
  for (int h = kept_begin_[k]; h < kept_begin_[k + 1]; ++h) {
    const KeptRow& kept = kept_[h];
    const Index c = rows_[kept.row].candidate;
    const double limit =
        kept.side == Side::Upper ? candidates_.upper(c) : candidates_.lower(c);
    settled_level_.plan(kept.row, kept.side, limit, kept.role);
  }
  return settled_level_.solve(rho, x_scale_, x_.data(), held_, begin_norm_);
}

bool Lexicographic::settle_held(double rho, double epsilon) {
  double largest = 0.0;
  const double scale = epsilon * epsilon;
  for (const ActiveSlot& slot : active_set_.slots()) {
    largest = std::max(largest, scale * slot.multiplier);
  }
  const double least = problem_.least_settling(largest, x_scale_);
  settled_level_.start(rows_, chain_, problem_, candidates_, x_above_.data());
  for (const ActiveSlot& slot : active_set_.slots()) {
    const bool settles = scale * slot.multiplier > least || problem_.has_slack(rows_[slot.row]);
    settled_level_.plan(slot.row, slot.side, slot.limit,
                        settles ? Role::Violation : Role::SmallestStep);
  }
  ++solution_.factorizations;
  return settled_level_.solve(rho, x_scale_, x_.data(), held_, begin_norm_);
}

bool Lexicographic::proximal_steps(double epsilon) {
  double last = 0.0;
  std::copy_n(x_above_.data(), rows_.stride(), centre_.data());
  for (int pass = 0; pass < kMaxProximalSteps; ++pass) {
    take(active_set_.x());
    double moved = 0.0;
    for (Index j = 0; j < unknowns_; ++j) moved = std::max(moved, std::abs(x_[j] - centre_[j]));
    const double scale = size(x_);
    std::copy_n(x_.data(), rows_.stride(), centre_.data());
    if (!std::isfinite(moved)) return false;
    if (moved < 1e-11 * scale || (pass > 0 && moved < 1e-8 * scale && moved > 0.5 * last)) {
      return true;
    }
    last = moved;
    // the next pass starts from this one's set
    active_set_.restart(epsilon, centre_.data());
    if (!active_set_.warm() && !find_by_dual()) {
      take(centre_.data());
      return false;
    }
    active_set_.refine();
  }
  unsettled_ = true;
  take(active_set_.x());
  return true;
}

bool Lexicographic::smallest_step(int k) {
  double largest = 0.0;
  for (std::size_t h = begin_held_; h < held_.size(); ++h) {
    largest = std::max(largest, std::abs(held_[h].multiplier));
  }
  const double least = problem_.least_settling(largest, x_scale_);
  active_set_.clear();
  problem_.start_smallest(rows_, chain_, k);
  if (problem_.dimension() == 0) return true;
  active_set_.start_smallest(rows_, problem_, candidates_, x_.data(), x_above_.data(), x_scale_);
  for (std::size_t h = begin_held_; h < held_.size(); ++h) {
    HeldRow& held = held_[h];
    if (held.multiplier > least) {
      active_set_.fix(held.row, held.side);
    } else {
      held.role = Role::Idle;
    }
  }
  ++solution_.factorizations;
  const bool done = active_set_.primal(solution_.changes, options_.max_changes - solution_.changes);
  if (done) active_set_.refine();
  take(active_set_.x());
  keep_held(1.0, Role::SmallestStep);
  return done;
}

bool Lexicographic::find_by_dual() {
  bool raised = false;
  const bool done =
      active_set_.dual(solution_.changes, options_.max_changes - solution_.changes, raised);
  if (!done) solution_.status = SolverStatus::IterationLimit;
  if (raised && solution_.status == SolverStatus::Solved) {
    solution_.status = SolverStatus::ReducedAccuracy;
  }
  return done;
}

bool Lexicographic::find_working_set(int k, bool warm) {
  int& changes = solution_.changes;
  if (warm) {
    for (int h = kept_begin_[k]; h < kept_begin_[k + 1]; ++h) {
      active_set_.plan(kept_[h].row, kept_[h].side);
    }
    return active_set_.warm() || find_by_dual();
  }
  // from the centre, which is feasible and monotone; it hands over where zero steps might cycle
  const int budget = static_cast<int>(3 * (unknowns_ + rows_.size()));
  const int left = options_.max_changes - changes;
  if (active_set_.primal(changes, std::min(budget, left))) return true;
  if (budget >= left) {
    solution_.status = SolverStatus::IterationLimit;
    return false;
  }
  return find_by_dual();
}

void Lexicographic::keep_held(double scale, Role unfixed) {
  for (const ActiveSlot& slot : active_set_.slots()) {
    held_.push_back(
        {slot.row, slot.side, scale * slot.multiplier, slot.fixed ? Role::Idle : unfixed});
  }
}

}  // namespace hurcules

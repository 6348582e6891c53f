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

}  // namespace

Lexicographic::Lexicographic(Index unknowns, const SolverOptions& options)
    : unknowns_(unknowns), options_(options) {
  for (Vector* v : {&x_, &x_above_, &centre_, &solution_.x}) v->setZero(unknowns);
}

bool Lexicographic::fits(HierarchyView hierarchy) const {
  if (hierarchy.size() > reserved_levels_ || count_rows(hierarchy) > reserved_rows_) return false;
  if (solution_.violations.size() != hierarchy.size()) return false;
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    if (solution_.violations[k].size() != hierarchy[k].rows()) return false;
  }
  return true;
}

void Lexicographic::reserve(HierarchyView hierarchy) {
  reserved_rows_ = std::max(reserved_rows_, count_rows(hierarchy));
  reserved_levels_ = std::max(reserved_levels_, hierarchy.size());
  rows_.reserve(reserved_rows_, reserved_levels_);
  chain_.reserve(unknowns_, reserved_rows_ + 1, reserved_levels_);
  problem_.reserve(unknowns_, reserved_rows_);
  settled_level_.reserve(unknowns_, reserved_rows_);
  optimality_.reserve(unknowns_);
  records_.resize(reserved_levels_);
  for (LevelRecord& record : records_) {
    record.x.resize(unknowns_);
    record.gradient.resize(unknowns_);
  }
  // every level may hold every row, once for its violation and once for its smallest step
  held_.reserve(2 * reserved_levels_ * reserved_rows_);
  kept_.reserve(2 * reserved_levels_ * reserved_rows_);
  previous_.reserve(reserved_rows_ + unknowns_);
  solution_.working_set.reserve(2 * reserved_levels_ * reserved_rows_);
  settled_.resize(reserved_rows_);
  solution_.violations.resize(hierarchy.size());
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    solution_.violations[k].setZero(hierarchy[k].rows());
  }
}

void Lexicographic::reset() {
  kept_.clear();
}

const Solution& Lexicographic::solve(HierarchyView hierarchy) {
  if (!fits(hierarchy)) reserve(hierarchy);
  held_.clear();
  solution_.status = SolverStatus::Solved;
  solution_.factorizations = solution_.changes = solution_.final_levels = 0;
  solution_.optimality = 0.0;
  x_.setZero();
  x_above_.setZero();
  if (!rows_.read(hierarchy, unknowns_)) return refuse();
  if (!rows_.same_pattern()) kept_.clear();
  chain_.build(rows_);
  for (int k = 0; k < rows_.levels(); ++k) {
    begin_held_ = begin_norm_ = static_cast<int>(held_.size());
    unsettled_ = false;
    const bool ended = !solve_level(hierarchy[k], k);
    if (!x_.allFinite()) {
      x_ = x_above_;
      held_.resize(begin_held_);
      solution_.status = SolverStatus::LostPrecision;
    }
    finish_level(hierarchy[k].rho, k);
    if (ended || solution_.status == SolverStatus::LostPrecision) break;
    ++solution_.final_levels;
    x_above_ = x_;
  }
  keep_working_sets();
  fill_solution();
  return solution_;
}

bool Lexicographic::solve_level(const LevelView& level, int k) {
  if (level.rows() == 0) return true;
  ++solution_.factorizations;
  problem_.start(rows_, chain_, k, x_above_);
  if (problem_.satisfied()) return true;
  if (level.bounds && rows_.begin(k) == 0) return solve_first_bounds(k);
  return level.rho > 0.0 ? solve_regularized(level.rho, k) : solve_unregularized(k);
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
  // without limits in the way this is the whole level  [T 3.3.38]
  problem_.solve_free(rows_, chain_, rho, x_above_, x_);
  if (!problem_.breaks(rows_, x_)) return true;
  chain_.complete(rows_);
  problem_.fill(rows_, chain_, rho, x_above_);
  collect_kept(k);
  const bool done = find_working_set();
  if (!done && !problem_.distance.feasible()) {
    x_ = x_above_;
    return false;
  }
  problem_.read_x(chain_, x_);
  problem_.refine(rows_, chain_, x_);
  keep_held(rho * rho, Role::Violation);
  begin_norm_ = static_cast<int>(held_.size());
  return done;
}

bool Lexicographic::solve_unregularized(int k) {
  problem_.solve_free(rows_, chain_, 0.0, x_above_, x_);
  if (!problem_.breaks(rows_, x_)) return true;
  if (problem_.own_norm() == 0.0) {
    x_ = x_above_;
    return true;
  }
  if (has_kept(k) &&
      settled_level_.solve(rows_, problem_, k, x_above_, kept_, x_, held_, begin_norm_)) {
    return true;
  }
  chain_.complete(rows_);
  const double epsilon = tolerance::kProximal * problem_.own_norm();
  if (!proximal_steps(epsilon, k)) return false;
  keep_held(epsilon * epsilon, Role::Violation);
  begin_norm_ = static_cast<int>(held_.size());
  return smallest_step();
}

bool Lexicographic::proximal_steps(double epsilon, int k) {
  collect_kept(k);
  centre_ = x_above_;
  double last = 0.0;
  for (int pass = 0; pass < kMaxProximalSteps; ++pass) {
    problem_.fill(rows_, chain_, epsilon, centre_);
    if (!find_working_set()) {
      x_ = centre_;
      return false;
    }
    problem_.read_x(chain_, x_);
    problem_.refine(rows_, chain_, x_);
    const double moved = (x_ - centre_).lpNorm<Eigen::Infinity>();
    const double scale = std::max(1.0, x_.lpNorm<Eigen::Infinity>());
    centre_ = x_;
    if (moved < 1e-11 * scale || (pass > 0 && moved < 1e-8 * scale && moved > 0.5 * last))
      return true;
    if (!std::isfinite(moved)) return false;
    last = moved;
    // the next pass starts from this one's set
    previous_.assign(problem_.distance.active().begin(), problem_.distance.active().end());
  }
  unsettled_ = true;
  return true;
}

bool Lexicographic::smallest_step() {
  double largest = 0.0;
  for (std::size_t h = begin_held_; h < held_.size(); ++h) {
    largest = std::max(largest, std::abs(held_[h].multiplier));
  }
  const double least = problem_.least_settling(largest);
  std::fill(settled_.begin(), settled_.end(), 0);
  for (std::size_t h = begin_held_; h < held_.size(); ++h) {
    settled_[held_[h].row] = held_[h].multiplier > least;
    if (!settled_[held_[h].row]) held_[h].role = Role::Idle;
  }
  problem_.fill_minimum_norm(rows_, chain_, x_, x_above_, settled_);
  if (problem_.distance.dimension() == 0) return true;
  ++solution_.factorizations;
  const int budget = options_.max_changes - solution_.changes;
  const bool done = problem_.distance.solve_primal(solution_.changes, budget);
  problem_.read_x(chain_, x_);
  problem_.refine(rows_, chain_, x_);
  keep_held(1.0, Role::SmallestStep);
  return done;
}

bool Lexicographic::has_kept(int k) const {
  return std::any_of(kept_.begin(), kept_.end(),
                     [k](const KeptRow& kept) { return kept.held_by == k; });
}

void Lexicographic::collect_kept(int k) {
  previous_.clear();
  for (const KeptRow& kept : kept_) {
    if (kept.held_by != k) continue;
    previous_.push_back({problem_.candidate(kept.row), kept.side, false, 0.0});
  }
}

bool Lexicographic::find_working_set() {
  LeastDistance& distance = problem_.distance;
  int& changes = solution_.changes;
  bool raised = false, done = false;
  if (!previous_.empty()) {
    distance.clear();
    for (const ActiveSlot& slot : previous_) {
      if (!std::isinf(distance.limit(slot.candidate, slot.side)) &&
          !distance.ignored[slot.candidate]) {
        distance.add(slot.candidate, slot.side);
      }
    }
  } else {
    // from the centre, which is feasible and monotone; it hands over where zero steps might cycle
    const int budget = static_cast<int>(3 * (unknowns_ + distance.candidates()));
    done = distance.solve_primal(changes, std::min(budget, options_.max_changes - changes));
  }
  if (!done) done = distance.solve_dual(changes, options_.max_changes - changes, raised);
  if (!done) solution_.status = SolverStatus::IterationLimit;
  if (raised && solution_.status == SolverStatus::Solved) {
    solution_.status = SolverStatus::ReducedAccuracy;
  }
  return done;
}

void Lexicographic::keep_held(double scale, Role unfixed) {
  for (const ActiveSlot& slot : problem_.distance.active()) {
    const Role role = slot.fixed ? Role::Idle : unfixed;
    held_.push_back({problem_.table_row(slot.candidate), slot.side, scale * slot.multiplier, role});
  }
}

}  // namespace hurcules

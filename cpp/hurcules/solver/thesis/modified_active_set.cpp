#include "hurcules/solver/thesis/modified_active_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

// more rows than any solver holds are no snapshot of one
constexpr Index kMostRows = 1'000'000;

}  // namespace

ModifiedActiveSet::ModifiedActiveSet(Index unknowns, const SolverOptions& options,
                                     const ActiveSetRules& rules)
    : unknowns_(unknowns), options_(options), rules_(rules), decomposition_(rules.factor) {
  for (Vector* v : {&x_, &gradient_, &solution_.x}) v->setZero(unknowns);
}

bool ModifiedActiveSet::fits(HierarchyView hierarchy) const {
  if (solution_.violations.size() != hierarchy.size()) return false;
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    if (solution_.violations[k].size() != hierarchy[k].rows()) return false;
  }
  return true;
}

void ModifiedActiveSet::reserve(HierarchyView hierarchy) {
  const std::size_t levels = hierarchy.size();
  std::vector<Index> level_rows;
  Index rows = 0;
  solution_.violations.resize(levels);
  for (std::size_t k = 0; k < levels; ++k) {
    level_rows.push_back(hierarchy[k].rows());
    solution_.violations[k].setZero(hierarchy[k].rows());
    rows += hierarchy[k].rows();
  }
  reserved_rows_ = rows;
  rows_.reserve(unknowns_, rows, static_cast<Index>(levels));
  decomposition_.reserve(unknowns_, level_rows);
  rho_.resize(levels);
  side_.resize(rows, 0);
  for (std::vector<char>* list : {&best_, &strong_}) list->resize(rows);
  held_.reserve(rows);
  begin_.reserve(levels + 1);
  for (Vector* v : {&value_, &error_, &infeasible_}) v->resize(rows);
  for (Vector* v : {&violation_, &least_, &scale_}) v->resize(static_cast<Index>(levels));
  M_.resize(static_cast<Index>(levels), rows);
  solution_.working_set.reserve(rows);
}

void ModifiedActiveSet::reset() {
  kept_ = false;
}

const Solution& ModifiedActiveSet::solve(HierarchyView hierarchy) {
  if (!fits(hierarchy)) reserve(hierarchy);
  solution_.status = SolverStatus::Solved;
  solution_.factorizations = solution_.changes = solution_.final_levels = 0;
  solution_.optimality = 0.0;
  if (!rows_.read(hierarchy)) return refuse();
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    rho_[k] = rules_.regularized ? hierarchy[k].rho : 0.0;
  }
  const std::size_t rows = rows_.size();
  if (!kept_ || !rows_.same_pattern() || side_.size() != rows) side_.assign(rows, 0);
  best_.assign(rows, 0);
  strong_.assign(rows, 0);
  least_.setConstant(std::numeric_limits<double>::infinity());
  if (!iterate() && solution_.status == SolverStatus::IterationLimit) {
    std::swap(side_, best_);
    evaluate();
  }
  fill_solution();
  kept_ = solution_.status != SolverStatus::LostPrecision;
  return solution_;
}

bool ModifiedActiveSet::iterate() {
  const int limit = std::min(options_.max_changes, options_.max_iterations - 1);
  for (;;) {
    if (!evaluate()) {
      solution_.status = SolverStatus::LostPrecision;
      begin_.assign(1, 0);  // no multipliers
      return false;
    }
    remember_best();
    const int blocking = blocking_row();
    const Lowest lowest = lowest_multiplier();
    mark_strongly_active();
    const bool drop = blocking < 0 && lowest.row >= 0 && !strong_[lowest.row];
    if (blocking < 0 && !drop) return true;
    if (solution_.changes >= limit) {
      solution_.status = SolverStatus::IterationLimit;
      return false;
    }
    ++solution_.changes;
    const int row = drop ? lowest.row : blocking;
    side_[row] = drop ? 0 : (value_[row] > rows_[row].upper ? 1 : -1);
    strong_[row] = 0;  // S = S within W
  }
}

bool ModifiedActiveSet::evaluate() {
  list_held();
  if (!solve_primal()) return false;
  for (int i = 0; i < rows_.size(); ++i) value_[i] = rows_.dot(i, x_);
  violation_.setZero();
  for (int i = 0; i < rows_.size(); ++i) {
    const double violation = rows_.violation(i, value_[i]);
    violation_[rows_[i].level] += violation * violation;
  }
  solve_dual(rules_.regularization_error);
  return true;
}

void ModifiedActiveSet::list_held() {
  held_.clear();
  begin_.assign(1, 0);
  for (int k = 0; k < rows_.levels(); ++k) {
    for (int i = rows_.begin(k); i < rows_.begin(k + 1); ++i) {
      const Row& row = rows_[i];
      if (row.equality) {
        held_.push_back({i, 1.0, row.upper});
        continue;
      }
      const double target = side_[i] > 0 ? row.upper : -row.lower;
      if (!std::isfinite(target)) side_[i] = 0;  // the side that was held is gone
      if (side_[i]) held_.push_back({i, static_cast<double>(side_[i]), target});
    }
    begin_.push_back(static_cast<int>(held_.size()));
  }
}

std::span<const HeldLimit> ModifiedActiveSet::held(int k) const {
  return std::span(held_).subspan(begin_[k], begin_[k + 1] - begin_[k]);
}

// x_k = x_{k-1} + Y_k S^ U' (y_k - J_k x_{k-1}) level by level, and its errors  [T 3.3.37]
bool ModifiedActiveSet::solve_primal() {
  decomposition_.start();
  x_.setZero();
  for (int k = 0; k < rows_.levels(); ++k) {
    const int first = begin_[k], size = begin_[k + 1] - first;
    decomposition_.add_level(rows_, held(k));
    solution_.factorizations += rows_.begin(k + 1) > rows_.begin(k);
    auto v = infeasible_.segment(first, size), e = error_.segment(first, size);
    for (int i = 0; i < size; ++i) {
      const HeldLimit& h = held_[first + i];
      v[i] = h.target - h.sign * rows_.dot(h.row, x_);
    }
    scale_[k] = size ? v.lpNorm<Eigen::Infinity>() : 0.0;
    gradient_ = x_;  // in case it overflows
    decomposition_.step(k, rho_[k], v, x_);
    if (!x_.allFinite()) {
      x_ = gradient_;
      return false;
    }
    v *= -1.0;  // V V' (J_k x_{k-1} - y_k)  [T 3.3.78]
    for (int i = 0; i < size; ++i) {
      const HeldLimit& h = held_[first + i];
      e[i] = h.sign * rows_.dot(h.row, x_) - h.target;
      scale_[k] = std::max(scale_[k], std::abs(h.target));
    }
  }
  return true;
}

// column k of M: mu_k, then the levels above it from k - 1 to 1  [T 3.4.108], [T 3.4.115]
void ModifiedActiveSet::solve_dual(bool regularization_error) {
  const Vector& own = regularization_error ? error_ : infeasible_;
  for (int k = 0; k < rows_.levels(); ++k) {
    auto mu = multiplier(k);
    gradient_.setZero();
    for (int j = k; j >= 0; --j) {
      const int first = begin_[j], size = begin_[j + 1] - first;
      auto mu_jk = mu.segment(first, size).transpose();
      if (j == k) {
        mu_jk = own.segment(first, size);
      } else {
        decomposition_.multipliers(j, gradient_, mu_jk);
      }
      for (int i = 0; i < size; ++i) {
        rows_.add_to(held_[first + i].row, held_[first + i].sign * mu_jk[i], gradient_);
      }
    }
  }
}

int ModifiedActiveSet::blocking_row() const {
  const double x_scale = std::max(1.0, x_.lpNorm<Eigen::Infinity>());
  int blocking = -1;
  double worst = 0.0;
  for (int i = 0; i < rows_.size(); ++i) {
    const double violation = rows_.violation(i, value_[i]);
    if (rows_[i].equality || violation * side_[i] > 0.0) continue;
    if (std::abs(violation) > std::max(worst, tolerance::kViolated * rows_[i].norm * x_scale)) {
      worst = std::abs(violation);
      blocking = i;
    }
  }
  return blocking;
}

double ModifiedActiveSet::negative_tolerance(int k) const {
  const double largest = begin_[k + 1] ? multiplier(k).lpNorm<Eigen::Infinity>() : 0.0;
  return tolerance::kNegativeMultiplier * largest + tolerance::kDifference * scale_[k];
}

ModifiedActiveSet::Lowest ModifiedActiveSet::lowest_multiplier() const {
  Lowest lowest;
  for (int k = 0; k < rows_.levels(); ++k) {
    const double least = negative_tolerance(k);
    for (int i = 0; i < begin_[k + 1]; ++i) {
      const double mu = M_(k, i);
      if (rows_[held_[i].row].equality || mu >= std::min(lowest.multiplier, -least)) continue;
      lowest = {held_[i].row, mu};
    }
  }
  return lowest;
}

// [T alg. 1, line 12]: positive at any level, in any iteration
void ModifiedActiveSet::mark_strongly_active() {
  for (int k = 0; k < rows_.levels(); ++k) {
    const double least = negative_tolerance(k);
    for (int i = 0; i < begin_[k + 1]; ++i) {
      if (M_(k, i) > least) strong_[held_[i].row] = 1;
    }
  }
}

// the set whose levels are violated least, the highest level first
void ModifiedActiveSet::remember_best() {
  for (int k = 0; k < rows_.levels(); ++k) {
    const double room = tolerance::kLess * std::max(1.0, least_[k]);
    if (violation_[k] > least_[k] + room) return;
    if (violation_[k] < least_[k] - room || std::isinf(least_[k])) break;
    if (k == rows_.levels() - 1) return;
  }
  least_ = violation_;
  best_ = side_;
}

const Solution& ModifiedActiveSet::refuse() {
  solution_.status = SolverStatus::InvalidInput;
  solution_.x.setZero();
  solution_.working_set.clear();
  for (Vector& violation : solution_.violations) violation.setZero();
  held_.clear();
  begin_.assign(1, 0);
  kept_ = false;
  return solution_;
}

// Conditions 3.4.100-107 of level k with mu_k = v_k + u_k, whatever the method decided with:
// stationarity, signs, and rows of its level or above that are violated without being held.
double ModifiedActiveSet::residual(int k) {
  gradient_.setZero();
  const double rho2 = rho_[k] * rho_[k];
  if (rho2 > 0.0) decomposition_.add_projection(k, rho2, x_, gradient_);
  double scale = gradient_.norm(), largest = 0.0, lowest = 0.0;
  for (int i = 0; i < begin_[k + 1]; ++i) {
    const double mu = M_(k, i);
    rows_.add_to(held_[i].row, held_[i].sign * mu, gradient_);  // [T 3.4.103]
    scale += std::abs(mu) * rows_[held_[i].row].norm;
    largest = std::max(largest, std::abs(mu));
    if (!rows_[held_[i].row].equality) lowest = std::min(lowest, mu);  // [T 3.4.104-105]
  }
  double worst = 0.0;
  // multipliers that are rounding balance nothing
  const double least = largest + tolerance::kDifference * scale_[k];
  if (largest > negative_tolerance(k)) worst = gradient_.norm() / scale;
  if (-lowest > negative_tolerance(k)) worst = std::max(worst, -lowest / least);
  const double x_scale = std::max(1.0, x_.lpNorm<Eigen::Infinity>());
  for (int i = 0; i < rows_.begin(k + 1); ++i) {
    const double violation = rows_.violation(i, value_[i]);
    if (rows_[i].equality || rows_[i].norm == 0.0 || violation * side_[i] > 0.0) continue;
    worst = std::max(worst, std::abs(violation) / (rows_[i].norm * x_scale));  // [T 3.4.100-101]
  }
  return worst;
}

void ModifiedActiveSet::fill_solution() {
  solution_.x = x_;
  for (int i = 0; i < rows_.size(); ++i) {
    solution_.violations[rows_[i].level][rows_[i].row] = rows_.violation(i, rows_.dot(i, x_));
  }
  solution_.working_set.clear();
  if (solution_.status == SolverStatus::LostPrecision) {
    solution_.optimality = std::numeric_limits<double>::infinity();
    return;
  }
  prove();
  fill_working_set();
}

// how many levels, from the first on, meet their own conditions
void ModifiedActiveSet::prove() {
  if (!rules_.regularization_error) solve_dual(true);
  bool proven = true;
  for (int k = 0; k < rows_.levels(); ++k) {
    const double worst = residual(k);
    solution_.optimality = std::max(solution_.optimality, worst);
    proven = proven && worst <= tolerance::kProven;
    solution_.final_levels += proven;
  }
  if (!rules_.regularization_error) solve_dual(false);
  if (!proven && solution_.status == SolverStatus::Solved) {
    solution_.status = SolverStatus::ReducedAccuracy;
  }
}

// every inequality row held, under the level with its largest multiplier
void ModifiedActiveSet::fill_working_set() {
  for (int k = 0; k < rows_.levels(); ++k) {
    for (int i = 0; i < begin_[k + 1]; ++i) {
      const Row& row = rows_[held_[i].row];
      if (row.equality) continue;
      Index pushing;
      const double multiplier =
          M_.col(i).segment(row.level, rows_.levels() - row.level).maxCoeff(&pushing);
      if (row.level + pushing != k) continue;
      solution_.working_set.push_back({row.level, row.row,
                                       held_[i].sign > 0.0 ? Side::Upper : Side::Lower, k,
                                       std::max(0.0, multiplier)});
    }
  }
}

std::vector<std::vector<Vector>> ModifiedActiveSet::multipliers() const {
  std::vector<std::vector<Vector>> result(begin_.size() - 1);
  for (int k = 0; k < static_cast<int>(result.size()); ++k) {
    for (int j = 0; j <= k; ++j) {
      result[k].push_back(Vector::Zero(rows_.begin(j + 1) - rows_.begin(j)));
    }
    for (int i = 0; i < begin_[k + 1]; ++i) {
      const Row& row = rows_[held_[i].row];
      result[k][row.level][row.row] = held_[i].sign * M_(k, i);
    }
  }
  return result;
}

void ModifiedActiveSet::save(StateWriter& writer) const {
  rows_.save_pattern(writer);
  writer.put(static_cast<double>(kept_ ? side_.size() : 0));
  if (kept_) {
    for (const char side : side_) writer.put(side);
  }
}

void ModifiedActiveSet::restore(StateReader& reader) {
  rows_.restore_pattern(reader);
  const Index rows = reader.get_count(kMostRows);
  kept_ = rows > 0;
  side_.resize(rows);
  for (char& side : side_) {
    const double value = reader.get();
    side = static_cast<char>(value > 0.0 ? 1 : (value < 0.0 ? -1 : 0));
  }
}

}  // namespace hurcules

// What Algorithm 1 leaves behind: proof, violations, working set, multipliers, snapshot.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/modified_active_set.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

// more rows than any solver holds are no snapshot of one
constexpr Index kMostRows = 1'000'000;

}  // namespace

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

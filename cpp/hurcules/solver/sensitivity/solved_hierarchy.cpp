#include "hurcules/solver/sensitivity/solved_hierarchy.hpp"

#include <algorithm>

#include "hurcules/base/error.hpp"
#include "hurcules/solver/sensitivity/row_space.hpp"

namespace hurcules {

SolvedHierarchy::SolvedHierarchy(const RowTable& rows, std::span<const LevelRecord> records,
                                 std::span<const HeldRow> held, const Solution& solution,
                                 const SingularRules& rules)
    : unknowns_(solution.x.size()),
      status_(solution.status),
      final_levels_(solution.final_levels),
      rules_(rules) {
  if (status_ == SolverStatus::InvalidInput) return;
  numbers_.reserve((final_levels_ + rows.dense_rows()) * unknowns_);
  held_.reserve(held.size());
  levels_.resize(rows.levels());
  for (int k = 0; k < levels(); ++k) {
    SolvedLevel& level = levels_[k];
    level.begin = rows.begin(k);
    level.bounds = rows.begin(k + 1) > level.begin && rows[level.begin].bound;
    level.asked_rho = records[k].asked_rho;
    if (k >= final_levels_) continue;
    const LevelRecord& record = records[k];
    level.rho = record.rho;
    level.first_held = static_cast<int>(held_.size());
    level.held = record.held;
    level.smallest = record.norm;
    const auto first = held.begin() + record.first_held;
    held_.insert(held_.end(), first, first + record.held + record.norm);
    numbers_.insert(numbers_.end(), record.x.data(), record.x.data() + unknowns_);
  }
  rows_.reserve(rows.size());
  for (int i = 0; i < rows.size(); ++i) rows_.push_back(rows[i]);
  for (int d = 0; d < rows.dense_rows(); ++d) {
    numbers_.insert(numbers_.end(), rows.dense_row(d), rows.dense_row(d) + unknowns_);
  }
}

Eigen::Map<const Vector> SolvedHierarchy::stored(Index place) const {
  return {numbers_.data() + place * unknowns_, unknowns_};
}

Vector SolvedHierarchy::dense(int i) const {
  const Row& row = rows_[i];
  if (row.dense < 0) return Vector::Unit(unknowns_, row.row);
  return stored(final_levels_ + row.dense);
}

Vector SolvedHierarchy::x(int k) const {
  if (k < 0) return Vector::Zero(unknowns_);
  return stored(k);
}

std::span<const HeldRow> SolvedHierarchy::held(int k) const {
  return {held_.data() + levels_[k].first_held, static_cast<std::size_t>(levels_[k].held)};
}

std::span<const HeldRow> SolvedHierarchy::smallest_step(int k) const {
  const int first = levels_[k].first_held + levels_[k].held;
  return {held_.data() + first, static_cast<std::size_t>(levels_[k].smallest)};
}

double SolvedHierarchy::violation(int i, const Vector& x) const {
  const Row& row = rows_[i];
  const double value = row.dense < 0 ? x[row.row] : stored(final_levels_ + row.dense).dot(x);
  return value - std::clamp(value, row.lower, row.upper);
}

void require_solved(const SolvedHierarchy* solved) {
  require(solved != nullptr, "only the method 'lexicographic' has sensitivities and level reports");
}

std::vector<std::vector<Vector>> multipliers(const SolvedHierarchy& solved) {
  std::vector<std::vector<Vector>> result(solved.final_levels());
  RowSpace above(solved.unknowns());
  std::vector<int> independent;  // equality rows above, as `above` has them
  for (int k = 0; k < solved.final_levels(); ++k) {
    for (int j = 0; j <= k; ++j) {
      result[k].push_back(Vector::Zero(solved.begin(j + 1) - solved.begin(j)));
    }
    const Vector x = solved.x(k);
    Vector gradient = solved.rho(k) * solved.rho(k) * (x - solved.x(k - 1));
    const auto set = [&](int i, double multiplier) {
      result[k][solved.row(i).level][solved.row(i).row] = multiplier;
      gradient += multiplier * solved.dense(i);
    };
    for (int i = solved.begin(k); i < solved.begin(k + 1); ++i) set(i, solved.violation(i, x));
    for (const HeldRow& held : solved.held(k)) {
      if (solved.row(held.row).level == k) continue;
      set(held.row, static_cast<double>(held.side) * held.multiplier);
    }
    // equality rows above take what is left of the gradient along their directions; behind a
    // rank transition it is no rows above that hold x, only combinations of them
    if (!solved.handed_over() || k < solved.rules().handed_to) {
      const Vector mu = above.solve_transposed(-gradient);
      for (std::size_t e = 0; e < independent.size(); ++e) set(independent[e], mu[e]);
    }
    for (int i = solved.begin(k); i < solved.begin(k + 1); ++i) {
      if (solved.row(i).equality && above.add(solved.dense(i))) independent.push_back(i);
    }
  }
  return result;
}

}  // namespace hurcules

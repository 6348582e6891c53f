#include "hurcules/solver/level/lexicographic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/kernels/kernels.hpp"
#include "hurcules/solver/problem/tolerances.hpp"
#include "hurcules/solver/sensitivity/solved_hierarchy.hpp"

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
  nullspaces_.reserve(unknowns_, reserved_rows_, levels, options_.handover == Handover::Smooth);
  if (uses_svd()) svd_.reserve(unknowns_, reserved_own_);
  level_.reserve(unknowns_, reserved_rows_, reserved_own_, levels);
  kept_.reserve(levels, reserved_rows_);
  records_.resize(reserved_levels_);
  for (LevelRecord& record : records_) record.x.reserve(padded(unknowns_));
  solution_.working_set.reserve(2 * reserved_levels_ * reserved_rows_);
  equality_values_.reserve(reserved_rows_ + 4);
  solution_.violations.resize(hierarchy.size());
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    solution_.violations[k].setZero(hierarchy[k].rows());
  }
}

const Solution& Lexicographic::solve(HierarchyView hierarchy) {
  if (!fits(hierarchy)) reserve(hierarchy);
  solution_.status = SolverStatus::Solved;
  solution_.factorizations = solution_.final_levels = 0;
  solution_.optimality = 0.0;
  if (!rows_.read(hierarchy)) return refuse();
  kept_.check(rows_);
  nullspaces_.start(rows_, hierarchy);
  level_.start(rows_, options_.max_changes, options_.proof);
  const double* x = solve_levels(hierarchy);
  kept_.keep(rows_, records_, level_.held(), solution_.final_levels, solution_.working_set);
  fill_solution(x);
  // a set that proved nothing is no start for the next solve
  if (solution_.status == SolverStatus::ReducedAccuracy) kept_.clear();
  if (!options_.proof) solution_.optimality = std::numeric_limits<double>::quiet_NaN();
  return solution_;
}

const double* Lexicographic::solve_levels(HierarchyView hierarchy) {
  const double* x = zero_.data();
  for (int k = 0; k < rows_.levels(); ++k) records_[k].asked_rho = hierarchy[k].rho;
  for (int k = 0; k < rows_.levels(); ++k) {
    NullspaceBasis& nullspace = nullspaces_.of(k);
    if (uses_svd()) svd_.start(rows_, nullspace, k);
    const double rho = regularization(hierarchy[k].rho, k);
    const LevelSolver::Answer answer = level_.solve(nullspace, k, rho, x, kept_.of(k), records_[k]);
    x = records_[k].x.data();
    solution_.optimality = std::max(solution_.optimality, answer.residual);
    if (answer.status != SolverStatus::Solved) solution_.status = answer.status;
    if (answer.status != SolverStatus::Solved && answer.status != SolverStatus::ReducedAccuracy) {
      break;
    }
    ++solution_.final_levels;
    nullspaces_.close(rows_, svd_, k);
  }
  return x;
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

const Solution& Lexicographic::refuse() {
  solution_.status = SolverStatus::InvalidInput;
  solution_.x.setZero();
  solution_.working_set.clear();
  solution_.changes = 0;
  for (Vector& violation : solution_.violations) violation.setZero();
  reset();
  return solution_;
}

void Lexicographic::fill_solution(const double* x) {
  solution_.x = Eigen::Map<const Vector>(x, unknowns_);
  solution_.changes = level_.changes();
  solution_.factorizations = level_.factorizations();
  // the last level left the values of all inequality rows, unless the solve ended early
  if (solution_.final_levels < rows_.levels()) {
    rows_.values(rows_.levels(), x, level_.values().data());
  }
  kernels::chosen->dots(rows_.dense_row(0), rows_.equalities(), rows_.stride(), x,
                        equality_values_.data());
  for (int k = 0; k < rows_.levels(); ++k) fill_violations(k);
  if (options_.proof && rows_.levels() > 0) check_moved();
}

void Lexicographic::fill_violations(int k) {
  double* violations = solution_.violations[k].data();
  const int first = rows_.begin(k), count = rows_.begin(k + 1) - first;
  if (rows_.equalities(k + 1) - rows_.equalities(k) == count) {
    const double* value = equality_values_.data() + rows_.equalities(k);
    const double* target = rows_.targets() + rows_.equalities(k);
    for (int i = 0; i < count; ++i) violations[i] = value[i] - target[i];
    return;
  }
  for (int i = 0; i < count; ++i) {
    const Row& row = rows_[first + i];
    const double value =
        row.equality ? equality_values_[row.dense] : level_.values()[row.candidate];
    violations[i] = rows_.violation(first + i, value);
  }
}

void Lexicographic::check_moved() {
  const double moved = level_.moved_since(solution_.final_levels, equality_values_.data());
  solution_.optimality = std::max(solution_.optimality, moved);
  if (moved > tolerance::kProven && solution_.status == SolverStatus::Solved) {
    solution_.status = SolverStatus::ReducedAccuracy;
  }
}

std::shared_ptr<const SolvedHierarchy> Lexicographic::solved() const {
  const SingularRules rules = {.handed_to = nullspaces_.handed_to(),
                               .adaptive = options_.regularization == Regularization::Adaptive,
                               .threshold = options_.singular_threshold};
  return std::make_shared<const SolvedHierarchy>(rows_, records_, level_.held(), solution_, rules);
}

std::vector<std::vector<Vector>> Lexicographic::multipliers() const {
  return hurcules::multipliers(*solved());
}

void Lexicographic::save(StateWriter& writer) const {
  rows_.save_pattern(writer);
  kept_.save(writer);
}

void Lexicographic::restore(StateReader& reader) {
  rows_.restore_pattern(reader);
  kept_.restore(reader);
}

}  // namespace hurcules

// What a solve leaves behind: proof, violations, working sets, multipliers, snapshot.
#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels.hpp"
#include "hurcules/solver/lexicographic.hpp"
#include "hurcules/solver/solved_hierarchy.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

// more rows than a solver of kMostUnknowns can hold are no snapshot of one
constexpr Index kMostKept = 1'000'000;

}  // namespace

const Solution& Lexicographic::refuse() {
  solution_.status = SolverStatus::InvalidInput;
  solution_.x.setZero();
  solution_.working_set.clear();
  solution_.changes = 0;
  for (Vector& violation : solution_.violations) violation.setZero();
  reset();
  return solution_;
}

void Lexicographic::list_held(LevelRecord& record) {
  record.first_held = static_cast<int>(begin_held_);
  record.held = begin_norm_ - record.first_held;
  record.first_norm = begin_norm_;
  record.norm = static_cast<int>(held_.size()) - begin_norm_;
}

double Lexicographic::prove(Way way, double rho, int k) {
  LevelRecord& record = records_[k];
  record.rho = rho;
  record.own_norm = problem_.own_norm();
  list_held(record);
  if (!values_known_) rows_.values(k + 1, x_, candidates_.value.data());
  values_known_ = true;
  x_scale_ = kernels::chosen->largest(rows_.stride(), x_);
  if (!(x_scale_ > 1.0) && x_scale_ == x_scale_) x_scale_ = 1.0;
  if (believed(way)) return 0.0 * x_scale_;  // NaN where x is
  const double residual =
      optimality_.residual(rows_, *chain_, candidates_, k, x_above_, x_scale_, record, held_);
  // a cold start is sooner done than multipliers sought anew
  if (residual <= tolerance::kProven || way == Way::Warm) return residual;
  return prove_anew(residual, k);
}

double Lexicographic::prove_anew(double residual, int k) {
  LevelRecord& record = records_[k];
  // where it is not the multipliers there is nothing to gain; behind a hand-over only combinations
  // of rows above hold x
  if (!std::isfinite(residual) || record.worsened > tolerance::kProven ||
      !chain_->basis().whole()) {
    return residual;
  }
  const double anew =
      std::max(record.worsened, certificate_.find(rows_, *chain_, k, x_above_, x_scale_, record));
  if (!(anew < residual)) return residual;
  held_.resize(begin_held_);
  certificate_.keep(held_, begin_norm_);
  list_held(record);
  return anew;
}

void Lexicographic::check_kept() {
  if (rows_.same_pattern() && !restored_) return;
  const int levels = rows_.levels();
  const auto fits = [&](const KeptRow& kept) {
    return kept.held_by < levels && kept.row < rows_.size() && rows_[kept.row].candidate >= 0;
  };
  const auto above = [](const KeptRow& a, const KeptRow& b) { return a.held_by < b.held_by; };
  // a snapshot may hold anything
  if (!rows_.same_pattern() || !std::all_of(kept_.begin(), kept_.end(), fits) ||
      !std::is_sorted(kept_.begin(), kept_.end(), above)) {
    kept_.clear();
  }
  restored_ = false;
  kept_begin_.assign(levels + 1, 0);
  for (const KeptRow& kept : kept_) ++kept_begin_[kept.held_by + 1];
  for (int k = 0; k < levels; ++k) kept_begin_[k + 1] += kept_begin_[k];
}

void Lexicographic::keep_working_sets() {
  kept_.resize(held_.size());
  solution_.working_set.resize(held_.size());
  KeptRow* kept = kept_.data();
  ActiveRow* active = solution_.working_set.data();
  for (int k = 0; k < rows_.levels(); ++k) {
    kept_begin_[k + 1] = static_cast<int>(kept - kept_.data());
    if (k >= solution_.final_levels) continue;
    const LevelRecord& record = records_[k];
    if (record.norm == 0) {
      // without a list of the smallest step every row is listed once
      for (int h = record.first_held; h < record.first_held + record.held; ++h) {
        const HeldRow& held = held_[h];
        const Row& row = rows_[held.row];
        *active++ = {row.level, row.row, held.side, k, held.multiplier};
        *kept++ = {k, held.row, held.side, held.role};
      }
    } else {
      active = list_active(record, k, active);
      kept = keep_roles(record, k, kept);
    }
    kept_begin_[k + 1] = static_cast<int>(kept - kept_.data());
  }
  kept_.resize(kept - kept_.data());
  solution_.working_set.resize(active - solution_.working_set.data());
}

// every row once, with what it does against the violations
ActiveRow* Lexicographic::list_active(const LevelRecord& record, int k, ActiveRow* active) {
  std::fill(listed_.begin(), listed_.end(), 0);
  const int end_held = record.first_held + record.held;
  for (int h = record.first_held; h < record.first_norm + record.norm; ++h) {
    const HeldRow& held = held_[h];
    const Row& row = rows_[held.row];
    if (listed_[held.row]) continue;
    listed_[held.row] = 1;
    *active++ = {row.level, row.row, held.side, k, h < end_held ? held.multiplier : 0.0};
  }
  return active;
}

// a row that has a role is not listed again as idle
KeptRow* Lexicographic::keep_roles(const LevelRecord& record, int k, KeptRow* kept) {
  std::fill(listed_.begin(), listed_.end(), 0);
  for (const bool idle : {false, true}) {
    for (int h = record.first_held; h < record.first_norm + record.norm; ++h) {
      const HeldRow& held = held_[h];
      if (listed_[held.row] || (held.role == Role::Idle) != idle) continue;
      listed_[held.row] = 1;
      *kept++ = {k, held.row, held.side, held.role};
    }
  }
  return kept;
}

void Lexicographic::fill_solution() {
  solution_.x = Eigen::Map<const Vector>(x_, unknowns_);
  solution_.changes = budget_.used;
  // the last level left the values of all candidates above, unless the solve ended early
  if (solution_.final_levels < rows_.levels()) {
    rows_.values(rows_.levels(), x_, candidates_.above.data());
  }
  kernels::chosen->dots(rows_.dense_row(0), rows_.equalities(), rows_.stride(), x_,
                        equality_values_.data());
  for (int k = 0; k < rows_.levels(); ++k) fill_violations(k);
  if (!options_.proof) return;
  const double moved =
      optimality_.moved_since(rows_, *chain_, solution_.final_levels, equality_values_.data()) /
      x_scale_;
  solution_.optimality = std::max(solution_.optimality, moved);
  if (moved > tolerance::kProven && solution_.status == SolverStatus::Solved) {
    solution_.status = SolverStatus::ReducedAccuracy;
  }
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
        row.equality ? equality_values_[row.dense] : candidates_.above[row.candidate];
    violations[i] = rows_.violation(first + i, value);
  }
}

std::shared_ptr<const SolvedHierarchy> Lexicographic::solved() const {
  return std::make_shared<const SolvedHierarchy>(rows_, records_, held_, solution_, rules());
}

SingularRules Lexicographic::rules() const {
  return {.handed_to = chains_.handed_to(),
          .adaptive = options_.regularization == Regularization::Adaptive,
          .threshold = options_.singular_threshold};
}

std::vector<std::vector<Vector>> Lexicographic::multipliers() const {
  return hurcules::multipliers(*solved());
}

void Lexicographic::save(StateWriter& writer) const {
  rows_.save_pattern(writer);
  writer.put(static_cast<double>(kept_.size()));
  for (const KeptRow& kept : kept_) {
    writer.put(kept.held_by);
    writer.put(kept.row);
    writer.put(static_cast<double>(kept.side));
    writer.put(static_cast<double>(kept.role));
  }
}

void Lexicographic::restore(StateReader& reader) {
  rows_.restore_pattern(reader);
  kept_.resize(static_cast<std::size_t>(reader.get_count(kMostKept)));
  for (KeptRow& kept : kept_) {
    kept.held_by = static_cast<int>(reader.get_count(kMostKept));
    kept.row = static_cast<int>(reader.get_count(kMostKept));
    kept.side = reader.get() < 0.0 ? Side::Lower : Side::Upper;
    kept.role = static_cast<Role>(reader.get_count(static_cast<Index>(Role::Idle)));
  }
  restored_ = true;
}

}  // namespace hurcules

// What a solve leaves behind: proof, violations, working sets, multipliers, snapshot.
#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels.hpp"
#include "hurcules/solver/tolerances.hpp"
#include "hurcules/solver/lexicographic.hpp"

namespace hurcules {

namespace {

// more rows than a solver of kMostUnknowns can hold are no snapshot of one
constexpr Index kMostKept = 1'000'000;

}  // namespace

const Solution& Lexicographic::refuse() {
  solution_.status = SolverStatus::InvalidInput;
  solution_.x.setZero();
  solution_.working_set.clear();
  for (Vector& violation : solution_.violations) violation.setZero();
  reset();
  return solution_;
}

void Lexicographic::finish_level(double rho, int k) {
  LevelRecord& record = records_[k];
  record.rho = rho;
  std::copy_n(x_.data(), rows_.stride(), record.x.data());
  record.first_held = begin_held_;
  record.held = begin_norm_ - begin_held_;
  record.first_norm = begin_norm_;
  record.norm = static_cast<int>(held_.size()) - begin_norm_;
  const double residual =
      optimality_.residual(rows_, chain_, k, x_above_.data(), record, held_);
  solution_.optimality = std::max(solution_.optimality, residual);
  // steps that went on for ever may have stood still long before, but for rounding: the proof
  // decides
  if (unsettled_ && residual > tolerance::kProven && solution_.status == SolverStatus::Solved) {
    solution_.status = SolverStatus::ReducedAccuracy;
  }
}

void Lexicographic::count_kept() {
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
  kept_begin_.assign(levels + 1, 0);
  for (const KeptRow& kept : kept_) ++kept_begin_[kept.held_by + 1];
  for (int k = 0; k < levels; ++k) kept_begin_[k + 1] += kept_begin_[k];
}

void Lexicographic::keep_working_sets() {
  kept_.clear();
  for (int k = 0; k < solution_.final_levels; ++k) {
    const LevelRecord& record = records_[k];
    const int end = record.first_norm + record.norm;
    if (record.first_held < end) std::fill(listed_.begin(), listed_.end(), 0);
    // a row that has a role is not listed again as idle
    for (const bool idle : {false, true}) {
      for (int h = record.first_held; h < end; ++h) {
        const HeldRow& held = held_[h];
        if (listed_[held.row] || (held.role == Role::Idle) != idle) continue;
        listed_[held.row] = 1;
        kept_.push_back({k, held.row, held.side, held.role});
      }
    }
  }
}

void Lexicographic::fill_solution() {
  solution_.x = Eigen::Map<const Vector>(x_.data(), unknowns_);
  for (int i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    solution_.violations[row.level][row.row] = rows_.violation(i, rows_.dot(i, x_.data()));
  }
  solution_.working_set.clear();
  for (int k = 0; k < solution_.final_levels; ++k) {
    const LevelRecord& record = records_[k];
    const int end = record.first_norm + record.norm;
    if (record.first_held < end) std::fill(listed_.begin(), listed_.end(), 0);
    for (int h = record.first_held; h < end; ++h) {
      const HeldRow& held = held_[h];
      if (listed_[held.row]) continue;
      listed_[held.row] = 1;
      const Row& row = rows_[held.row];
      const double multiplier = h < record.first_norm ? held.multiplier : 0.0;
      solution_.working_set.push_back({row.level, row.row, held.side, k, multiplier});
    }
  }
}

std::vector<std::vector<Vector>> Lexicographic::multipliers() const {
  std::vector<std::vector<Vector>> result(solution_.final_levels);
  for (int k = 0; k < solution_.final_levels; ++k) {
    const LevelRecord& record = records_[k];
    for (int j = 0; j <= k; ++j) {
      result[k].push_back(Vector::Zero(rows_.begin(j + 1) - rows_.begin(j)));
    }
    for (int i = rows_.begin(k); i < rows_.begin(k + 1); ++i) {
      result[k][k][rows_[i].row] = rows_.violation(i, rows_.dot(i, record.x.data()));
    }
    for (int h = record.first_held; h < record.first_held + record.held; ++h) {
      const Row& row = rows_[held_[h].row];
      if (row.level < k) {
        result[k][row.level][row.row] = static_cast<double>(held_[h].side) * held_[h].multiplier;
      }
    }
    // equality rows above take what the gradient has along their directions: L' mu = -Q g
    const Index rank = chain_.rank_before(k);
    Vector mu(rank);
    for (Index j = rank - 1; j >= 0; --j) {
      double sum =
          -kernels::chosen->dot(rows_.stride(), chain_.direction(j), record.gradient.data());
      for (Index l = j + 1; l < rank; ++l) {
        sum -= chain_.equality_coordinates(chain_.pivot(l))[j] * mu[l];
      }
      mu[j] = sum / chain_.equality_coordinates(chain_.pivot(j))[j];
      const Row& row = rows_[rows_.row_of_dense(static_cast<int>(chain_.pivot(j)))];
      result[k][row.level][row.row] = mu[j];
    }
  }
  return result;
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
}

}  // namespace hurcules

#include "hurcules/solver/level/warm_start.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

constexpr int kMostCorrections = 2;
// a row of which more than this part is left (squared) is clean enough: what orthogonality it costs
// the corrections bring back
constexpr double kClean = 1e-4;

}  // namespace

void WarmStart::reserve(Index unknowns, Index most_rows, Index most_own) {
  const Index width = padded(unknowns) + most_own;
  factor_.reserve(most_rows, width);
  slots_.resize(std::max<std::size_t>(slots_.size(), most_rows));
  y_.reserve(padded(width));
  for (PaddedVector* v : {&norm2_, &g_, &change_, &multiplier_}) v->reserve(most_rows + 4);
}

bool WarmStart::solve(const RowTable& rows, LevelProblem& problem, Candidates& candidates,
                      double rho, double x_scale, std::span<const KeptRow> kept, double* x) {
  rows_ = &rows;
  problem_ = &problem;
  candidates_ = &candidates;
  problem.factor(rho);
  if (static_cast<Index>(kept.size()) > problem.dimension() || !factor(kept) ||
      !find_multipliers()) {
    return false;
  }
  std::fill_n(y_.data(), factor_.stride(), 0.0);
  kernels::chosen->axpys(factor_.direction(0), size_, factor_.stride(), g_.data(), y_.data());
  evaluate(x);
  refine(x_scale, x);
  return none_broken(x_scale);
}

bool WarmStart::factor(std::span<const KeptRow> kept) {
  size_ = static_cast<Index>(kept.size());
  factor_.start(size_, problem_->width());
  for (Index i = 0; i < size_; ++i) {
    const Row& row = (*rows_)[kept[i].row];
    const bool up = kept[i].side == Side::Upper;
    const double sign = up ? 1.0 : -1.0;
    const Index c = row.candidate;
    const double limit = up ? candidates_->upper(c) : candidates_->lower(c);
    if (std::isinf(limit)) return false;
    slots_[i] = {&row, kept[i].row, kept[i].side, limit};
    double* image = factor_.row(i);
    problem_->image(row, sign, image);
    g_[i] = sign * (limit - candidates_->above[c]) - problem_->way_to_free(image);
  }
  kernels::chosen->norms2(factor_.row(0), size_, factor_.stride(), norm2_.data());
  for (Index i = 0; i < size_; ++i) {
    // a row that nothing here can move
    const double least = tolerance::kLost * slots_[i].row->norm;
    if (norm2_[i] <= least * least) return false;
  }
  factor_.run(0, size_, norm2_.data(), tolerance::kDependent, g_.data(), kClean);
  return factor_.rank() == size_;
}

bool WarmStart::find_multipliers() {
  factor_.find_multipliers(g_.data(), multiplier_.data());
  double most = 0.0, least = 0.0;
  for (Index i = 0; i < size_; ++i) {
    most = std::max(most, multiplier_[i]);
    least = std::min(least, multiplier_[i]);
  }
  return least >= -tolerance::kNegativeWarm * most;
}

void WarmStart::evaluate(double* x) {
  problem_->step(y_.data(), x);
  rows_->values(problem_->level() + 1, x, candidates_->value.data());
}

double WarmStart::largest_miss() {
  double worst = 0.0;
  for (Index i = 0; i < size_; ++i) {
    const Slot& slot = slots_[i];
    const double slack =
        problem_->has_slack(*slot.row) ? problem_->slack(*slot.row, y_.data()) : 0.0;
    const double miss = slot.limit - (candidates_->value[slot.row->candidate] + slack);
    change_[i] = slot.side == Side::Upper ? miss : -miss;
    worst = std::max(worst, std::abs(miss));
  }
  return worst;
}

void WarmStart::refine(double x_scale, double* x) {
  for (int pass = 0; pass < kMostCorrections; ++pass) {
    if (largest_miss() <= tolerance::kMiss * x_scale) return;
    factor_.correct(change_.data(), y_.data());
    evaluate(x);
  }
}

bool WarmStart::none_broken(double x_scale) {
  // own rows that are held are beyond their limits, as their slack allows
  for (Index i = 0; problem_->has_slacks() && i < size_; ++i) {
    if (problem_->has_slack(*slots_[i].row)) {
      candidates_->set(slots_[i].row->candidate, -kAbsent, kAbsent);
    }
  }
  const Index count = rows_->candidates(problem_->level() + 1);
  const double excess = kernels::chosen->worst_excess(
      count, candidates_->value.data(), candidates_->limits(*rows_), tolerance::kBroken * x_scale,
      tolerance::kBrokenTarget * problem_->target_size());
  for (Index i = 0; problem_->has_slacks() && i < size_; ++i) {
    const Row& row = *slots_[i].row;
    if (problem_->has_slack(row)) candidates_->set(row.candidate, row.lower, row.upper);
  }
  return !(excess > 0.0);
}

void WarmStart::keep(double scale, std::vector<HeldRow>& held) const {
  for (Index i = 0; i < size_; ++i) {
    const Slot& slot = slots_[i];
    held.push_back({slot.place, slot.side, scale * multiplier_[i], Role::Violation});
  }
}

}  // namespace hurcules

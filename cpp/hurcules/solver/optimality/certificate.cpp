#include "hurcules/solver/optimality/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

using Long = long double;

// a row stands at its limit, relative to |a| max(1, |x|)
constexpr double kAtLimit = 1e-11;
// an own row that is violated by less is not told from one that stands at its limit, relative to
// |a| max(1, |x|): it may hold the step, but not pull at it
constexpr double kViolated = tolerance::kProven;
// what a multiplier counts for, as kForceRounding: its rounding is 1e-19 of it in long double
constexpr Long kLongRounding = 1e-10L;
// an own violated row depends on those before it
constexpr Long kOwnRank = 1e-13L;

}  // namespace

void Certificate::reserve(Index unknowns, Index rows) {
  basis_.reserve(unknowns, unknowns);
  // both sides of a row may be at their limits
  balance_.reserve(unknowns, 2 * rows);
  for (auto* v : {&violation_, &step_}) v->reserve(2 * rows);
  pushing_.resize(std::max<std::size_t>(pushing_.size(), rows));
  for (auto* v : {&force_, &unit_, &parts_, &free_}) {
    v->resize(std::max<std::size_t>(v->size(), unknowns));
  }
}

Long Certificate::dot(int row, const double* x) const {
  const Row& r = (*rows_)[row];
  if (r.dense < 0) return x[r.row];
  const double* a = rows_->dense_row(r.dense);
  Long sum = 0.0L;
  for (Index j = 0; j < rows_->unknowns(); ++j) sum += static_cast<Long>(a[j]) * x[j];
  return sum;
}

void Certificate::fill_unit(int row) {
  const Row& r = (*rows_)[row];
  const Index n = rows_->unknowns();
  if (r.dense < 0) {
    std::fill_n(unit_.begin(), n, 0.0L);
    unit_[r.row] = 1.0L;
    return;
  }
  const double* a = rows_->dense_row(r.dense);
  Long norm2 = 0.0L;
  for (Index j = 0; j < n; ++j) norm2 += static_cast<Long>(a[j]) * a[j];
  const Long norm = std::sqrt(norm2);
  for (Index j = 0; j < n; ++j) unit_[j] = a[j] / norm;
}

Long Certificate::violation(int row) const {
  const Row& r = (*rows_)[row];
  const Long value = dot(row, x_);
  return value - std::clamp<Long>(value, r.lower, r.upper);
}

// the rows that gave the basis its directions [first, end)
void Certificate::use_equalities(Index first, Index end) {
  for (Index j = first; j < end; ++j) {
    const int row = rows_->row_of_dense(static_cast<int>(nullspace_->pivot(j)));
    fill_unit(row);
    basis_.add(unit_.data(), row, 0.0L);
  }
}

Long Certificate::own_forces(double rho) {
  const Index n = rows_->unknowns();
  const Long rho2 = static_cast<Long>(rho) * rho;
  Long size2 = 0.0L;
  for (Index j = 0; j < n; ++j) {
    force_[j] = rho2 * (static_cast<Long>(x_[j]) - x_above_[j]);
    size2 += force_[j] * force_[j];
  }
  Long size = std::sqrt(size2);
  for (int i = rows_->begin(level_); i < rows_->begin(level_ + 1); ++i) {
    const Row& row = (*rows_)[i];
    const Long v = violation(i);
    if (v == 0.0L || row.norm == 0.0) continue;
    fill_unit(i);
    for (Index j = 0; j < n; ++j) force_[j] += v * row.norm * unit_[j];
    size += std::abs(v) * row.norm;
  }
  return size;
}

void Certificate::settle_violated() {
  for (int i = rows_->begin(level_); i < rows_->begin(level_ + 1); ++i) {
    const Row& row = (*rows_)[i];
    if (row.equality || row.norm == 0.0) continue;
    if (std::abs(violation(i)) <= kViolated * row.norm * x_scale_) continue;
    fill_unit(i);
    basis_.add(unit_.data(), i, kOwnRank);
  }
}

void Certificate::push(int row, Side side, std::vector<Push>& pushes) {
  const Index n = rows_->unknowns();
  fill_unit(row);
  Long* c = balance_.place();
  const Long left = basis_.remove(unit_.data(), c, parts_.data());
  if (left <= tolerance::kLost) return;
  const Long scale = static_cast<int>(side) / left;
  for (Index j = 0; j < n; ++j) c[j] *= scale;
  balance_.add();
  pushes.push_back({row, side, left, 0.0L});
}

// rows that stand at a limit and push back
void Certificate::push_limits(int first, int end, bool above, std::vector<Push>& pushes) {
  for (int i = first; i < end; ++i) {
    const Row& row = (*rows_)[i];
    if (row.equality || row.norm == 0.0) continue;
    const Long stands = dot(i, x_), room = kAtLimit * row.norm * x_scale_;
    Long lower = row.lower, upper = row.upper;
    if (above) {
      const Long stood = dot(i, x_above_);
      lower = std::min(lower, stood);
      upper = std::max(upper, stood);
    } else if (std::abs(violation(i)) > kViolated * row.norm * x_scale_) {
      continue;
    }
    if (stands >= upper - room) push(i, Side::Upper, pushes);
    if (stands <= lower + room) push(i, Side::Lower, pushes);
  }
}

double Certificate::balance(const Long* v, Long scale, std::vector<Push>& pushes) {
  basis_.remove(v, free_.data(), parts_.data());
  balance_.solve(free_.data());
  Long forces = 0.0L, weakest = basis_.weakest();
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    Push& push = pushes[i];
    push.weight = balance_.weight(static_cast<Index>(i)) / push.left;
    if (push.weight == 0.0L) continue;
    forces += push.weight;
    weakest = std::min(weakest, push.left);
  }
  constexpr Long kRounding = tolerance::kForceRounding;
  return static_cast<double>(balance_.left() / ((scale + std::min(scale, kLongRounding * forces)) *
                                                (1.0L + kRounding / weakest)));
}

double Certificate::find(const RowTable& rows, const NullspaceBasis& nullspace, int k,
                         const double* x_above, double x_scale, const LevelRecord& record) {
  rows_ = &rows;
  nullspace_ = &nullspace;
  x_above_ = x_above;
  x_ = record.x.data();
  x_scale_ = x_scale;
  level_ = k;
  const Index n = rows.unknowns();
  basis_.start(n);
  use_equalities(0, nullspace.rank_before(k));
  const double rho2 = record.rho * record.rho;
  const Long least = tolerance::kLeastForce * (record.own_norm * record.own_norm + rho2) * x_scale;
  const Long scale = std::max(own_forces(record.rho), least);
  balance_.start(n);
  violation_.clear();
  step_.clear();
  push_limits(0, rows.begin(k), true, violation_);
  double worst = scale > 0.0L ? balance(force_.data(), scale, violation_) : 0.0;
  if (record.rho > tolerance::kProximal * record.own_norm) return worst;
  use_equalities(nullspace.rank_before(k), nullspace.rank_before(k + 1));
  settle_violated();
  balance_.start(n);
  push_limits(0, rows.begin(k), true, step_);
  push_limits(rows.begin(k), rows.begin(k + 1), false, step_);
  for (Index j = 0; j < n; ++j) force_[j] = static_cast<Long>(x_[j]) - x_above[j];
  return std::max(worst, balance(force_.data(), x_scale, step_));
}

void Certificate::keep(std::vector<HeldRow>& held, int& begin_norm) {
  std::fill_n(pushing_.begin(), rows_->size(), 0);
  const auto multiplier = [&](const Push& push) {
    return static_cast<double>(push.weight / (*rows_)[push.row].norm);
  };
  for (const Push& push : violation_) {
    if (push.weight == 0.0L) continue;
    held.push_back({push.row, push.side, multiplier(push), Role::Violation});
    pushing_[push.row] = 1;
  }
  for (int i = rows_->begin(level_); i < rows_->begin(level_ + 1); ++i) {
    const Row& row = (*rows_)[i];
    if (row.equality || row.norm == 0.0) continue;
    const Long v = violation(i);
    if (std::abs(v) <= kViolated * row.norm * x_scale_) continue;
    const Side side = v > 0.0L ? Side::Upper : Side::Lower;
    held.push_back({i, side, static_cast<double>(std::abs(v)), Role::Violation});
    pushing_[i] = 1;
  }
  begin_norm = static_cast<int>(held.size());
  for (const Push& push : step_) {
    if (push.weight == 0.0L) continue;
    const Role role = pushing_[push.row] ? Role::Idle : Role::SmallestStep;
    held.push_back({push.row, push.side, multiplier(push), role});
  }
}

}  // namespace hurcules

#include "hurcules/solver/small_rho/step_multipliers.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels/kernels.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

// a row stands at its limit, relative to |a| max(1, |x|)
constexpr double kAtLimit = 1e-11;
// coordinates in the basis are rounded in double: a row of which less is free is not used,
// and a pull of less is none, relative to max(1, |x|)
constexpr double kLeastFree = 1e-6, kNoPull = 1e-13;

}  // namespace

void StepMultipliers::reserve(Index unknowns, Index rows) {
  balance_.reserve(unknowns, 2 * rows);  // both sides of a row may be at their limits
  pushes_.reserve(2 * rows);
  pushing_.resize(std::max<std::size_t>(pushing_.size(), rows));
  free_.resize(std::max<std::size_t>(free_.size(), unknowns));
  for (PaddedVector* v : {&moved_, &coordinates_}) v->reserve(padded(unknowns) + 4);
}

void StepMultipliers::push(const Step& step, int row) {
  const Row& r = step.rows[row];
  if (r.equality || r.norm == 0.0) return;
  const bool above = r.level < step.level;
  const double stands = step.candidates.value[r.candidate];
  const double stood = step.candidates.above[r.candidate];
  const double room = kAtLimit * r.norm * step.x_scale;
  const double upper = above ? std::max(r.upper, stood) : r.upper;
  const double lower = above ? std::min(r.lower, stood) : r.lower;
  const Index first = step.nullspace.rank_before(step.level + 1);
  const Index columns = step.rows.unknowns() - first;
  const double* e = step.nullspace.coordinates(r) + first;
  double norm2 = 0.0;
  for (Index j = 0; j < columns; ++j) norm2 += e[j] * e[j];
  const double left = std::sqrt(norm2) / r.norm;
  if (left <= kLeastFree) return;
  for (const Side side : {Side::Upper, Side::Lower}) {
    const bool up = side == Side::Upper;
    if (up ? stands < upper - room : stands > lower + room) continue;
    const double scale = static_cast<double>(side) / (left * r.norm);
    Long* c = balance_.place();
    for (Index j = 0; j < columns; ++j) c[j] = scale * e[j];
    balance_.add();
    pushes_.push_back({row, side, left});
  }
}

bool StepMultipliers::find(const Step& step, std::vector<HeldRow>& held) {
  const RowTable& rows = step.rows;
  const int k = step.level;
  if (step.record.rho > tolerance::kProximal * step.record.own_norm) return false;
  constexpr double kViolated = tolerance::kProven / tolerance::kBroken;
  if (Candidates::violated(rows, k, step.candidates.value, kViolated * step.x_scale)) return false;
  const kernels::Table& kernel = *kernels::chosen;
  const Index first = step.nullspace.rank_before(k + 1), columns = rows.unknowns() - first;
  kernel.scaled_difference(rows.stride(), 1.0, step.record.x.data(), step.x_above, moved_.data());
  kernel.dots(step.nullspace.direction(first), columns, rows.stride(), moved_.data(),
              coordinates_.data());
  std::copy_n(coordinates_.data(), columns, free_.begin());
  balance_.start(columns);
  pushes_.clear();
  for (int i = 0; i < rows.begin(k + 1); ++i) push(step, i);
  balance_.solve(free_.data(), kNoPull * step.x_scale);
  std::fill_n(pushing_.begin(), rows.size(), 0);
  for (int h = step.record.first_held; h < step.record.first_norm; ++h) pushing_[held[h].row] = 1;
  for (std::size_t i = 0; i < pushes_.size(); ++i) {
    const Push& one = pushes_[i];
    const Long weight = balance_.weight(static_cast<Index>(i)) / one.left;
    if (weight == 0.0L) continue;
    const Role role = pushing_[one.row] ? Role::Idle : Role::SmallestStep;
    held.push_back({one.row, one.side, static_cast<double>(weight / rows[one.row].norm), role});
  }
  return true;
}

}  // namespace hurcules

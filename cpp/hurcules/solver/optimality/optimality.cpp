#include "hurcules/solver/optimality/optimality.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

// a limit pulls at the step when it does by more than this part of x
constexpr double kNoPull = 1e-10;

// What an imbalance is measured against: `size`, and the rounding of the multipliers. Where that
// would count for more, it is for the second look to say (certificate.hpp): large multipliers may
// be needless. Behind a smooth transition there is none.
double with_rounding(double size, double multipliers, bool whole) {
  if (!whole) return size + multipliers;
  return size + std::min(size, tolerance::kForceRounding * multipliers);
}

double norm_of(Index size, const double* v) {
  return std::sqrt(kernels::chosen->dot(size, v, v));
}

}  // namespace

void Optimality::reserve(Index unknowns, Index rows) {
  for (PaddedVector* v : {&g_, &work_, &step_}) v->reserve(padded(unknowns));
  for (PaddedVector* v : {&violation_, &settled_, &push_}) v->reserve(rows + 4);
}

// adds  sum v_i a_i  of the level's own rows to g; returns  sum |v_i| |a_i|
double Optimality::add_own_rows(const RowTable& rows, const Candidates& candidates, int k,
                                const double* x, double* g) {
  const kernels::Table& kernel = *kernels::chosen;
  double scale = 0.0;
  const int first = rows.equalities(k), count = rows.equalities(k + 1) - first;
  kernel.dots(rows.dense_row(first), count, rows.stride(), x, violation_.data());
  for (int i = 0; i < count; ++i) {
    settled_[first + i] = violation_[i];
    violation_[i] -= rows.targets()[first + i];
    scale += std::abs(violation_[i]) * rows.dense_norms()[first + i];
  }
  kernel.axpys(rows.dense_row(first), count, rows.stride(), violation_.data(), g);
  if (!Candidates::violated(rows, k, candidates.value, 0.0)) return scale;
  for (int i = rows.begin(k); i < rows.begin(k + 1); ++i) {
    if (rows[i].equality) continue;
    const double violation = rows.violation(i, candidates.value[rows[i].candidate]);
    if (violation == 0.0) continue;
    rows.add_to(i, violation, g);
    scale += std::abs(violation) * rows[i].norm;
  }
  return scale;
}

double Optimality::residual(const RowTable& rows, NullspaceBasis& nullspace,
                            const Candidates& candidates, int k, const double* x_above,
                            double x_scale, LevelRecord& record, const std::vector<HeldRow>& held) {
  const double* x = record.x.data();
  double* g = g_.data();
  const Index size = rows.stride();
  const double rho2 = record.rho * record.rho;
  double scale = std::sqrt(kernels::chosen->scaled_difference(size, rho2, x, x_above, g));
  scale += add_own_rows(rows, candidates, k, x, g);
  const Forces forces = add_held_rows(rows, candidates, k, record, held, g);
  const double unbalanced = unbalanced_force(nullspace, k, x_above, x, rho2, g);
  // what is left against the forces that balance; a level that is met has none, only the rounding
  // of its rows
  const double least =
      tolerance::kLeastForce * (record.own_norm * record.own_norm + rho2) * x_scale;
  const bool none = scale == 0.0 && forces.scale == 0.0;
  const double measure =
      with_rounding(std::max(scale, least), forces.scale, nullspace.weighted_basis().whole());
  double worst = none ? 0.0 : std::max(unbalanced, forces.pull) / measure;
  if (forces.largest > 0.0) worst = std::max(worst, forces.apart / (x_scale * forces.largest));
  record.worsened = worsened(rows, candidates, k) / x_scale;
  worst = std::max(worst, record.worsened);
  if (!nullspace.weighted_basis().whole())
    worst = std::max(worst, moved(rows, nullspace, k, x_above, x) / x_scale);
  const Balance violations = {unbalanced, tolerance::kProven * measure};
  return std::max(worst, norm_residual(rows, nullspace, k, x_above, record, held, violations));
}

// the part of g in the free directions of level k; behind a smooth transition as an error of x
double Optimality::unbalanced_force(NullspaceBasis& nullspace, int k, const double* x_above,
                                    const double* x, double rho2, double* g) {
  const Index size = nullspace.x_stride(), first = nullspace.rank_before(k);
  if (nullspace.weighted_basis().whole()) return nullspace.free_part(first, g, work_.data());
  for (Index j = 0; j < size; ++j) g[j] -= rho2 * (x[j] - x_above[j]);
  std::copy_n(g, size, work_.data());
  nullspace.remove_first(first, work_.data());
  for (Index j = 0; j < size; ++j) work_[j] += rho2 * (x[j] - x_above[j]);
  return norm_of(size, work_.data());
}

// adds what rows above push to g
Optimality::Forces Optimality::add_held_rows(const RowTable& rows, const Candidates& candidates,
                                             int k, const LevelRecord& record,
                                             const std::vector<HeldRow>& held, double* g) {
  Forces forces;
  for (int h = record.first_held; h < record.first_held + record.held; ++h) {
    const Row& row = rows[held[h].row];
    const bool up = held[h].side == Side::Upper;
    const double multiplier = held[h].multiplier, size = std::abs(multiplier);
    forces.largest = std::max(forces.largest, size);
    forces.pull = std::max(forces.pull, -multiplier * row.norm);
    if (row.level == k) continue;
    forces.scale += size * row.norm;
    rows.add_to(held[h].row, up ? multiplier : -multiplier, g);
    // what a row above may reach: its limit, or where it stood when that was worse
    const double stood = candidates.above[row.candidate], stands = candidates.value[row.candidate];
    const double limit = up ? std::max(row.upper, stood) : std::min(row.lower, stood);
    const double gap = size * std::abs(stands - limit);
    if (gap > forces.apart * row.norm) forces.apart = gap / row.norm;
  }
  return forces;
}

double Optimality::moved(const RowTable& rows, const NullspaceBasis& nullspace, int k,
                         const double* x_above, const double* x) {
  const kernels::Table& kernel = *kernels::chosen;
  kernel.scaled_difference(rows.stride(), 1.0, x, x_above, work_.data());
  const double* norms = rows.dense_norms();
  if (nullspace.weighted_basis().whole()) {
    return kernel.largest_way(rows.dense_row(0), rows.equalities(k), rows.stride(), work_.data(),
                              norms);
  }
  kernel.dots(rows.dense_row(0), rows.equalities(k), rows.stride(), work_.data(),
              violation_.data());
  double worst = 0.0;
  for (int d = 0; d < rows.equalities(k); ++d) {
    const double way = std::abs(violation_[d]);
    if (way > worst * norms[d] && !nullspace.handed_over(rows, d)) worst = way / norms[d];
  }
  return std::max(worst, nullspace.weighted_basis().moved(work_.data()));
}

double Optimality::moved_since(const RowTable& rows, const NullspaceBasis& last, int levels,
                               const double* value) const {
  double worst = 0.0;
  for (int d = 0; d < rows.equalities(levels); ++d) {
    const double way = std::abs(value[d] - settled_[d]), norm = rows.dense_norms()[d];
    if (way > worst * norm && !last.handed_over(rows, d)) worst = way / norm;
  }
  return worst;
}

double Optimality::worsened(const RowTable& rows, const Candidates& candidates, int k) const {
  double worst = 0.0;
  const auto check = [&](Index first, Index count) {
    const kernels::LimitArrays limits = {rows.asked_lower() + first, rows.asked_upper() + first,
                                         rows.norms() + first};
    const double excess = kernels::chosen->worsened(count, candidates.above.data() + first,
                                                    candidates.value.data() + first, limits);
    worst = std::max(worst, excess);
  };
  for (int b = 0; b < rows.bounds_blocks(); ++b) {
    if (rows.block_level(b) < k) check(b * rows.stride(), rows.stride());
  }
  if (rows.inequalities(k) > 0) check(rows.first_dense_candidate(), rows.inequalities(k));
  return worst;
}

// How often the balance of the violations has to be added to that of the step so that no limit
// pulls: a limit that pushes against the violations, mu > 0, may pull at the step, nu < 0, as long
// as nu + often mu >= 0. A push that is not told from none allows no pull: what is left of the
// balance then.
double Optimality::repeats(const RowTable& rows, const LevelRecord& record,
                           const std::vector<HeldRow>& held, const Balance& violations) {
  const int end = record.first_norm + record.norm;
  for (int h = record.first_norm; h < end; ++h) push_[held[h].row] = 0.0;
  for (int h = record.first_held; h < record.first_norm; ++h) {
    push_[held[h].row] = held[h].multiplier;
  }
  double often = 0.0, pulls = 0.0;
  const double none = kNoPull * norm_of(rows.stride(), record.x.data());
  for (int h = record.first_norm; h < end; ++h) {
    const double pull = -held[h].multiplier;
    const double norm = rows[held[h].row].norm, push = push_[held[h].row];
    if (pull * norm <= none) continue;
    if (push * norm <= violations.told) {
      pulls = std::max(pulls, pull * norm);
    } else {
      often = std::max(often, pull / push);
    }
  }
  return pulls + often * violations.unbalanced;
}

// rho = 0: among all minimisers the step is the smallest, t + sum nu side a = 0 on what the level
// left free
double Optimality::norm_residual(const RowTable& rows, NullspaceBasis& nullspace, int k,
                                 const double* x_above, const LevelRecord& record,
                                 const std::vector<HeldRow>& held, const Balance& violations) {
  if (record.norm == 0) return 0.0;
  const Index size = rows.stride();
  const bool whole = nullspace.weighted_basis().whole();
  for (Index j = 0; j < size; ++j) step_[j] = record.x[j] - x_above[j];
  for (Index j = 0; j < size; ++j) work_[j] = whole ? step_[j] : 0.0;
  // what is left is an error of x, so x is its scale
  const double x_size = std::max(1.0, norm_of(size, record.x.data()));
  double multipliers = 0.0;
  for (int h = record.first_norm; h < record.first_norm + record.norm; ++h) {
    rows.add_to(held[h].row, static_cast<double>(held[h].side) * held[h].multiplier, work_.data());
    multipliers += std::abs(held[h].multiplier) * rows[held[h].row].norm;
  }
  nullspace.remove_first(nullspace.rank_before(k + 1), work_.data());
  if (!whole) nullspace.add_free_part(nullspace.rank_before(k + 1), step_.data(), work_.data());
  return (norm_of(size, work_.data()) + repeats(rows, record, held, violations)) /
         with_rounding(x_size, multipliers, whole);
}

}  // namespace hurcules

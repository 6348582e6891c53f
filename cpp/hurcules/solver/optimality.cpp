#include "hurcules/solver/optimality.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hurcules {

namespace {

// forces below this part of |a|^2 |x| are not told from rounding
constexpr double kLeastForce = 1e-3;

double norm_of(Index size, const double* v) {
  return std::sqrt(kernels::chosen->dot(size, v, v));
}

double largest(Index size, const double* v) {
  double result = 0.0;
  for (Index j = 0; j < size; ++j) result = std::max(result, std::abs(v[j]));
  return result;
}

}  // namespace

void Optimality::reserve(Index unknowns, Index rows, Index levels) {
  work_.reserve(padded(unknowns));
  violation_.reserve(rows + 4);
  for (PaddedVector* v : {&before_, &now_}) v->reserve(rows + 4 * levels + 8);
}

void Optimality::start(const RowTable& rows) {
  std::fill_n(now_.data(), rows.candidates(rows.levels()), 0.0);
}

// adds  sum v_i a_i  of the level's own rows to g; returns  sum |v_i| |a_i|
double Optimality::add_own_rows(const RowTable& rows, int k, const double* x, double* g) {
  const kernels::Table& kernel = *kernels::chosen;
  double scale = 0.0;
  const int first = rows.equalities(k), count = rows.equalities(k + 1) - first;
  kernel.dots(rows.dense_row(first), count, rows.stride(), x, violation_.data());
  for (int i = 0; i < count; ++i) {
    const Row& row = rows[rows.row_of_dense(first + i)];
    violation_[i] -= row.upper;
    scale += std::abs(violation_[i]) * row.norm;
  }
  kernel.axpys(rows.dense_row(first), count, rows.stride(), violation_.data(), g);
  for (int i = rows.begin(k); i < rows.begin(k + 1); ++i) {
    if (rows[i].equality) continue;
    const double violation = rows.violation(i, now_[rows[i].candidate]);
    if (violation == 0.0) continue;
    rows.add_to(i, violation, g);
    scale += std::abs(violation) * rows[i].norm;
  }
  return scale;
}

double Optimality::residual(const RowTable& rows, Chain& chain, int k, const double* x_above,
                            LevelRecord& record, const std::vector<HeldRow>& held) {
  const double* x = record.x.data();
  double* g = record.gradient.data();
  const Index size = rows.stride();
  const double rho2 = record.rho * record.rho, x_scale = std::max(1.0, largest(size, x));
  std::swap(before_, now_);
  rows.values(k + 1, x, now_.data());
  for (Index j = 0; j < size; ++j) g[j] = rho2 * (x[j] - x_above[j]);
  double scale = norm_of(size, g);
  scale += add_own_rows(rows, k, x, g);
  for (int h = record.first_held; h < record.first_held + record.held; ++h) {
    if (rows[held[h].row].level == k) continue;
    rows.add_to(held[h].row, static_cast<double>(held[h].side) * held[h].multiplier, g);
    scale += std::abs(held[h].multiplier) * rows[held[h].row].norm;
  }
  // stationarity on the free directions
  std::copy_n(g, size, work_.data());
  chain.remove_first(chain.rank_before(k), work_.data());
  double norm = 0.0, worst = 0.0;
  for (int i = rows.begin(k); i < rows.begin(k + 1); ++i) norm = std::max(norm, rows[i].norm);
  // what is left against the forces that balance; a level that is met has none, only the rounding
  // of its rows
  const double least = kLeastForce * norm * norm * x_scale;
  if (scale > 0.0) worst = norm_of(size, work_.data()) / std::max(scale, least);
  worst = std::max(worst, worst_held(rows, k, record, held, x_scale));
  worst = std::max(worst, worsened(rows, k, x_above, x) / x_scale);
  return std::max(worst, norm_residual(rows, chain, k, x_above, record, held));
}

// signs and complementarity
double Optimality::worst_held(const RowTable& rows, int k, const LevelRecord& record,
                              const std::vector<HeldRow>& held, double x_scale) const {
  double push = 0.0, worst = 0.0;
  const int end = record.first_held + record.held;
  for (int h = record.first_held; h < end; ++h) push = std::max(push, std::abs(held[h].multiplier));
  if (push == 0.0) return 0.0;
  for (int h = record.first_held; h < end; ++h) {
    worst = std::max(worst, -held[h].multiplier / push);
    const Row& row = rows[held[h].row];
    if (row.level == k || row.norm == 0.0) continue;
    // what a row above may reach: its limit, or where it stood when that was worse
    const double stood = before_[row.candidate], stands = now_[row.candidate];
    const double gap = held[h].side == Side::Upper ? stands - std::max(row.upper, stood)
                                                   : stands - std::min(row.lower, stood);
    const double weight = std::min(1.0, held[h].multiplier / push);
    worst = std::max(worst, weight * std::abs(gap) / (row.norm * x_scale));
  }
  return worst;
}

// by how much a row above has got worse, relative to |a|
double Optimality::worsened(const RowTable& rows, int k, const double* x_above, const double* x) {
  const kernels::Table& kernel = *kernels::chosen;
  double worst = 0.0;
  // equality rows may not move at all
  for (Index j = 0; j < rows.stride(); ++j) work_[j] = x[j] - x_above[j];
  kernel.dots(rows.dense_row(0), rows.equalities(k), rows.stride(), work_.data(),
              violation_.data());
  for (int d = 0; d < rows.equalities(k); ++d) {
    const double norm = rows[rows.row_of_dense(d)].norm;
    if (norm > 0.0) worst = std::max(worst, std::abs(violation_[d]) / norm);
  }
  const auto check = [&](Index first, Index count) {
    const kernels::LimitArrays limits = {rows.asked_lower() + first, rows.asked_upper() + first,
                                         rows.norms() + first};
    const double excess =
        kernel.worsened(count, before_.data() + first, now_.data() + first, limits);
    worst = std::max(worst, excess);
  };
  for (int b = 0; b < rows.bounds_blocks(); ++b) {
    if (rows.block_level(b) < k) check(b * rows.stride(), rows.stride());
  }
  // own rows behind the last one above, up to the next four, stood where they stand
  const Index first = rows.first_dense_candidate(), end = first + rows.inequalities(k);
  for (Index c = end; c < rows.candidates(k); ++c) before_[c] = now_[c];
  check(first, rows.candidates(k) - first);
  return worst;
}

// rho = 0: among all minimisers the step is the smallest, t + sum nu side a = 0 on what the level
// left free
double Optimality::norm_residual(const RowTable& rows, Chain& chain, int k, const double* x_above,
                                 const LevelRecord& record, const std::vector<HeldRow>& held) {
  if (record.norm == 0) return 0.0;
  const Index size = rows.stride();
  for (Index j = 0; j < size; ++j) work_[j] = record.x[j] - x_above[j];
  // what is left is an error of x, so x is its scale
  double scale = std::max(1.0, norm_of(size, record.x.data()));
  for (int h = record.first_norm; h < record.first_norm + record.norm; ++h) {
    rows.add_to(held[h].row, static_cast<double>(held[h].side) * held[h].multiplier, work_.data());
    scale += std::abs(held[h].multiplier) * rows[held[h].row].norm;
  }
  chain.remove_first(chain.rank_before(k + 1), work_.data());
  return norm_of(size, work_.data()) / scale;
}

}  // namespace hurcules

#include "hurcules/solver/optimality.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

// forces below this part of |a|^2 |x| are not told from rounding
constexpr double kLeastForce = 1e-3;

double limit_of(const Row& row, Side side) {
  return side == Side::Upper ? row.upper : row.lower;
}

// what a row above may reach: its limit, or where it stood when that was worse
double allowed(const RowTable& rows, int i, Side side, int k, const Vector& x_above) {
  const double limit = limit_of(rows[i], side);
  if (rows[i].level == k) return limit;
  const double stood = rows.dot(i, x_above);
  return side == Side::Upper ? std::max(limit, stood) : std::min(limit, stood);
}

}  // namespace

void Optimality::reserve(Index unknowns) {
  work_.resize(unknowns);
}

double Optimality::residual(const RowTable& rows, const Chain& chain, int k, const Vector& x_above,
                            LevelRecord& record, const std::vector<HeldRow>& held) {
  const Vector& x = record.x;
  Vector& g = record.gradient;
  const double rho2 = record.rho * record.rho;
  const double x_scale = std::max(1.0, x.lpNorm<Eigen::Infinity>());
  g = rho2 * (x - x_above);
  double scale = g.norm(), largest = 0.0, worst = 0.0, norm = 0.0;
  for (int i = rows.begin(k); i < rows.begin(k + 1); ++i) {
    const double violation = rows.violation(i, rows.dot(i, x));
    rows.add_to(i, violation, g);
    scale += std::abs(violation) * rows[i].norm;
    norm = std::max(norm, rows[i].norm);
  }
  for (int h = record.first_held; h < record.first_held + record.held; ++h) {
    if (rows[held[h].row].level != k) {
      rows.add_to(held[h].row, static_cast<double>(held[h].side) * held[h].multiplier, g);
      scale += std::abs(held[h].multiplier) * rows[held[h].row].norm;
    }
    largest = std::max(largest, std::abs(held[h].multiplier));
  }
  // stationarity on the free directions
  work_ = g;
  chain.remove_first(chain.rank_before(k), work_);
  // what is left against the forces that balance; a level that is met has none, only the rounding
  // of its rows
  const double least = kLeastForce * norm * norm * x_scale;
  if (scale > 0.0) worst = work_.norm() / std::max(scale, least);
  // signs and complementarity
  for (int h = record.first_held; h < record.first_held + record.held; ++h) {
    if (largest > 0.0) worst = std::max(worst, -held[h].multiplier / largest);
    const Row& row = rows[held[h].row];
    if (row.level == k || row.norm == 0.0) continue;
    const double gap =
        rows.dot(held[h].row, x) - allowed(rows, held[h].row, held[h].side, k, x_above);
    const double weight = largest > 0.0 ? std::min(1.0, held[h].multiplier / largest) : 0.0;
    worst = std::max(worst, weight * std::abs(gap) / (row.norm * x_scale));
  }
  worst = std::max(worst, broken(rows, k, x_above, x));
  return std::max(worst, norm_residual(rows, chain, k, x_above, record, held));
}

// by how much a row above has got worse, relative to |a| max(1, |x|)
double Optimality::broken(const RowTable& rows, int k, const Vector& x_above,
                          const Vector& x) const {
  const double x_scale = std::max(1.0, x.lpNorm<Eigen::Infinity>());
  double worst = 0.0;
  for (int i = 0; i < rows.begin(k); ++i) {
    const Row& row = rows[i];
    if (row.norm == 0.0) continue;
    const double now = rows.dot(i, x), before = rows.dot(i, x_above);
    const double lower = row.equality ? before : std::min(row.lower, before);
    const double upper = row.equality ? before : std::max(row.upper, before);
    worst = std::max(
        {worst, (now - upper) / (row.norm * x_scale), (lower - now) / (row.norm * x_scale)});
  }
  return worst;
}

// rho = 0: among all minimisers the step is the smallest, t + sum nu side a = 0 on what the level
// left free
double Optimality::norm_residual(const RowTable& rows, const Chain& chain, int k,
                                 const Vector& x_above, const LevelRecord& record,
                                 const std::vector<HeldRow>& held) {
  if (record.norm == 0) return 0.0;
  work_ = record.x - x_above;
  // what is left is an error of x, so x is its scale
  double scale = std::max(1.0, record.x.norm());
  for (int h = record.first_norm; h < record.first_norm + record.norm; ++h) {
    rows.add_to(held[h].row, static_cast<double>(held[h].side) * held[h].multiplier, work_);
    scale += std::abs(held[h].multiplier) * rows[held[h].row].norm;
  }
  chain.remove_first(chain.rank_before(k + 1), work_);
  return work_.norm() / scale;
}

}  // namespace hurcules

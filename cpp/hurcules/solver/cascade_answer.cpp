// What a cascade leaves behind: proof, violations, working set, multipliers.
#include <algorithm>
#include <cmath>

#include "hurcules/solver/cascade.hpp"
#include "hurcules/solver/dense_decompositions.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

// forces below this part of |a|^2 |x| are rounding, as in Optimality
constexpr double kLeastForce = 1e-3;
// a multiplier pushes, relative to the largest
constexpr double kPushes = 1e-12;

}  // namespace

void Cascade::finish_level(double rho, int k) {
  const Vector x_above = x_;
  x_ += Z_ * t_;
  Record record{rho * rho * (x_ - x_above), Vector::Zero(rows_.begin(k + 1))};
  for (std::size_t c = 0; c < limits_.size(); ++c) {
    const Limit& limit = limits_[c];
    if (rows_[limit.row].level < k) {
      record.multipliers[limit.row] -= limit.sign * answer_.multipliers[c];
    }
  }
  for (int i = rows_.begin(k); i < rows_.begin(k + 1); ++i) {
    record.multipliers[i] = rows_.violation(i, rows_.dot(i, x_));
  }
  for (int i = 0; i < rows_.begin(k + 1); ++i) {
    rows_.add_to(i, record.multipliers[i], record.gradient);
  }
  solution_.optimality = std::max(solution_.optimality, residual(record, k, x_above));
  records_.push_back(std::move(record));
}

// stationarity on the free directions, rows above that got worse, multipliers of rows off their
// limits; relative
double Cascade::residual(const Record& record, int k, const Vector& x_above) const {
  const double x_scale = std::max(1.0, x_.lpNorm<Eigen::Infinity>());
  const double largest =
      record.multipliers.size() ? record.multipliers.lpNorm<Eigen::Infinity>() : 0.0;
  double scale = 0.0, norm = 0.0, worst = 0.0;
  for (int i = 0; i < rows_.begin(k + 1); ++i) {
    const Row& row = rows_[i];
    const double mu = record.multipliers[i];
    scale += std::abs(mu) * row.norm;
    if (row.level == k) norm = std::max(norm, row.norm);
    if (row.level == k || row.norm == 0.0) continue;
    const double now = rows_.dot(i, x_), before = rows_.dot(i, x_above);
    const double upper = row.equality ? before : std::max(row.upper, before);
    const double lower = row.equality ? before : std::min(row.lower, before);
    worst = std::max(
        {worst, (now - upper) / (row.norm * x_scale), (lower - now) / (row.norm * x_scale)});
    if (mu != 0.0 && !row.equality) {
      const double gap = std::abs(now - (mu > 0.0 ? upper : lower)) / (row.norm * x_scale);
      worst = std::max(worst, std::min(1.0, std::abs(mu) / largest) * gap);
    }
  }
  const double force = (Z_.transpose() * record.gradient).norm();
  scale = std::max(scale, kLeastForce * norm * norm * x_scale);
  return scale > 0.0 ? std::max(worst, force / scale) : worst;
}

void Cascade::fill_solution() {
  if (solution_.status == SolverStatus::Solved && solution_.optimality > tolerance::kProven) {
    solution_.status = SolverStatus::ReducedAccuracy;
  }
  solution_.x = x_;
  for (int i = 0; i < rows_.size(); ++i) {
    solution_.violations[rows_[i].level][rows_[i].row] = rows_.violation(i, rows_.dot(i, x_));
  }
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const Vector& mu = records_[k].multipliers;
    const double least = mu.size() ? kPushes * mu.lpNorm<Eigen::Infinity>() : 0.0;
    for (int i = 0; i < mu.size(); ++i) {
      if (rows_[i].equality || std::abs(mu[i]) <= least) continue;
      solution_.working_set.push_back({rows_[i].level, rows_[i].row,
                                       mu[i] > 0.0 ? Side::Upper : Side::Lower, static_cast<int>(k),
                                       std::abs(mu[i])});
    }
  }
}

std::vector<std::vector<Vector>> Cascade::multipliers() const {
  std::vector<std::vector<Vector>> result(records_.size());
  for (int k = 0; k < static_cast<int>(records_.size()); ++k) {
    Vector all = records_[k].multipliers;
    // equality rows above take what is left of the gradient
    const Matrix A = k > 0 ? equality_rows(0, k - 1) : Matrix(0, unknowns_);
    if (A.rows() > 0) {
      const Vector mu = Eigen::MatrixXd(A.transpose())
                            .completeOrthogonalDecomposition()
                            .solve(-records_[k].gradient);
      for (int i = 0, e = 0; i < rows_.begin(k); ++i) {
        if (rows_[i].equality) all[i] = mu[e++];
      }
    }
    for (int j = 0; j <= k; ++j) {
      result[k].push_back(all.segment(rows_.begin(j), rows_.begin(j + 1) - rows_.begin(j)));
    }
  }
  return result;
}

}  // namespace hurcules

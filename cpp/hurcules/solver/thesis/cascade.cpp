#include "hurcules/solver/thesis/cascade.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/kernels/dense_decompositions.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

constexpr int kMaxProximalSteps = 60;
// a limit is broken, relative to |a| max(1, |x|)
constexpr double kBroken = 1e-12;
// room for rows that the smallest step must keep although a proximal step met them to rounding
constexpr double kRoom = 1e-11;
// an own row is violated, not at its limit, relative to max(1, |x|) |a|
constexpr double kViolation = 1e-9;

double scale_of(const Vector& x) {
  return std::max(1.0, x.lpNorm<Eigen::Infinity>());
}

// directions of Z (n, o) that the rows of A leave free; a row counts by its direction alone
Matrix null_space(const Matrix& A, const Matrix& Z) {
  if (A.rows() == 0 || Z.cols() == 0) return Z;
  Eigen::MatrixXd projected = A * Z;
  for (Index i = 0; i < A.rows(); ++i) {
    const double norm = A.row(i).norm();
    if (norm > 0.0) projected.row(i) /= norm;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(projected, Eigen::ComputeFullV);
  Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()[rank] > tolerance::kRank)
    ++rank;
  return Z * svd.matrixV().rightCols(Z.cols() - rank);
}
// forces below this part of |a|^2 |x| are rounding, as in Optimality
constexpr double kLeastForce = 1e-3;
// a multiplier pushes, relative to the largest
constexpr double kPushes = 1e-12;

}  // namespace

Cascade::Cascade(Index unknowns, const SolverOptions& options)
    : unknowns_(unknowns), options_(options) {
  solution_.x.setZero(unknowns);
}

void Cascade::reserve(HierarchyView hierarchy) {
  Index rows = 0;
  solution_.violations.resize(hierarchy.size());
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    solution_.violations[k].setZero(hierarchy[k].rows());
    rows += hierarchy[k].rows();
  }
  rows_.reserve(unknowns_, rows, static_cast<Index>(hierarchy.size()));
}

const Solution& Cascade::solve(HierarchyView hierarchy) {
  reserve(hierarchy);
  solution_.status = SolverStatus::Solved;
  solution_.factorizations = solution_.changes = solution_.final_levels = 0;
  solution_.optimality = 0.0;
  solution_.x.setZero(unknowns_);
  solution_.working_set.clear();
  records_.clear();
  if (!rows_.read(hierarchy)) {
    solution_.status = SolverStatus::InvalidInput;
    return solution_;
  }
  x_.setZero(unknowns_);
  Z_.setIdentity(unknowns_, unknowns_);
  for (int k = 0; k < rows_.levels(); ++k) {
    t_.setZero(Z_.cols());
    const double rho = hierarchy[k].rho;
    const bool trivial = Z_.cols() == 0 || hierarchy[k].rows() == 0;
    program_ = {};
    limits_.clear();
    solution_.factorizations += hierarchy[k].rows() > 0;
    if (!trivial && !(rho > 0.0 ? solve_regularized(rho, k) : solve_unregularized(k))) break;
    finish_level(rho, k);
    ++solution_.final_levels;
    Z_ = null_space(equality_rows(k, k), Z_);
  }
  fill_solution();
  return solution_;
}

Vector Cascade::row(int i) const {
  Vector a = Vector::Zero(unknowns_);
  rows_.add_to(i, 1.0, a);
  return a;
}

Matrix Cascade::equality_rows(int first_level, int last_level) const {
  Matrix A(rows_.begin(last_level + 1) - rows_.begin(first_level), unknowns_);
  Index m = 0;
  for (int i = rows_.begin(first_level); i < rows_.begin(last_level + 1); ++i) {
    if (rows_[i].equality) A.row(m++) = row(i);
  }
  return A.topRows(m);
}

// own sides as they are; sides above at where they stand when that is worse
std::vector<Cascade::Limit> Cascade::limits(int k) const {
  std::vector<Limit> result;
  for (int i = 0; i < rows_.begin(k + 1); ++i) {
    const Row& r = rows_[i];
    const bool above = r.level < k;
    // a row above without a part in the free directions cannot be moved
    if (r.equality || (above && (Z_.transpose() * row(i)).norm() <= tolerance::kLost * r.norm))
      continue;
    const double at = rows_.dot(i, x_);
    if (std::isfinite(r.lower)) result.push_back({i, 1.0, above ? std::min(r.lower, at) : r.lower});
    if (std::isfinite(r.upper))
      result.push_back({i, -1.0, above ? std::max(r.upper, at) : r.upper});
  }
  return result;
}

// min 1/2 |A_eq (x + Z t) - b|^2 + 1/2 |slack|^2 + 1/2 rho^2 |t - t_|^2
bool Cascade::solve_regularized(double rho, int k) {
  const Index o = Z_.cols();
  const int first = rows_.begin(k), m = rows_.begin(k + 1) - first;
  const Matrix A = equality_rows(k, k) * Z_;
  Vector b(A.rows());
  for (int i = first, e = 0; i < first + m; ++i) {
    if (rows_[i].equality) b[e++] = rows_[i].upper - rows_.dot(i, x_);
  }
  program_.H.setIdentity(o + m, o + m);
  program_.H.topLeftCorner(o, o) = A.transpose() * A + rho * rho * Matrix::Identity(o, o);
  program_.g.setZero(o + m);
  program_.g.head(o) = A.transpose() * b + rho * rho * t_;
  limits_ = limits(k);
  const Index size = static_cast<Index>(limits_.size());
  program_.C.setZero(size, o + m);
  program_.d.resize(size);
  program_.tolerance.resize(size);
  for (Index c = 0; c < size; ++c) {
    const Limit& limit = limits_[c];
    program_.C.row(c).head(o) = limit.sign * (Z_.transpose() * row(limit.row));
    if (limit.row >= first) program_.C(c, o + limit.row - first) = limit.sign;
    program_.d[c] = limit.sign * (limit.limit - rows_.dot(limit.row, x_));
    program_.tolerance[c] = kBroken * rows_[limit.row].norm * scale_of(x_);
  }
  if (!minimize_program()) return false;
  t_ = answer_.y.head(o);
  return true;
}

bool Cascade::minimize_program() {
  answer_ = minimize(program_, options_.max_changes - solution_.changes);
  solution_.changes += answer_.changes;
  if (!answer_.y.allFinite()) {
    solution_.status = SolverStatus::LostPrecision;
  } else if (!answer_.optimal) {
    solution_.status = solution_.changes >= options_.max_changes ? SolverStatus::IterationLimit
                                                                 : SolverStatus::LostPrecision;
  }
  return solution_.status == SolverStatus::Solved;
}

bool Cascade::solve_unregularized(int k) {
  double size = 0.0, before = std::numeric_limits<double>::infinity();
  for (int i = rows_.begin(k); i < rows_.begin(k + 1); ++i) size = std::max(size, rows_[i].norm);
  if (size == 0.0) return true;  // nothing moves a zero row
  for (int step = 0; step < kMaxProximalSteps; ++step) {
    const Vector centre = t_;
    if (!solve_regularized(tolerance::kProximal * size, k)) return false;
    const double moved = (t_ - centre).lpNorm<Eigen::Infinity>() / scale_of(t_);
    if (moved < 1e-12 || (moved < 1e-8 && moved > 0.5 * before)) break;
    before = moved;
  }
  return smallest_step(k);
}

std::vector<char> Cascade::settled_rows(int k) const {
  std::vector<char> settled(rows_.size(), 0);
  const Vector x = x_ + Z_ * t_;
  const double largest = answer_.multipliers.size() ? answer_.multipliers.maxCoeff() : 0.0;
  double norm = 0.0;
  for (int i = rows_.begin(k); i < rows_.begin(k + 1); ++i) {
    norm = std::max(norm, rows_[i].norm);
    settled[i] = rows_[i].equality || std::abs(rows_.violation(i, rows_.dot(i, x))) >
                                          kViolation * rows_[i].norm * scale_of(x);
  }
  const double least =
      std::max(tolerance::kSettling * largest, tolerance::kNoForce * norm * norm * scale_of(x));
  for (std::size_t c = 0; c < limits_.size(); ++c) {
    if (rows_[limits_[c].row].level < k && answer_.multipliers[c] > least)
      settled[limits_[c].row] = 1;
  }
  return settled;
}

// among all t with the same violations the smallest: t = its fixed part + N s, min |s|
bool Cascade::smallest_step(int k) {
  const std::vector<char> settled = settled_rows(k);
  Matrix A(rows_.begin(k + 1), unknowns_);
  Index m = 0;
  for (int i = 0; i < rows_.begin(k + 1); ++i) {
    if (settled[i]) A.row(m++) = row(i);
  }
  const Matrix N = Z_.transpose() * null_space(A.topRows(m), Z_);  // (o, directions)
  if (N.cols() == 0) return true;
  const Vector fixed = t_ - N * (N.transpose() * t_), from = x_ + Z_ * fixed;
  QuadraticProgram& p = program_;
  p = {};
  p.H.setIdentity(N.cols(), N.cols());
  p.g.setZero(N.cols());
  p.C.resize(limits_.size(), N.cols());
  p.d.resize(limits_.size());
  p.tolerance.resize(limits_.size());
  const QuadraticAnswer settled_answer = answer_;
  for (std::size_t c = 0; c < limits_.size(); ++c) {
    const Limit& limit = limits_[c];
    const double room = kRoom * rows_[limit.row].norm * scale_of(x_);
    p.C.row(c) = limit.sign * (N.transpose() * (Z_.transpose() * row(limit.row)));
    p.d[c] = limit.sign * (limit.limit - rows_.dot(limit.row, from));
    p.tolerance[c] = room;
    // what is settled, or has no part in N, stays where it is
    if (settled[limit.row] || p.C.row(c).norm() <= tolerance::kLost * rows_[limit.row].norm) {
      p.C.row(c).setZero();
    }
  }
  if (!minimize_program()) return false;
  t_ = fixed + N * answer_.y;
  answer_ = settled_answer;  // its multipliers are those of the violation
  return true;
}

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

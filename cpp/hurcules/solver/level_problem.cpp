#include "hurcules/solver/level_problem.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

// Householder reflections that make the first `columns` columns of a (rows, columns + 1) block
// triangular
void triangularize(Matrix& block, Index rows, Index columns) {
  for (Index j = 0; j < columns; ++j) {
    double norm2 = 0.0;
    for (Index i = j; i < rows; ++i) norm2 += block(i, j) * block(i, j);
    const double alpha = block(j, j) > 0.0 ? -std::sqrt(norm2) : std::sqrt(norm2);
    const double pivot = block(j, j) - alpha;
    if (pivot == 0.0) continue;
    // v = (pivot, block(j+1.., j)),  H = I - v v' / (-alpha pivot)
    for (Index c = j + 1; c <= columns; ++c) {
      double sum = pivot * block(j, c);
      for (Index i = j + 1; i < rows; ++i) sum += block(i, j) * block(i, c);
      const double scale = sum / (-alpha * pivot);
      block(j, c) -= scale * pivot;
      for (Index i = j + 1; i < rows; ++i) block(i, c) -= scale * block(i, j);
    }
    block(j, j) = alpha;
  }
}

}  // namespace

void LevelProblem::reserve(Index unknowns, Index rows) {
  for (Vector* v : {&lower_, &upper_}) {
    if (v->size() < rows) v->resize(rows);
  }
  for (Vector* v : {&centre_, &c_, &t_}) v->resize(unknowns);
  if (change_.size() < unknowns + rows) change_.resize(unknowns + rows);
  if (stacked_.rows() < unknowns + rows) stacked_.resize(unknowns + rows, unknowns + 1);
  candidate_row_.reserve(rows);
  row_candidate_.resize(std::max<std::size_t>(row_candidate_.size(), rows));
  slack_of_.resize(std::max<std::size_t>(slack_of_.size(), rows));
  distance.reserve(rows, unknowns + rows);
}

void LevelProblem::start(const RowTable& rows, const Chain& chain, int level,
                         const Vector& x_above) {
  level_ = level;
  begin_ = rows.begin(level);
  end_ = rows.begin(level + 1);
  first_ = chain.rank_before(level);
  own_ = chain.rank_before(level + 1) - first_;
  free_ = chain.unknowns() - first_;
  own_norm_ = 0.0;
  satisfied_ = true;
  x_scale_ = std::max(1.0, x_above.lpNorm<Eigen::Infinity>());
  for (int i = 0; i < end_; ++i) {
    const Row& row = rows[i];
    const double value = rows.dot(i, x_above);
    lower_[i] = row.lower;
    upper_[i] = row.upper;
    if (i < begin_) {
      // a row above must not get worse than it is
      lower_[i] = std::min(row.lower, value);
      upper_[i] = std::max(row.upper, value);
      continue;
    }
    own_norm_ = std::max(own_norm_, row.norm);
    const double rounding = tolerance::kZeroResidual * (row.norm * x_scale_ + std::abs(value));
    const double allowed = row.equality ? rounding : tolerance(rows, i, x_scale_, 0.0);
    if (std::abs(rows.violation(i, value)) > allowed) satisfied_ = false;
  }
}

double LevelProblem::least_settling(double largest_multiplier) const {
  return std::max(tolerance::kSettling * largest_multiplier,
                  tolerance::kNoForce * own_norm_ * own_norm_ * x_scale_);
}

double LevelProblem::tolerance(const RowTable& rows, int i, double x_scale,
                               double target_scale) const {
  return tolerance::kBroken * x_scale * rows[i].norm + tolerance::kBrokenTarget * target_scale;
}

void LevelProblem::factor(const RowTable& rows, const Chain& chain, double rho,
                          const Vector& centre) {
  rho_ = rho;
  Index count = 0;
  for (int i = begin_; i < end_; ++i) {
    if (!rows[i].equality) continue;
    const double* e = chain.coordinates(i) + first_;
    for (Index j = 0; j < own_; ++j) stacked_(count, j) = e[j];
    stacked_(count, own_) = rows[i].lower - rows.dot(i, centre);
    ++count;
  }
  if (rho > 0.0) {
    for (Index j = 0; j < own_; ++j, ++count) {
      stacked_.row(count).head(own_ + 1).setZero();
      stacked_(count, j) = rho;
    }
  }
  triangularize(stacked_, count, own_);
  c_.head(own_) = stacked_.col(own_).head(own_);
}

void LevelProblem::solve_free(const RowTable& rows, const Chain& chain, double rho,
                              const Vector& centre, Vector& x) {
  factor(rows, chain, rho, centre);
  x = centre;
  for (Index j = own_ - 1; j >= 0; --j) {
    double sum = c_[j];
    for (Index l = j + 1; l < own_; ++l) sum -= stacked_(j, l) * t_[l];
    t_[j] = sum / stacked_(j, j);
    kernels::axpy(x.size(), t_[j], chain.direction(first_ + j), x.data());
  }
}

bool LevelProblem::breaks(const RowTable& rows, const Vector& x) const {
  const double scale = std::max(1.0, x.lpNorm<Eigen::Infinity>());
  for (int i = 0; i < end_; ++i) {
    if (rows[i].equality) continue;
    const double value = rows.dot(i, x);
    const double allowed = tolerance(rows, i, scale, 0.0);
    if (value > upper_[i] + allowed || value < lower_[i] - allowed) return true;
  }
  return false;
}

void LevelProblem::fill_row(const RowTable& rows, const Chain& chain, int i, Index c, double rho) {
  const double* e = chain.coordinates(i) + first_;
  double* m = distance.row(c);
  const Index skip = minimum_norm_ ? own_ : 0;
  double part = 0.0;
  for (Index j = skip; j < free_; ++j) part += e[j] * e[j];
  if (!minimum_norm_) {
    // rho R^-T e_1
    for (Index j = 0; j < own_; ++j) {
      double sum = rho * e[j];
      for (Index l = 0; l < j; ++l) sum -= stacked_(l, j) * m[l];
      m[j] = sum / stacked_(j, j);
    }
  }
  for (Index j = own_; j < free_; ++j) m[j - skip] = e[j];
  std::fill(m + free_ - skip, m + distance.dimension(), 0.0);
  const bool slack = !minimum_norm_ && own(i);
  if (slack) m[slack_of_[i]] = rho;
  const double centre_value = rows.dot(i, centre_);
  distance.lower[c] = lower_[i] - centre_value;
  distance.upper[c] = upper_[i] - centre_value;
  // without a part in the directions of this problem nothing here can move the row
  const bool lost = std::sqrt(part) <= tolerance::kLost * rows[i].norm;
  distance.ignored[c] = rows[i].norm == 0.0 || (lost && !slack);
}

void LevelProblem::fill(const RowTable& rows, const Chain& chain, double rho,
                        const Vector& centre) {
  minimum_norm_ = false;
  factor(rows, chain, rho, centre);
  centre_ = centre;
  candidate_row_.clear();
  Index slack = free_;
  for (int i = 0; i < end_; ++i) {
    row_candidate_[i] = -1;
    if (rows[i].equality) continue;
    row_candidate_[i] = static_cast<int>(candidate_row_.size());
    candidate_row_.push_back(i);
    if (own(i)) slack_of_[i] = static_cast<int>(slack++);
  }
  distance.start(static_cast<Index>(candidate_row_.size()), slack);
  distance.target.head(slack).setZero();
  distance.target.head(own_) = c_.head(own_) / rho;
  distance.z.head(slack).setZero();
  const double target_scale = own_ ? distance.target.head(own_).lpNorm<Eigen::Infinity>() : 0.0;
  for (Index c = 0; c < distance.candidates(); ++c) {
    const int i = candidate_row_[c];
    fill_row(rows, chain, i, c, rho);
    distance.tolerance[c] = tolerance(rows, i, x_scale_, target_scale);
    if (!own(i) || distance.ignored[c]) continue;
    // an own row that is violated starts on its limit, with its slack
    const bool over = distance.upper[c] < -distance.tolerance[c];
    const bool under = distance.lower[c] > distance.tolerance[c];
    if (!over && !under) continue;
    distance.z[slack_of_[i]] = (over ? distance.upper[c] : distance.lower[c]) / rho;
    distance.add(static_cast<int>(c), over ? Side::Upper : Side::Lower);
  }
}

void LevelProblem::fill_minimum_norm(const RowTable& rows, const Chain& chain, const Vector& x,
                                     const Vector& x_above, const std::vector<char>& settled) {
  minimum_norm_ = true;
  const Index dimension = free_ - own_;
  distance.start(static_cast<Index>(candidate_row_.size()), dimension);
  distance.target.head(dimension).setZero();
  centre_ = x;
  t_ = x - x_above;
  for (Index j = 0; j < dimension; ++j) {
    const double* q = chain.direction(first_ + own_ + j);
    distance.z[j] = kernels::dot(x.size(), q, t_.data());
    kernels::axpy(x.size(), -distance.z[j], q, centre_.data());
  }
  for (Index c = 0; c < distance.candidates(); ++c) {
    const int i = candidate_row_[c];
    fill_row(rows, chain, i, c, 0.0);
    distance.tolerance[c] = tolerance(rows, i, x_scale_, 0.0);
    if (!settled[i]) continue;
    distance.lower[c] = distance.upper[c] = rows.dot(i, x) - rows.dot(i, centre_);
    if (distance.ignored[c] || !distance.add(static_cast<int>(c), Side::Upper, true)) {
      distance.ignored[c] = 1;  // the rows held already fix it
    }
  }
}

void LevelProblem::read_x(const Chain& chain, Vector& x) {
  x = centre_;
  const Index n = x.size();
  const Index own = minimum_norm_ ? 0 : own_;
  // t_1 = rho R^-1 z_1
  for (Index j = own - 1; j >= 0; --j) {
    double sum = rho_ * distance.z[j];
    for (Index l = j + 1; l < own; ++l) sum -= stacked_(j, l) * t_[l];
    t_[j] = sum / stacked_(j, j);
    kernels::axpy(n, t_[j], chain.direction(first_ + j), x.data());
  }
  for (Index j = own; j < free_ - (own_ - own); ++j) {
    kernels::axpy(n, distance.z[j], chain.direction(first_ + own_ - own + j), x.data());
  }
}

void LevelProblem::refine(const RowTable& rows, const Chain& chain, Vector& x) {
  for (int pass = 0; pass < 2; ++pass) {
    double worst = 0.0;
    const auto& active = distance.active();
    for (std::size_t s = 0; s < active.size(); ++s) {
      const int i = candidate_row_[active[s].candidate];
      const double slack = !minimum_norm_ && own(i) ? rho_ * distance.z[slack_of_[i]] : 0.0;
      const double limit = distance.limit(active[s].candidate, active[s].side);
      change_[s] = rows.dot(i, centre_) + limit - (rows.dot(i, x) + slack);
      worst = std::max(worst, std::abs(change_[s]));
    }
    if (worst <= tolerance::kMiss * std::max(1.0, x.lpNorm<Eigen::Infinity>())) return;
    distance.correct(change_);
    read_x(chain, x);
  }
}

}  // namespace hurcules

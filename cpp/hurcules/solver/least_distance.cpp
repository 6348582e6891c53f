#include "hurcules/solver/least_distance.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

using kernels::axpy;
using kernels::dot;

void LeastDistance::reserve(Index candidates, Index dimension) {
  if (M_.rows() < candidates || M_.cols() < dimension) {
    M_.resize(candidates, dimension);
    F_.resize(dimension + 1, dimension + 1);
    V_.resize(dimension + 1, dimension);
  }
  for (Vector* v : {&lower, &upper, &tolerance}) v->resize(M_.rows());
  for (Vector* v : {&target, &z, &direction_, &from_}) v->resize(M_.cols());
  for (Vector* v : {&u_, &work_, &r_}) v->resize(M_.cols() + 1);
  active_.reserve(M_.cols() + 1);
  ignored.resize(M_.rows());
  held_.resize(M_.rows());
}

void LeastDistance::start(Index candidates, Index dimension) {
  candidates_ = candidates;
  dimension_ = dimension;
  active_.clear();
  std::fill_n(ignored.begin(), candidates, 0);
  std::fill_n(held_.begin(), candidates, 0);
}

void LeastDistance::clear() {
  for (const ActiveSlot& a : active_) held_[a.candidate] = 0;
  active_.clear();
}

bool LeastDistance::feasible() const {
  Side side = Side::Upper;
  return most_broken(side, 1.0) < 0;
}

double LeastDistance::project(double* v, double* l, Index count) const {
  double before = std::sqrt(dot(dimension_, v, v)), left = before;
  std::fill(l, l + count, 0.0);
  for (int pass = 0; pass < 3; ++pass) {
    for (Index j = 0; j < count; ++j) {
      const double part = dot(dimension_, V_.row(j).data(), v);
      l[j] += part;
      axpy(dimension_, -part, V_.row(j).data(), v);
    }
    left = std::sqrt(dot(dimension_, v, v));
    if (left >= 0.5 * before) break;
    before = left;
  }
  return left;
}

bool LeastDistance::add(int candidate, Side side, bool fixed) {
  const Index count = static_cast<Index>(active_.size());
  if (count == dimension_) return false;
  double* v = V_.row(count).data();
  const double sign = static_cast<double>(side);
  const double* m = row(candidate);
  for (Index j = 0; j < dimension_; ++j) v[j] = sign * m[j];
  const double norm = std::sqrt(dot(dimension_, m, m));
  const double left = project(v, F_.row(count).data(), count);
  if (left <= tolerance::kDependent * norm) return false;
  for (Index j = 0; j < dimension_; ++j) v[j] /= left;
  F_(count, count) = left;
  active_.push_back({candidate, side, fixed, 0.0});
  held_[candidate] = 1;
  return true;
}

void LeastDistance::drop(Index slot) {
  const Index count = static_cast<Index>(active_.size());
  held_[active_[slot].candidate] = 0;
  active_.erase(active_.begin() + slot);
  for (Index i = slot; i + 1 < count; ++i) {
    for (Index j = 0; j <= i + 1; ++j) F_(i, j) = F_(i + 1, j);
    // rotate columns i and i+1 so that F(i, i+1) vanishes; V turns with them
    const double norm = std::hypot(F_(i, i), F_(i, i + 1));
    const double c = F_(i, i) / norm, s = F_(i, i + 1) / norm;
    F_(i, i) = norm;
    // the rows below still stand one place further down
    for (Index below = i + 2; below < count; ++below) {
      const double a = F_(below, i), b = F_(below, i + 1);
      F_(below, i) = c * a + s * b;
      F_(below, i + 1) = c * b - s * a;
    }
    for (Index j = 0; j < dimension_; ++j) {
      const double a = V_(i, j), b = V_(i + 1, j);
      V_(i, j) = c * a + s * b;
      V_(i + 1, j) = c * b - s * a;
    }
  }
}

void LeastDistance::solve_on_active() {
  const Index count = static_cast<Index>(active_.size());
  z.head(dimension_) = target.head(dimension_);
  // F u = signed limits; work = V target - u
  for (Index i = 0; i < count; ++i) {
    const ActiveSlot& a = active_[i];
    const double signed_limit = static_cast<double>(a.side) * limit(a.candidate, a.side);
    u_[i] = (signed_limit - dot(i, F_.row(i).data(), u_.data())) / F_(i, i);
    work_[i] = dot(dimension_, V_.row(i).data(), target.data()) - u_[i];
    axpy(dimension_, -work_[i], V_.row(i).data(), z.data());
  }
  // F' multipliers = work
  for (Index i = count - 1; i >= 0; --i) {
    double sum = work_[i];
    for (Index j = i + 1; j < count; ++j) sum -= F_(j, i) * active_[j].multiplier;
    active_[i].multiplier = sum / F_(i, i);
  }
}

void LeastDistance::correct(Vector& change) {
  for (Index i = 0; i < static_cast<Index>(active_.size()); ++i) {
    const double signed_change = static_cast<double>(active_[i].side) * change[i];
    u_[i] = (signed_change - dot(i, F_.row(i).data(), u_.data())) / F_(i, i);
    axpy(dimension_, u_[i], V_.row(i).data(), z.data());
  }
}

double LeastDistance::explain(int candidate, Side side, Vector& r) {
  const Index count = static_cast<Index>(active_.size());
  const double sign = static_cast<double>(side);
  for (Index j = 0; j < dimension_; ++j) direction_[j] = sign * M_(candidate, j);
  const double left = project(direction_.data(), work_.data(), count);
  for (Index i = count - 1; i >= 0; --i) {
    double sum = work_[i];
    for (Index j = i + 1; j < count; ++j) sum -= F_(j, i) * r[j];
    r[i] = sum / F_(i, i);
  }
  return left * left;
}

int LeastDistance::most_negative() const {
  double largest = 0.0;
  for (const ActiveSlot& a : active_) largest = std::max(largest, std::abs(a.multiplier));
  double worst = -tolerance::kNegative * largest;
  int slot = -1;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (active_[i].fixed || active_[i].multiplier >= worst) continue;
    worst = active_[i].multiplier;
    slot = static_cast<int>(i);
  }
  return slot;
}

double LeastDistance::value(Index candidate) const {
  return dot(dimension_, row(candidate), z.data());
}

int LeastDistance::most_broken(Side& side, double slack) const {
  double worst = slack;
  int found = -1;
  for (int c = 0; c < candidates_; ++c) {
    if (held_[c] || ignored[c]) continue;
    const double g = value(c);
    const double over = (g - upper[c]) / tolerance[c], under = (lower[c] - g) / tolerance[c];
    if (std::max(over, under) <= worst) continue;
    worst = std::max(over, under);
    side = over > under ? Side::Upper : Side::Lower;
    found = c;
  }
  return found;
}

}  // namespace hurcules

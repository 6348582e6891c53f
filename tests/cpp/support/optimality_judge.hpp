// How far an answer is from the definition of solver.md §1, from the definition alone: it shares no
// factor, working set, multiplier or tolerance with the solver.
//
// x_k is the answer of the levels 0 .. k alone. On the directions that the equality rows above
// leave free (Gram-Schmidt in long double),
//     rho^2 (x_k - x_{k-1}) + sum v_i a_i + sum mu_w side_w a_w = 0,   mu >= 0,
// over the rows above that stand at their limits; mu is found by nonnegative least squares. Where
// rho is 0 or tiny, the step has to be the smallest of those with the same violations as well:
//     (x_k - x_{k-1}) + sum over rows that settle (any sign) and rows at their limits (>= 0) = 0.
// Rounding of the rows themselves is no fault: multipliers mu cost 1e-15 mu, and the directions of
// rows whose smallest singular value at length one is sigma are known to 1e-15 / sigma (Wedin), of
// one that pushes and stands out from them by sigma likewise.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "hurcules/solver/hierarchy.hpp"
#include "support/nonnegative_least_squares.hpp"

namespace hurcules_test {

struct Verdict {
  double feasibility = 0.0;   // a row above got worse, relative to |a| max(1, |x|)
  double stationarity = 0.0;  // relative to sum |v_i||a_i| + rho^2 |t|
  double smallest = 0.0;      // rho = 0: the step is longer than needed, relative to max(1, |x|)
  [[nodiscard]] double worst() const { return std::max({feasibility, stationarity, smallest}); }
};

class OptimalityJudge {
 public:
  explicit OptimalityJudge(const hurcules::Hierarchy& levels) : levels_(levels) {}

  // of all levels; x[k] (n) is the answer of levels 0 .. k
  Verdict judge(const std::vector<hurcules::Vector>& x) {
    const hurcules::Index n = x.empty() ? 0 : x[0].size();
    Verdict all;
    Basis above;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x_above_ = k ? x[k - 1] : hurcules::Vector::Zero(n);
      x_ = x[k];
      scale_ = std::max(1.0, x_.lpNorm<Eigen::Infinity>());
      const Verdict level = judge_level(k, above);
      all.feasibility = std::max(all.feasibility, level.feasibility);
      all.stationarity = std::max(all.stationarity, level.stationarity);
      all.smallest = std::max(all.smallest, level.smallest);
      for (hurcules::Index i = 0; i < levels_[k].rows(); ++i) {
        if (equal(k, i)) above.add(row(k, i));
      }
    }
    return all;
  }

 private:
  // an orthonormal basis of the rows taken so far
  struct Basis {
    std::vector<LongVector> q;
    std::vector<LongVector> inverse;  // rows / |a| = L q; the rows of L^-1
    long double inverse2 = 0.0L;      // |L^-1|^2, at least 1 / sigma^2

    // parts: along each of q
    LongVector remove(const LongVector& y, LongVector* parts = nullptr) const {
      LongVector rest = y;
      if (parts) parts->setZero(static_cast<hurcules::Index>(q.size()));
      for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t j = 0; j < q.size(); ++j) {
          const long double part = q[j].dot(rest);
          rest -= part * q[j];
          if (parts) (*parts)[static_cast<hurcules::Index>(j)] += part;
        }
      }
      return rest;
    }
    void add(const hurcules::Vector& a, double least = kRank) {
      if (a.norm() == 0.0) return;
      LongVector parts;
      const LongVector rest = remove(a.cast<long double>() / a.norm(), &parts);
      const long double left = rest.norm();
      if (!(left > least)) return;
      q.push_back(rest / left);
      LongVector row = LongVector::Unit(a.size(), static_cast<hurcules::Index>(inverse.size()));
      for (std::size_t j = 0; j < inverse.size(); ++j) row -= parts[j] * inverse[j];
      inverse.push_back(row / left);
      inverse2 += inverse.back().squaredNorm();
    }
    // how much the directions turn, at most, when the rows at length one change by one
    [[nodiscard]] double turn() const { return std::max(1.0, std::sqrt(double(inverse2))); }
  };

  static constexpr double kRank = 1e-10;      // solver.md §1
  static constexpr double kDistinct = 1e-13;  // less is rounding
  static constexpr double kAtLimit =
      1e-9;  // a row stands at its limit, relative to |a| max(1, |x|)

  [[nodiscard]] bool equal(std::size_t k, hurcules::Index i) const {
    return levels_[k].lower[i] == levels_[k].upper[i];
  }
  [[nodiscard]] hurcules::Vector row(std::size_t k, hurcules::Index i) const {
    if (levels_[k].bounds) return hurcules::Vector::Unit(x_.size(), i);
    return levels_[k].A.row(i).transpose();
  }

  Verdict judge_level(std::size_t k, const Basis& above) {
    const hurcules::Level& level = levels_[k];
    Verdict verdict;
    Basis settled = above;
    blocking_.clear();
    for (std::size_t j = 0; j < k; ++j) {
      for (hurcules::Index i = 0; i < levels_[j].rows(); ++i) look_above(j, i, verdict);
    }
    const LongVector step = x_.cast<long double>() - x_above_.cast<long double>();
    LongVector force = level.rho * level.rho * step;
    double forces = static_cast<double>(force.norm()), largest = 0.0;
    std::vector<hurcules::Vector> touching;
    for (hurcules::Index i = 0; i < level.rows(); ++i) {
      const hurcules::Vector a = row(k, i);
      const double v = violation(k, i, a);
      force += v * a.cast<long double>();
      forces += std::abs(v) * a.norm();
      largest = std::max(largest, a.norm());
      const double at_limit = kAtLimit * a.norm() * scale_;
      if (equal(k, i) || std::abs(v) > at_limit) {
        // only equality rows have a rank to lose (solver.md §1)
        settled.add(a, equal(k, i) ? kRank : kDistinct);
      } else {
        look_limits(a, level.lower[i], level.upper[i], touching);
      }
    }
    // less than this is what an error of x by 1e-12 max(1, |x|) makes at 1e-9
    forces = std::max(forces, 1e-3 * (largest * largest + level.rho * level.rho) * scale_);
    verdict.stationarity = left_over(above, force, blocking_, forces);
    if (level.rho <= kTiny * largest) {
      touching.insert(touching.end(), blocking_.begin(), blocking_.end());
      verdict.smallest = left_over(settled, step, touching, scale_);
    }
    return verdict;
  }

  // a row of a level above: must not be worse, and may push back where it stands at its limit
  void look_above(std::size_t j, hurcules::Index i, Verdict& verdict) {
    const hurcules::Vector a = row(j, i);
    if (a.norm() == 0.0) return;
    const double before = a.dot(x_above_), now = a.dot(x_), size = a.norm() * scale_;
    const double lower = std::min(levels_[j].lower[i], before);
    const double upper = std::max(levels_[j].upper[i], before);
    const double worse = equal(j, i) ? std::abs(now - before) : std::max(now - upper, lower - now);
    verdict.feasibility = std::max(verdict.feasibility, worse / size);
    if (!equal(j, i)) look_limits(a, lower, upper, blocking_);
  }

  void look_limits(const hurcules::Vector& a, double lower, double upper,
                   std::vector<hurcules::Vector>& pushing) const {
    const double now = a.dot(x_), allowed = kAtLimit * a.norm() * scale_;
    if (a.norm() == 0.0) return;
    if (now >= upper - allowed) pushing.push_back(a / a.norm());
    if (now <= lower + allowed) pushing.push_back(-a / a.norm());
  }

  [[nodiscard]] double violation(std::size_t k, hurcules::Index i,
                                 const hurcules::Vector& a) const {
    const double value = a.dot(x_);
    return value - std::clamp(value, levels_[k].lower[i], levels_[k].upper[i]);
  }

  // what of y no nonnegative weights on `pushing` balance outside the basis, relative to `scale`
  static double left_over(const Basis& basis, const LongVector& y,
                          const std::vector<hurcules::Vector>& pushing, double scale) {
    double turn = basis.turn();
    LongMatrix C(0, y.size());
    for (const hurcules::Vector& a : pushing) {
      const LongVector free = basis.remove(a.cast<long double>());
      if (free.norm() <= kRank) continue;
      turn = std::max(turn, 1.0 / static_cast<double>(free.norm()));
      C.conservativeResize(C.rows() + 1, y.size());
      C.row(C.rows() - 1) = free.transpose();
    }
    const NonnegativeLeastSquares balance(C, basis.remove(y));
    const double rounding = kRounding * static_cast<double>(balance.weights().sum());
    return static_cast<double>(balance.residual().norm()) /
           ((scale + rounding) * (1.0 + kRounding * turn));
  }

  static constexpr double kRounding = 1e-6;  // 1e-15 counts as 1e-9
  static constexpr double kTiny = 1e-4;      // rho^2 |t| is lost in the rounding of the violations

  const hurcules::Hierarchy& levels_;
  hurcules::Vector x_, x_above_;  // (n)
  double scale_ = 1.0;
  std::vector<hurcules::Vector> blocking_;  // sides of rows above at their limits, (n) each, norm 1
};

}  // namespace hurcules_test

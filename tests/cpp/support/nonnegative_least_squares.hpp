// min |b + C' y| over y >= 0, by the active set of Lawson and Hanson; dense, small, unhurried.
//
// In long double: of generators that are 1e-10 apart the weights are 1e10 times the force, and what
// is left has to be seen beside them. So what pulls is what of b is outside the generators taken,
// by their orthonormal directions; a sum with the weights would hide it.
#pragma once

#include <Eigen/QR>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules_test {

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

class NonnegativeLeastSquares {
 public:
  // C: (m, n), each row a generator of the cone; b: (n)
  NonnegativeLeastSquares(const LongMatrix& C, const LongVector& b)
      : C_(C),
        b_(b),
        rest_(b),
        y_(LongVector::Zero(C.rows())),
        barred_(static_cast<std::size_t>(C.rows()), 0) {
    const auto most = 3 * C.rows() + 30;
    for (hurcules::Index step = 0; step < most && enter(); ++step) {
      const hurcules::Index entered = in_.back();
      settle();
      // a generator that leaves at once waits until another came in
      const bool stays = std::find(in_.begin(), in_.end(), entered) != in_.end();
      if (stays) std::fill(barred_.begin(), barred_.end(), 0);
      barred_[entered] = !stays;
    }
  }

  // b + C' y, (n)
  [[nodiscard]] LongVector residual() const { return b_ + C_.transpose() * y_; }
  // y, (m)
  [[nodiscard]] const LongVector& weights() const { return y_; }

 private:
  // takes in the generator that shortens the residual fastest
  bool enter() {
    const LongVector pull = -(C_ * rest_);
    long double best = 1e-17L * b_.norm();
    hurcules::Index entering = -1;
    for (hurcules::Index i = 0; i < pull.size(); ++i) {
      const bool taken = std::find(in_.begin(), in_.end(), i) != in_.end();
      if (taken || barred_[i] || pull[i] <= best) continue;
      best = pull[i];
      entering = i;
    }
    if (entering >= 0) in_.push_back(entering);
    return entering >= 0;
  }

  // to the minimiser on the generators taken, dropping those whose weight vanishes on the way
  void settle() {
    while (!in_.empty()) {
      LongMatrix taken(C_.cols(), static_cast<hurcules::Index>(in_.size()));
      for (std::size_t j = 0; j < in_.size(); ++j) taken.col(j) = C_.row(in_[j]).transpose();
      const Eigen::ColPivHouseholderQR<LongMatrix> factor(taken);
      const LongVector wanted = factor.solve(-b_);
      long double way = 1.0L;
      for (std::size_t j = 0; j < in_.size(); ++j) {
        if (wanted[j] <= 0.0L) way = std::min(way, y_[in_[j]] / (y_[in_[j]] - wanted[j]));
      }
      std::vector<hurcules::Index> kept;
      for (std::size_t j = 0; j < in_.size(); ++j) {
        long double& y = y_[in_[j]];
        y += way * (wanted[j] - y);
        if (way < 1.0L && wanted[j] <= 0.0L && y <= 1e-18L * std::abs(wanted[j])) y = 0.0L;
        if (y > 0.0L) kept.push_back(in_[j]);
      }
      const bool dropped = kept.size() < in_.size();
      in_ = std::move(kept);
      if (dropped) continue;
      rest_ = factor.householderQ().adjoint() * b_;
      rest_.head(factor.rank()).setZero();
      rest_.applyOnTheLeft(factor.householderQ());
      return;
    }
    rest_ = b_;
  }

  LongMatrix C_;
  LongVector b_, rest_, y_;
  std::vector<char> barred_;
  std::vector<hurcules::Index> in_;
};

}  // namespace hurcules_test

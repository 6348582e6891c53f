// min |b + C' y| over y >= 0, by the active set of Lawson and Hanson; dense, small, unhurried.
//
// In long double: of generators that are 1e-10 apart the weights are 1e10 times the force, and what
// is left has to be seen beside them.
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
      : C_(C), b_(b), y_(LongVector::Zero(C.rows())) {
    const auto most = 3 * C.rows() + 30;
    for (hurcules::Index step = 0; step < most && enter(); ++step) settle();
  }

  // b + C' y, (n)
  [[nodiscard]] LongVector residual() const { return b_ + C_.transpose() * y_; }
  // y, (m)
  [[nodiscard]] const LongVector& weights() const { return y_; }

 private:
  // takes in the generator that shortens the residual fastest
  bool enter() {
    const LongVector pull = -(C_ * residual());
    long double best = 1e-17L * (b_.norm() + y_.sum());
    hurcules::Index entering = -1;
    for (hurcules::Index i = 0; i < pull.size(); ++i) {
      if (std::find(in_.begin(), in_.end(), i) != in_.end() || pull[i] <= best) continue;
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
      const LongVector wanted = taken.colPivHouseholderQr().solve(-b_);
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
      if (!dropped) return;
    }
  }

  LongMatrix C_;
  LongVector b_, y_;
  std::vector<hurcules::Index> in_;
};

}  // namespace hurcules_test

// min |b + C' y| over y >= 0, by the active set of Lawson and Hanson; dense, small, unhurried.
#pragma once

#include <Eigen/QR>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules_test {

class NonnegativeLeastSquares {
 public:
  // C: (m, n), each row a generator of the cone; b: (n)
  NonnegativeLeastSquares(const hurcules::Matrix& C, const hurcules::Vector& b)
      : C_(C), b_(b), y_(hurcules::Vector::Zero(C.rows())) {
    const auto most = 3 * C.rows() + 30;
    for (hurcules::Index step = 0; step < most && enter(); ++step) settle();
  }

  // b + C' y, (n)
  [[nodiscard]] hurcules::Vector residual() const { return b_ + C_.transpose() * y_; }
  // y, (m)
  [[nodiscard]] const hurcules::Vector& weights() const { return y_; }

 private:
  // takes in the generator that shortens the residual fastest
  bool enter() {
    const hurcules::Vector pull = -(C_ * residual());
    double best = 1e-14 * b_.norm();
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
      hurcules::Matrix taken(C_.cols(), static_cast<hurcules::Index>(in_.size()));
      for (std::size_t j = 0; j < in_.size(); ++j) taken.col(j) = C_.row(in_[j]).transpose();
      const hurcules::Vector wanted = taken.colPivHouseholderQr().solve(-b_);
      double way = 1.0;
      for (std::size_t j = 0; j < in_.size(); ++j) {
        if (wanted[j] <= 0.0) way = std::min(way, y_[in_[j]] / (y_[in_[j]] - wanted[j]));
      }
      std::vector<hurcules::Index> kept;
      for (std::size_t j = 0; j < in_.size(); ++j) {
        double& y = y_[in_[j]];
        y += way * (wanted[j] - y);
        if (way < 1.0 && wanted[j] <= 0.0 && y <= 1e-15 * std::abs(wanted[j])) y = 0.0;
        if (y > 0.0) kept.push_back(in_[j]);
      }
      const bool dropped = kept.size() < in_.size();
      in_ = std::move(kept);
      if (!dropped) return;
    }
  }

  const hurcules::Matrix& C_;
  hurcules::Vector b_, y_;
  std::vector<hurcules::Index> in_;
};

}  // namespace hurcules_test

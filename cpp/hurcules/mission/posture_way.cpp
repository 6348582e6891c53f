#include "hurcules/mission/posture_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hurcules {

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
}

std::vector<Index> coordinates_of(const std::string& name,
                                  const std::vector<std::string>& coordinates) {
  std::vector<Index> found;
  for (const std::string& wanted : {name, "L" + name, "R" + name}) {
    const auto at = std::find(coordinates.begin(), coordinates.end(), wanted);
    if (at == coordinates.end()) continue;
    found.push_back(at - coordinates.begin());
    if (wanted == name) break;
  }
  return found;
}

PostureWay::PostureWay(const std::vector<PostureKey>& keys,
                       const std::vector<std::string>& coordinates, double seconds, bool rounded)
    : seconds_(seconds), rounded_(rounded) {
  const auto n = static_cast<Index>(coordinates.size()), k = static_cast<Index>(keys.size());
  shares_ = Vector::Zero(k + 1);
  angles_ = Matrix::Constant(n, k, std::numeric_limits<double>::quiet_NaN());
  points_ = slopes_ = Matrix::Zero(n, k + 1);
  now_ = next_ = Vector::Zero(n);
  for (Index i = 0; i < k; ++i) {
    const PostureKey& key = keys[static_cast<std::size_t>(i)];
    shares_[i + 1] = key.share;
    for (const auto& [name, angle] : key.angles) {
      for (const Index at : coordinates_of(name, coordinates)) angles_(at, i) = angle;
    }
  }
}

void PostureWay::start(const Vector& q) {
  points_.col(0) = q;
  fill();
}

void PostureWay::restore(StateReader& reader) {
  reader.get(now_);
  start(now_);
}

// what a key does not name stays as at the start
void PostureWay::fill() {
  for (Index i = 0; i < angles_.cols(); ++i) {
    points_.col(i + 1) = angles_.col(i).array().isNaN().select(points_.col(0), angles_.col(i));
  }
  if (!rounded_) return;
  const auto line = [this](Index c, Index i) {
    return (points_(c, i + 1) - points_(c, i)) / (shares_[i + 1] - shares_[i]);
  };
  const Index last = angles_.cols();
  for (Index c = 0; c < points_.rows(); ++c) {
    for (Index i = 0; i <= last; ++i) {
      const double a = line(c, std::max<Index>(i - 1, 0)), b = line(c, std::min(i, last - 1));
      slopes_(c, i) = a * b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
    }
  }
}

void PostureWay::place(double time, Vector& q) const {
  const double u = smooth_step(time / seconds_);
  Index i = 1;
  while (i + 1 < shares_.size() && u > shares_[i]) ++i;
  const double along = (u - shares_[i - 1]) / (shares_[i] - shares_[i - 1]);
  if (!rounded_) {
    q = points_.col(i - 1) + along * (points_.col(i) - points_.col(i - 1));
    return;
  }
  const double span = shares_[i] - shares_[i - 1], back = 1.0 - along;
  q = (back * back * (1.0 + 2.0 * along)) * points_.col(i - 1) +
      (along * along * (1.0 + 2.0 * back)) * points_.col(i) +
      (span * along * back) * (back * slopes_.col(i - 1) - along * slopes_.col(i));
}

void PostureWay::velocity(double time, double dt, VectorRef out) {
  place(time, now_);
  place(time + dt, next_);
  out = (next_ - now_) / dt;
}

}  // namespace hurcules

#include "hurcules/tasks/angle.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {
namespace {

Jet component(const PointMotion& p, Index i) {
  return {p.position[i], p.velocity[i], p.drift[i]};
}

// half width of the cone at the end of p
double fade_width(const PointMotion& p) {
  return kFade * std::max(p.position.norm(), kShort);
}

}  // namespace

Jet operator+(const Jet& a, const Jet& b) {
  return {a.value + b.value, a.rate + b.rate, a.acceleration + b.acceleration};
}

Jet operator-(const Jet& a, const Jet& b) {
  return {a.value - b.value, a.rate - b.rate, a.acceleration - b.acceleration};
}

Jet operator*(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.acceleration * b.value + 2 * a.rate * b.rate + a.value * b.acceleration};
}

Jet dot(const VectorJet& a, const VectorJet& b) {
  return {a.value.dot(b.value), a.rate.dot(b.value) + a.value.dot(b.rate),
          a.acceleration.dot(b.value) + 2 * a.rate.dot(b.rate) + a.value.dot(b.acceleration)};
}

Jet root(const Jet& square, double least) {
  const double value = std::sqrt(square.value);
  const double divisor = std::max(value, least);
  const double rate = square.rate / (2 * divisor);
  return {value, rate, square.acceleration / (2 * divisor) - rate * rate / divisor};
}

Jet arc_tangent(const Jet& y, const Jet& x, double least) {
  const double square = x.value * x.value + y.value * y.value;
  const double divisor = std::max(square, least * least);
  const double rate = (x.value * y.rate - y.value * x.rate) / divisor;
  const double stretch = 2 * (x.value * x.rate + y.value * y.rate) / divisor;
  const double turn = (x.value * y.acceleration - y.value * x.acceleration) / divisor;
  return {std::atan2(y.value, x.value), rate, turn - rate * stretch};
}

Angle azimuth(const PointMotion& p) {
  const double least = fade_width(p);
  const Jet angle = arc_tangent(component(p, 1), component(p, 0), least);
  const double x = p.position.x(), y = p.position.y();
  const double square = std::max(x * x + y * y, least * least);
  return {angle.value, angle.acceleration, Vector3(-y, x, 0) / square};
}

Angle elevation(const PointMotion& p) {
  const double least = fade_width(p);
  const Jet x = component(p, 0), y = component(p, 1), z = component(p, 2);
  const Jet level = root(x * x + y * y, least);
  const Jet angle = arc_tangent(z, level, least);

  const double slope = -z.value / std::max(level.value, least);
  const Vector3 turn(slope * x.value, slope * y.value, level.value);
  return {angle.value, angle.acceleration,
          turn / std::max(p.position.squaredNorm(), least * least)};
}

}  // namespace hurcules

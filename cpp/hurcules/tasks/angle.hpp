// Angles of a vector that moves: value, gradient and acceleration.
//
//   angle = atan2(y, x); its rate and its acceleration follow from those of x and y.
// Where x and y vanish together an angle has no value. Inside a narrow cone about that place the
// derivatives fade linearly to zero; outside they are exact.
#pragma once

#include "hurcules/tasks/reference.hpp"

namespace hurcules {

// sine of the half angle of the cone, 1.1 degrees: derivatives stay below 50 rad per rad
inline constexpr double kFade = 0.02;
// [m] a shorter vector fades as if it were this long
inline constexpr double kShort = 0.01;

// A number or a vector on its way: its value, its rate, its acceleration.
struct Jet {
  double value = 0.0, rate = 0.0, acceleration = 0.0;
};
struct VectorJet {
  Vector3 value, rate, acceleration;
};
[[nodiscard]] Jet operator+(const Jet& a, const Jet& b);
[[nodiscard]] Jet operator-(const Jet& a, const Jet& b);
[[nodiscard]] Jet operator*(const Jet& a, const Jet& b);
[[nodiscard]] Jet dot(const VectorJet& a, const VectorJet& b);
// derivatives fade where the root, or the length of (x, y), is below `least`
[[nodiscard]] Jet root(const Jet& square, double least);
[[nodiscard]] Jet arc_tangent(const Jet& y, const Jet& x, double least);

// An angle of a vector p.
struct Angle {
  double value = 0.0;                  // [rad]
  double drift = 0.0;                  // [rad/s^2]
  Vector3 gradient = Vector3::Zero();  // d angle / d p, [rad] over the unit of p
};
// about z, from x: atan2(y, x); fades where p is along z
[[nodiscard]] Angle azimuth(const PointMotion& p);
// over the x-y plane: atan2(z, |(x, y)|), at most pi/2; fades where p is along z
[[nodiscard]] Angle elevation(const PointMotion& p);

}  // namespace hurcules

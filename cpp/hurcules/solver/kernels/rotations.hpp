// Plane rotations that make rows orthogonal; part of impl.hpp.
#pragma once

namespace hurcules::kernels {
namespace {

void rotate(Size size, double c, double s, double* a, double* b) {
  const Pack cosine = spread(c), sine = spread(s);
  for (Size j = 0; j < size; j += kWidth) {
    const Pack p = load(a + j), q = load(b + j);
    store(a + j, cosine * p + sine * q);
    store(b + j, cosine * q - sine * p);
  }
}

// dot for the few numbers of a small problem: no second sum, no call
inline double short_dot(Size size, const double* a, const double* b) {
  Pack s = load(a) * load(b);
  for (Size j = kWidth; j < size; j += kWidth) s += load(a + j) * load(b + j);
  return sum(s);
}

// c = x . y of rows with |x|^2 = a and |y|^2 = b becomes 0 by a rotation with the tangent
// t = e / (|d| + |(d, e)|),  d = b - a,  e = 2 c with the sign of d c;  false where c is 0 already
inline bool make_orthogonal(Size size, Size stride, double smallest, double* x, double* y,
                            double& a, double& b) {
  const double c = short_dot(size, x, y);
  if (c * c <= smallest * smallest * a * b) return false;
  const double d = b - a, e = d < 0.0 ? -2.0 * c : 2.0 * c;
  const double u = (d < 0.0 ? -d : d) + __builtin_sqrt(d * d + e * e);
  const double scale = 1.0 / __builtin_sqrt(u * u + e * e);
  rotate(stride, u * scale, -e * scale, x, y);
  const double moved = e / u * c;
  a -= moved;
  b += moved;
  return true;
}

// Rounds of pairs that share no row, so that the processor works on several at a time: i + j = s
// modulo an odd number; an even one has a last row for the one that is left over.
bool sweep(double* rows, Size count, Size size, Size stride, double smallest, double* squares) {
  bool rotated = false;
  const auto pair = [&](Size i, Size j) {
    rotated |= make_orthogonal(size, stride, smallest, rows + i * stride, rows + j * stride,
                               squares[i], squares[j]);
  };
  for (Size i = 0; i < count; ++i) {
    squares[i] = short_dot(size, rows + i * stride, rows + i * stride);
  }
  const Size rounds = count % 2 ? count : count - 1;
  for (Size s = 0; s < rounds; ++s) {
    for (Size i = 0; i < rounds; ++i) {
      const Size j = s >= i ? s - i : s - i + rounds;
      if (i < j) pair(i, j);
      if (i == j && rounds < count) pair(i, rounds);
    }
  }
  return rotated;
}

}  // namespace
}  // namespace hurcules::kernels

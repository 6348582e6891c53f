// Plane rotations that make rows orthogonal; part of kernels_impl.hpp.
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

inline bool make_orthogonal(Size size, Size stride, double smallest, double* x, double* y,
                            double& a, double& b) {
  const double c = dot(size, x, y);
  if (c * c <= smallest * smallest * a * b) return false;
  const double d = b - a, e = 2.0 * c;
  const double t = (d < 0.0 ? -e : e) / ((d < 0.0 ? -d : d) + __builtin_sqrt(d * d + e * e));
  const double cosine = 1.0 / __builtin_sqrt(1.0 + t * t);
  rotate(stride, cosine, -cosine * t, x, y);
  a -= t * c;
  b += t * c;
  return true;
}

// The pairs i + j = s (mod count) share no row, so the processor works on several at a time.
bool sweep(double* rows, Size count, Size size, Size stride, double smallest, double* squares) {
  bool rotated = false;
  for (Size i = 0; i < count; ++i) squares[i] = dot(size, rows + i * stride, rows + i * stride);
  for (Size s = 0; s < count; ++s) {
    for (Size i = 0; i < count; ++i) {
      const Size j = s >= i ? s - i : s - i + count;
      if (i >= j) continue;
      rotated |= make_orthogonal(size, stride, smallest, rows + i * stride, rows + j * stride,
                                 squares[i], squares[j]);
    }
  }
  return rotated;
}

}  // namespace
}  // namespace hurcules::kernels

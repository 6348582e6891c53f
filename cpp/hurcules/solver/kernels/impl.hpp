// The loops of kernels.hpp for vectors of kWidth doubles. Included by one source per instruction
// set; everything has internal linkage, so that no code of one set can stand in for another's.
#pragma once

#include "hurcules/solver/kernels/vectors.hpp"

namespace hurcules::kernels {
namespace {

double dot(Size size, const double* a, const double* b) {
  Pack s = {}, t = {};
  Size j = 0;
  for (; j + 2 * kWidth <= size; j += 2 * kWidth) {
    s += load(a + j) * load(b + j);
    t += load(a + j + kWidth) * load(b + j + kWidth);
  }
  if (j < size) s += load(a + j) * load(b + j);
  return sum(s + t);
}

void axpy(Size size, double s, const double* x, double* y) {
  const Pack scale = spread(s);
  for (Size j = 0; j < size; j += kWidth) store(y + j, load(y + j) + scale * load(x + j));
}

void scale(Size size, double s, const double* x, double* y) {
  for (Size j = 0; j < size; j += kWidth) store(y + j, s * load(x + j));
}

void advance(Size size, double way, const double* target, double* x) {
  for (Size j = 0; j < size; j += kWidth) {
    const Pack here = load(x + j);
    store(x + j, here + way * (load(target + j) - here));
  }
}

struct FourRows {
  const double *a, *b, *c, *d;
};

inline void four_dots(FourRows rows, Size size, const double* x, double* out) {
  Pack a = {}, b = {}, c = {}, d = {};
  for (Size j = 0; j < size; j += kWidth) {
    const Pack v = load(x + j);
    a += v * load(rows.a + j);
    b += v * load(rows.b + j);
    c += v * load(rows.c + j);
    d += v * load(rows.d + j);
  }
  sums(a, b, c, d, out);
}

inline void four_dots(const double* r, Size stride, const double* x, double* out) {
  four_dots({r, r + stride, r + 2 * stride, r + 3 * stride}, stride, x, out);
}

void dots(const double* rows, Size count, Size stride, const double* x, double* out) {
  Size i = 0;
  for (; i + 4 <= count; i += 4) four_dots(rows + i * stride, stride, x, out + i);
  if (i == count) return;
  double last[4];
  four_dots(rows + i * stride, stride, x, last);
  for (Size l = 0; i < count; ++i, ++l) out[i] = last[l];
}

#if HURCULES_KERNEL_WIDTH == 4
inline void transpose_block(const double* r, Size stride, double* out) {
  const Pack a = load(r), b = load(r + stride), c = load(r + 2 * stride), d = load(r + 3 * stride);
  const Pack ab = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Pack ba = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Pack cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Pack dc = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  store(out, __builtin_shufflevector(ab, cd, 0, 1, 4, 5));
  store(out + stride, __builtin_shufflevector(ba, dc, 0, 1, 4, 5));
  store(out + 2 * stride, __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
  store(out + 3 * stride, __builtin_shufflevector(ba, dc, 2, 3, 6, 7));
}
#else
inline void transpose_block(const double* r, Size stride, double* out) {
  const Pack a = load(r), b = load(r + stride);
  store(out, __builtin_shufflevector(a, b, 0, 2));
  store(out + stride, __builtin_shufflevector(a, b, 1, 3));
}
#endif

void transpose(const double* rows, Size count, Size stride, double* out) {
  for (Size i = 0; i < count; i += kWidth) {
    for (Size j = 0; j < stride; j += kWidth) {
      transpose_block(rows + i * stride + j, stride, out + j * stride + i);
    }
  }
}

void norms2(const double* rows, Size count, Size stride, double* out) {
  Size i = 0;
  for (; i + 4 <= count; i += 4) {
    const double* r = rows + i * stride;
    Pack a = {}, b = {}, c = {}, d = {};
    for (Size j = 0; j < stride; j += kWidth) {
      const Pack p = load(r + j), q = load(r + stride + j);
      const Pack s = load(r + 2 * stride + j), t = load(r + 3 * stride + j);
      a += p * p;
      b += q * q;
      c += s * s;
      d += t * t;
    }
    sums(a, b, c, d, out + i);
  }
  for (; i < count; ++i) out[i] = dot(stride, rows + i * stride, rows + i * stride);
}

void copy_rows(const double* from, Size count, Size length, double* to, Size stride) {
  for (Size i = 0; i < count; ++i, from += length, to += stride) {
    if (length < kWidth) {
      for (Size j = 0; j < length; ++j) to[j] = from[j];
      continue;
    }
    for (Size j = 0; j + kWidth < length; j += kWidth) store(to + j, load(from + j));
    // the last numbers, some of them once more
    store(to + length - kWidth, load(from + length - kWidth));
  }
}

double scaled_difference(Size size, double s, const double* a, const double* b, double* out) {
  Pack total = {};
  for (Size j = 0; j < size; j += kWidth) {
    const Pack d = s * (load(a + j) - load(b + j));
    store(out + j, d);
    total += d * d;
  }
  return sum(total);
}

void take_squares(const double* rows, Size count, Size stride, double* rest) {
  for (Size j = 0; j < stride; j += kWidth) {
    Pack left = load(rest + j);
    for (Size i = 0; i < count; ++i) {
      const Pack q = load(rows + i * stride + j);
      left -= q * q;
    }
    store(rest + j, left);
  }
}

double norm2_along(const double* rows, Size count, Size stride, const double* x) {
  double total = 0.0;
  double part[4];
  for (Size i = 0; i < count; i += 4) {
    four_dots(rows + i * stride, stride, x, part);
    for (Size l = 0; l < 4 && i + l < count; ++l) total += part[l] * part[l];
  }
  return total;
}

double largest_way(const double* rows, Size count, Size stride, const double* x,
                   const double* norm) {
  double worst = 0.0;
  double part[4];
  for (Size i = 0; i < count; i += 4) {
    four_dots(rows + i * stride, stride, x, part);
    for (Size l = 0; l < 4 && i + l < count; ++l) {
      const double way = part[l] > 0.0 ? part[l] : -part[l];
      if (way > worst * norm[i + l]) worst = way / norm[i + l];
    }
  }
  return worst;
}

// NaN, where there is one
double largest(Size size, const double* x) {
  Pack high = {}, low = {}, bad = {};
  for (Size j = 0; j < size; j += kWidth) {
    const Pack v = load(x + j);
    bad += v - v;
    high = v > high ? v : high;
    low = v < low ? v : low;
  }
  high = high > -low ? high : -low;
  double result = high[0];
  for (int l = 1; l < kWidth; ++l) result = high[l] > result ? high[l] : result;
  return result + sum(bad);
}

}  // namespace
}  // namespace hurcules::kernels

#include "hurcules/solver/kernels/limits.hpp"
#include "hurcules/solver/kernels/rotations.hpp"
#include "hurcules/solver/kernels/rows.hpp"

namespace hurcules::kernels {
namespace {

constexpr Table kTable = {
    .name = kName,
    .dot = dot,
    .axpy = axpy,
    .scale = scale,
    .advance = advance,
    .rotate = rotate,
    .sweep = sweep,
    .dots = dots,
    .axpys = axpys,
    .project = project,
    .project_split = project_split,
    .eliminate = eliminate,
    .reflect = reflect,
    .copy_rows = copy_rows,
    .scaled_difference = scaled_difference,
    .norm2_along = norm2_along,
    .largest_way = largest_way,
    .take_squares = take_squares,
    .transpose = transpose,
    .take_directions = take_directions,
    .norms2 = norms2,
    .largest = largest,
    .worst_excess = worst_excess,
    .first_blocking = first_blocking,
    .worsened = worsened,
    .widen = widen,
};

}  // namespace
}  // namespace hurcules::kernels

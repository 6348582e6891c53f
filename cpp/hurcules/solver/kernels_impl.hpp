// The loops of kernels.hpp for vectors of kWidth doubles. Included by one source per instruction
// set; everything has internal linkage, so that no code of one set can stand in for another's.
#pragma once

#include <cstring>
#include <limits>

#include "hurcules/solver/kernels.hpp"

namespace hurcules::kernels {
namespace {

constexpr int kWidth = HURCULES_KERNEL_WIDTH;
constexpr const char* kName = kWidth == 4 ? "avx2" : "baseline";

using Pack = double __attribute__((vector_size(kWidth * sizeof(double))));
using Mask = long long __attribute__((vector_size(kWidth * sizeof(double))));

constexpr double kInfinite = std::numeric_limits<double>::infinity();

inline Pack load(const double* p) {
  Pack v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, Pack v) {
  std::memcpy(p, &v, sizeof v);
}
inline Pack spread(double s) {
  return Pack{} + s;
}
inline double sum(Pack v) {
  double total = v[0];
  for (int i = 1; i < kWidth; ++i) total += v[i];
  return total;
}

// some number of the mask is set
inline bool any(Mask mask) {
#if HURCULES_KERNEL_WIDTH == 4
  return __builtin_ia32_movmskpd256(reinterpret_cast<Pack>(mask)) != 0;
#else
  return (mask[0] | mask[1]) != 0;
#endif
}

// four sums at once
inline void sums(Pack a, Pack b, Pack c, Pack d, double* out) {
#if HURCULES_KERNEL_WIDTH == 4
  const Pack ab =
      __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Pack cd =
      __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  store(out,
        __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
#else
  store(out, __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3));
  store(out + 2, __builtin_shufflevector(c, d, 0, 2) + __builtin_shufflevector(c, d, 1, 3));
#endif
}

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

void rotate(Size size, double c, double s, double* a, double* b) {
  const Pack cosine = spread(c), sine = spread(s);
  for (Size j = 0; j < size; j += kWidth) {
    const Pack p = load(a + j), q = load(b + j);
    store(a + j, cosine * p + sine * q);
    store(b + j, cosine * q - sine * p);
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

// y in registers while the rows pass
template <int packs>
void axpys_of(const double* rows, Size count, Size stride, const double* s, double* y) {
  Pack sum[packs];
  for (int p = 0; p < packs; ++p) sum[p] = load(y + p * kWidth);
  for (Size i = 0; i < count; ++i) {
    const double* r = rows + i * stride;
    const Pack scale = spread(s[i]);
    for (int p = 0; p < packs; ++p) sum[p] += scale * load(r + p * kWidth);
  }
  for (int p = 0; p < packs; ++p) store(y + p * kWidth, sum[p]);
}

void axpys_of_any(const double* rows, Size count, Size stride, const double* s, double* y) {
  Size i = 0;
  for (; i + 4 <= count; i += 4) {
    const double* r = rows + i * stride;
    const Pack s0 = spread(s[i]), s1 = spread(s[i + 1]), s2 = spread(s[i + 2]),
               s3 = spread(s[i + 3]);
    for (Size j = 0; j < stride; j += kWidth) {
      const Pack left = s0 * load(r + j) + s1 * load(r + stride + j);
      const Pack right = s2 * load(r + 2 * stride + j) + s3 * load(r + 3 * stride + j);
      store(y + j, load(y + j) + (left + right));
    }
  }
  for (; i < count; ++i) axpy(stride, s[i], rows + i * stride, y);
}

void axpys(const double* rows, Size count, Size stride, const double* s, double* y) {
  switch (stride / kWidth) {
    case 1:
      return axpys_of<1>(rows, count, stride, s, y);
    case 2:
      return axpys_of<2>(rows, count, stride, s, y);
    case 3:
      return axpys_of<3>(rows, count, stride, s, y);
    case 4:
      return axpys_of<4>(rows, count, stride, s, y);
    case 5:
      return axpys_of<5>(rows, count, stride, s, y);
    case 6:
      return axpys_of<6>(rows, count, stride, s, y);
    case 8:
      return axpys_of<8>(rows, count, stride, s, y);
    case 10:
      return axpys_of<10>(rows, count, stride, s, y);
    default:
      return axpys_of_any(rows, count, stride, s, y);
  }
}

double project(const double* rows, Size count, Size stride, double* v, double* part) {
  Pack left = {};
  for (Size i = 0; i < count; i += 4) {
    // in place of rows behind the last, that row once more, and no part of it
    const Size last = count - 1;
    const auto row = [&](Size l) { return rows + (i + l < last ? i + l : last) * stride; };
    const FourRows r = {row(0), row(1), row(2), row(3)};
    double p[4];
    four_dots(r, stride, v, p);
    for (Size l = 0; l < 4; ++l) {
      if (i + l > last) p[l] = 0.0;
      part[i + l] += p[l];
    }
    const Pack p0 = spread(p[0]), p1 = spread(p[1]), p2 = spread(p[2]), p3 = spread(p[3]);
    left = Pack{};
    for (Size j = 0; j < stride; j += kWidth) {
      const Pack near = p0 * load(r.a + j) + p1 * load(r.b + j);
      const Pack far = p2 * load(r.c + j) + p3 * load(r.d + j);
      const Pack rest = load(v + j) - (near + far);
      store(v + j, rest);
      left += rest * rest;
    }
  }
  return sum(left);
}

// with_side: side[i] -= part of row i times `value`, too
template <bool with_side>
inline void eliminate_rows(const double* pivot, double scale, double* rows, Size count, Size stride,
                           double* coordinates, double* side, double value) {
  for (Size i = 0; i < count; i += 4) {
    double* r = rows + i * stride;
    double part[4];
    four_dots(r, stride, pivot, part);
    for (int l = 0; l < 4; ++l) part[l] *= scale;
    for (int l = 0; l < 4; ++l) coordinates[(i + l) * stride] = part[l];
    if constexpr (with_side) {
      for (int l = 0; l < 4; ++l) side[i + l] -= value * part[l];
    }
    const Pack s0 = spread(scale * part[0]), s1 = spread(scale * part[1]),
               s2 = spread(scale * part[2]), s3 = spread(scale * part[3]);
    for (Size j = 0; j < stride; j += kWidth) {
      const Pack v = load(pivot + j);
      store(r + j, load(r + j) - s0 * v);
      store(r + stride + j, load(r + stride + j) - s1 * v);
      store(r + 2 * stride + j, load(r + 2 * stride + j) - s2 * v);
      store(r + 3 * stride + j, load(r + 3 * stride + j) - s3 * v);
    }
  }
}

void eliminate(const double* pivot, double scale, double* rows, Size count, Size stride,
               double* coordinates) {
  eliminate_rows<false>(pivot, scale, rows, count, stride, coordinates, nullptr, 0.0);
}

Size take_directions(Directions& d, Size first, Size end, double clean) {
  for (Size i = first; i < end; ++i) {
    const double* v = d.rest + i * d.stride;
    const double left = dot(d.stride, v, v);
    if (d.rank == d.columns || !(left > clean * d.norm2[i])) return i;
    const double length = __builtin_sqrt(left), scale = 1.0 / length;
    double* q = d.Q + d.rank * d.stride;
    double* l = d.L + i * d.stride + d.rank;
    for (Size j = 0; j < d.stride; j += kWidth) store(q + j, scale * load(v + j));
    *l = length;
    d.pivot[d.rank++] = i;
    double* rows = d.rest + (i + 1) * d.stride;
    if (d.side) {
      // the side column is met row by row, as the rows are
      d.side[i] *= scale;
      eliminate_rows<true>(v, scale, rows, d.rows - i - 1, d.stride, l + d.stride, d.side + i + 1,
                           d.side[i]);
    } else {
      eliminate(v, scale, rows, d.rows - i - 1, d.stride, l + d.stride);
    }
  }
  return end;
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

#include "hurcules/solver/kernels_limits.hpp"

namespace hurcules::kernels {
namespace {

constexpr Table kTable = {
    .name = kName,
    .dot = dot,
    .axpy = axpy,
    .scale = scale,
    .advance = advance,
    .rotate = rotate,
    .dots = dots,
    .axpys = axpys,
    .project = project,
    .eliminate = eliminate,
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

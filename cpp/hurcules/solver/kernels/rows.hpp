// The kernels that add rows up and take them apart; part of impl.hpp.
#pragma once

namespace hurcules::kernels {
namespace {

void axpys(const double* rows, Size count, Size stride, const double* s, double* y) {
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

void reflect(double* rows, Size count, Size size, Size stride, const double* v, double scale,
             double* sum) {
  for (Size j = 0; j < size; j += kWidth) store(sum + j, Pack{});
  Size i = 0;
  for (; i + 4 <= count; i += 4) {
    const double* r = rows + i * stride;
    const Pack v0 = spread(v[i]), v1 = spread(v[i + 1]), v2 = spread(v[i + 2]),
               v3 = spread(v[i + 3]);
    for (Size j = 0; j < size; j += kWidth) {
      const Pack left = v0 * load(r + j) + v1 * load(r + stride + j);
      const Pack right = v2 * load(r + 2 * stride + j) + v3 * load(r + 3 * stride + j);
      store(sum + j, load(sum + j) + (left + right));
    }
  }
  for (; i < count; ++i) axpy(size, v[i], rows + i * stride, sum);
  for (i = 0; i + 4 <= count; i += 4) {
    double* r = rows + i * stride;
    const Pack v0 = spread(scale * v[i]), v1 = spread(scale * v[i + 1]),
               v2 = spread(scale * v[i + 2]), v3 = spread(scale * v[i + 3]);
    for (Size j = 0; j < size; j += kWidth) {
      const Pack s = load(sum + j);
      store(r + j, load(r + j) - v0 * s);
      store(r + stride + j, load(r + stride + j) - v1 * s);
      store(r + 2 * stride + j, load(r + 2 * stride + j) - v2 * s);
      store(r + 3 * stride + j, load(r + 3 * stride + j) - v3 * s);
    }
  }
  for (; i < count; ++i) axpy(size, -scale * v[i], sum, rows + i * stride);
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

void project_split(const double* rows_high, const double* rows_low, Size count, Size stride,
                   Split v, Split part) {
  const Pack off_grid = spread(kOffGrid);
  for (Size i = 0; i < count; i += 4) {
    const Size last = count - 1;
    const auto row = [&](Size l) { return (i + l < last ? i + l : last) * stride; };
    const Size at[4] = {row(0), row(1), row(2), row(3)};
    Pack large[4] = {}, small[4] = {};
    for (Size j = 0; j < stride; j += kWidth) {
      const Pack high = load(v.high + j), low = load(v.low + j), whole = high + low;
      for (int l = 0; l < 4; ++l) {
        const Pack h = load(rows_high + at[l] + j);
        large[l] += h * high;
        small[l] += load(rows_low + at[l] + j) * whole;
        small[l] += h * low;
      }
    }
    double exact[4], rest[4];
    sums(large[0], large[1], large[2], large[3], exact);
    sums(small[0], small[1], small[2], small[3], rest);
    Pack p[4], p_low[4];
    for (int l = 0; l < 4; ++l) {
      const double high = i + l > last ? 0.0 : on_grid(exact[l] + rest[l]);
      const double low = i + l > last ? 0.0 : (exact[l] - high) + rest[l];
      part.high[i + l] += high;
      part.low[i + l] += low;
      p[l] = spread(high);
      p_low[l] = spread(low);
    }
    for (Size j = 0; j < stride; j += kWidth) {
      Pack high = load(v.high + j), low = load(v.low + j);
      for (int l = 0; l < 4; ++l) {
        const Pack h = load(rows_high + at[l] + j), b = load(rows_low + at[l] + j);
        high -= p[l] * h;
        low -= p[l] * b;
        low -= p_low[l] * (h + b);
      }
      const Pack rounded = ((high + low) + off_grid) - off_grid;
      store(v.high + j, rounded);
      store(v.low + j, (high - rounded) + low);
    }
  }
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

}  // namespace
}  // namespace hurcules::kernels

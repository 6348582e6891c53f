// The inner loops of the solver on padded rows, compiled for more than one instruction set; the
// widest that the processor has is chosen when the program starts.
#pragma once

#include <cstddef>

namespace hurcules::kernels {

using Size = std::ptrdiff_t;

// a candidate that stops a move, and the part of the way at which it does
struct Blocking {
  Size candidate = -1;
  double way = 1.0;
};

// limits of candidates and their values, by candidate
struct LimitArrays {
  const double* lower;
  const double* upper;
  const double* norm;
};

// numbers high + low (project_split)
struct Split {
  double *high, *low;
};
inline constexpr double kGrid = 0x1p-25;
// added to x, |x| < 1 / kGrid, and taken off again: the multiple of kGrid next to it
inline constexpr double kOffGrid = 0x1.8p52 * kGrid;
// static: the linker may not take the code of one instruction set for all
static inline double on_grid(double x) {
  return (x + kOffGrid) - kOffGrid;
}

// Rows on their way to orthonormal directions (orthogonal_factor.hpp).
struct Directions {
  double* rest;         // what is left of each row
  double* Q;            // unit directions so far
  double* L;            // coordinates of the rows
  const double* norm2;  // squared norms of the rows
  Size* pivot;          // row of each direction
  Size rows, columns, stride;
  Size rank;     // directions so far
  double* side;  // b of  L g = b, which becomes g; or null
};

// All lengths `size` are multiples of four, but those of candidates may be any. Functions on
// `count` rows take rows `stride` apart.
struct Table {
  const char* name;
  double (*dot)(Size size, const double* a, const double* b);
  // y += s x
  void (*axpy)(Size size, double s, const double* x, double* y);
  // y = s x
  void (*scale)(Size size, double s, const double* x, double* y);
  // x += way (target - x)
  void (*advance)(Size size, double way, const double* target, double* x);
  // (a, b) = (c a + s b, c b - s a)
  void (*rotate)(Size size, double c, double s, double* a, double* b);
  // One sweep of one-sided Jacobi: rotates every pair of rows whose cosine in their first `size`
  // numbers is above `smallest` so that they become orthogonal there; false when none was.
  // squares[i] = |row i|^2 of these numbers
  bool (*sweep)(double* rows, Size count, Size size, Size stride, double smallest, double* squares);
  // out[i] = row i . x
  void (*dots)(const double* rows, Size count, Size stride, const double* x, double* out);
  // y += sum_i s[i] row i
  void (*axpys)(const double* rows, Size count, Size stride, const double* s, double* y);
  // v loses its parts along orthonormal rows, which are added to part[i] (a multiple of four of
  // them); |v|^2 then
  double (*project)(const double* rows, Size count, Size stride, double* v, double* part);
  // The same on numbers of more digits, high + low: high is a multiple of kGrid up to 1, so that
  // products of two add up without rounding, and low the rest of it. No |v| or row is above 1.
  void (*project_split)(const double* high, const double* low, Size count, Size stride, Split v,
                        Split part);
  // One step of Gram-Schmidt: coordinates[i * stride] = scale (pivot . row i), and the row loses
  // its part along the pivot: row i -= scale^2 (pivot . row i) pivot. Takes four rows at a time: up
  // to three rows behind the last are read and written.
  void (*eliminate)(const double* pivot, double scale, double* rows, Size count, Size stride,
                    double* coordinates);
  // A reflection of columns: row i -= scale v[i] sum, sum = sum_i v[i] row i, in the first `size`
  // numbers of the rows
  void (*reflect)(double* rows, Size count, Size size, Size stride, const double* v, double scale,
                  double* sum);
  // `count` rows of `length` numbers, one behind the other, to rows `stride` apart
  void (*copy_rows)(const double* from, Size count, Size length, double* to, Size stride);
  // out = s (a - b); |out|^2
  double (*scaled_difference)(Size size, double s, const double* a, const double* b, double* out);
  // sum_i (row i . x)^2
  double (*norm2_along)(const double* rows, Size count, Size stride, const double* x);
  // the largest  |row i . x| / norm[i],  rows of no length left out
  double (*largest_way)(const double* rows, Size count, Size stride, const double* x,
                        const double* norm);
  // rest[b] -= row i [b]^2 for all rows
  void (*take_squares)(const double* rows, Size count, Size stride, double* rest);
  // columns of `count` rows become rows of `out`, as many as rows are long; all `stride` apart,
  // count and stride multiples of four
  void (*transpose)(const double* rows, Size count, Size stride, double* out);
  // Gram-Schmidt over rows [first, end) as long as more than `clean` of the squared norm of the
  // next row is left and directions are missing: the row at which it stopped
  Size (*take_directions)(Directions& d, Size first, Size end, double clean);
  // out[i] = |row i|^2
  void (*norms2)(const double* rows, Size count, Size stride, double* out);
  // the largest |x|
  double (*largest)(Size size, const double* x);
  // the largest  value - upper  or  lower - value,  less relative * norm + absolute
  double (*worst_excess)(Size size, const double* value, LimitArrays limits, double relative,
                         double absolute);
  // The first candidate that a move from `value` to `target` takes beyond its limit by more than
  // relative * norm + absolute; ties go to the one that moves fastest.
  Blocking (*first_blocking)(Size size, const double* value, const double* target,
                             LimitArrays limits, double relative, double absolute);
  // by how much candidates got worse from `before` to `now`: the largest  now - max(upper, before)
  // or  min(lower, before) - now,  relative to their norms
  double (*worsened)(Size size, const double* before, const double* now, LimitArrays limits);
  // lower and upper as asked for, or the value where it is beyond, or inside by less than
  // relative * norm
  void (*widen)(Size size, const double* value, LimitArrays asked, double relative, double* lower,
                double* upper);
};

// the table in use
extern const Table* chosen;
// "baseline" or "avx2"; false when this processor or build lacks it. For tests and measurements:
// it changes all solvers of the process.
bool choose(const char* name);

}  // namespace hurcules::kernels

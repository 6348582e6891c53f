#include "hurcules/sim/goals.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

constexpr double kRound = 1e-9;  // [s] that a sum of steps may be short of a time
constexpr Index kPlace = 3;      // numbers of a pose that are its place; a quaternion follows

// Even and odd places are summed apart, and eight at a time from their last pair, as numpy's einsum
// does on x86: rewards keep the bits that they had by it.
double dot(const double* one, const double* other, Index n) {
  double even = 0.0, odd = 0.0;
  const auto add = [&](Index i) {
    even += one[i] * other[i];
    if (i + 1 < n) odd += one[i + 1] * other[i + 1];
  };
  Index i = 0;
  for (; i + 8 <= n; i += 8) {
    for (Index j = 6; j >= 0; j -= 2) add(i + j);
  }
  for (; i < n; i += 2) add(i);
  return even + odd;
}

double norm(const double* values, Index n) {
  double sum = 0.0;
  for (Index i = 0; i < n; ++i) sum += values[i] * values[i];
  return std::sqrt(sum);
}

void require_poses(const ConstMatrixRef& one, const ConstMatrixRef& other, Index size,
                   Index least) {
  const bool fit = one.rows() == other.rows() && one.cols() == other.cols();
  if (!fit || size < least || one.cols() % size != 0)
    throw Error("goals want two arrays of one shape, of poses of " + std::to_string(size) +
                " numbers, at least " + std::to_string(least));
}

double seen(double value, bool rounded) {
  return rounded ? static_cast<double>(static_cast<float>(value)) : value;
}

}  // namespace

Matrix distances(const ConstMatrixRef& one, const ConstMatrixRef& other, Index size, bool rounded) {
  require_poses(one, other, size, kPlace);
  Matrix result(one.rows(), one.cols() / size);
  for (Index i = 0; i < result.rows(); ++i) {
    for (Index j = 0; j < result.cols(); ++j) {
      double way[kPlace];
      for (Index k = 0; k < kPlace; ++k)
        way[k] = seen(one(i, j * size + k), rounded) - seen(other(i, j * size + k), rounded);
      result(i, j) = std::sqrt(dot(way, way, kPlace));
    }
  }
  return result;
}

Matrix half_angle_cosines(const ConstMatrixRef& one, const ConstMatrixRef& other, Index size,
                          bool rounded) {
  constexpr Index kNumbers = 4;
  require_poses(one, other, size, kPlace + kNumbers);
  Matrix result(one.rows(), one.cols() / size);
  for (Index i = 0; i < result.rows(); ++i) {
    for (Index j = 0; j < result.cols(); ++j) {
      double a[kNumbers], b[kNumbers];
      for (Index k = 0; k < kNumbers; ++k) {
        a[k] = seen(one(i, j * size + kPlace + k), rounded);
        b[k] = seen(other(i, j * size + kPlace + k), rounded);
      }
      const double lengths = norm(a, kNumbers) * norm(b, kNumbers);
      result(i, j) = std::clamp(std::abs(dot(a, b, kNumbers)) / std::max(lengths, 1e-12), 0.0, 1.0);
    }
  }
  return result;
}

Flags all_below(const ConstMatrixRef& values, double bound) {
  return (values.array() < bound).rowwise().all();
}

Vector means(const ConstMatrixRef& values, double factor) {
  Vector result(values.rows());
  for (Index i = 0; i < values.rows(); ++i) {
    double sum = 0.0;
    for (Index j = 0; j < values.cols(); ++j) sum += values(i, j);
    result[i] = factor * (sum / static_cast<double>(values.cols()));
  }
  return result;
}

Vector squares(const ConstMatrixRef& values) {
  Vector result(values.rows());
  for (Index i = 0; i < values.rows(); ++i) {
    const double* row = values.data() + i * values.outerStride();
    result[i] = dot(row, row, values.cols());
  }
  return result;
}

Vector hold(const FlagsRef& now, double dt, double least, MatrixRef held, MatrixRef done) {
  const Index n = now.size();
  if (held.size() != n || done.size() != n)
    throw Error("hold wants a flag, a time and a number for each of " + std::to_string(n) +
                " episodes");
  Vector grown(n);
  for (Index i = 0; i < n; ++i) {
    const double before = done(i, 0);
    held(i, 0) = now[i] ? held(i, 0) + dt : 0.0;
    if (held(i, 0) >= least - kRound) done(i, 0) = 1.0;
    grown[i] = done(i, 0) - before;
  }
  return grown;
}

Matrix swing(const ConstMatrixRef& place, const ConstMatrixRef& free, double dt, Swing& state) {
  const auto fits = [&place](const MatrixRef& one) {
    return one.rows() == place.rows() && one.cols() == place.cols();
  };
  if (!fits(state.place) || !fits(state.velocity) || !fits(state.deflection) || !fits(state.rate) ||
      free.rows() != 2 || free.cols() != 2)
    throw Error("swing wants five arrays of one shape, and one of (2, 2)");
  Matrix points(place.rows(), place.cols());
  for (Index i = 0; i < place.rows(); ++i) {
    for (Index j = 0; j < place.cols(); ++j) {
      const double velocity = (place(i, j) - state.place(i, j)) / dt;
      const double e = state.deflection(i, j);
      const double rate = state.rate(i, j) - (velocity - state.velocity(i, j));
      state.deflection(i, j) = free(0, 0) * e + free(0, 1) * rate;
      state.rate(i, j) = free(1, 0) * e + free(1, 1) * rate;
      state.place(i, j) = place(i, j);
      state.velocity(i, j) = velocity;
      points(i, j) = place(i, j) + state.deflection(i, j);
    }
  }
  return points;
}

}  // namespace hurcules

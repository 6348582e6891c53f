#include "hurcules/solver/level_factor.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

constexpr int kMaxSweeps = 40;         // six are usual
constexpr double kOrthogonal = 1e-15;  // cosine of two rows that need no rotation
constexpr double kNothing = 1e-13;     // a row that is rounding, relative to the largest

// the plane rotation that makes rows i and j of B orthogonal, applied to B and to U'
bool rotate(MatrixRef B, MatrixRef Ut, Index i, Index j) {
  const double a = B.row(i).squaredNorm(), b = B.row(j).squaredNorm();
  const double c = B.row(i).dot(B.row(j));
  if (std::min(a, b) <= kNothing * kNothing || std::abs(c) <= kOrthogonal * std::sqrt(a * b)) {
    return false;
  }
  const double zeta = (b - a) / (2.0 * c);
  const double t = (zeta < 0.0 ? -1.0 : 1.0) / (std::abs(zeta) + std::hypot(1.0, zeta));
  const double cosine = 1.0 / std::sqrt(1.0 + t * t), sine = cosine * t;
  for (MatrixRef* M : {&B, &Ut}) {
    double *x = M->row(i).data(), *y = M->row(j).data();
    for (Index l = 0; l < M->cols(); ++l) {
      const double old = x[l];
      x[l] = cosine * old - sine * y[l];
      y[l] = sine * old + cosine * y[l];
    }
  }
  return true;
}

void swap_rows(MatrixRef M, Index i, Index j) {
  if (i != j) std::swap_ranges(M.row(i).data(), M.row(i).data() + M.cols(), M.row(j).data());
}

// one-sided Jacobi: rotations from the left until the rows of B are orthogonal, B = U S Y~'
void factor_singular(MatrixRef B, double tolerance, LevelFactor& level) {
  const Index m = B.rows();
  MatrixRef Ut = level.Ut.topLeftCorner(m, m);
  Ut.setIdentity();
  const double scale = B.rowwise().norm().maxCoeff();
  if (!(scale > tolerance)) return;
  B /= scale;
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < kMaxSweeps; ++sweep) {
    rotated = false;
    for (Index i = 0; i < m; ++i) {
      for (Index j = i + 1; j < m; ++j) rotated |= rotate(B, Ut, i, j);
    }
  }
  for (; level.rank < std::min(m, B.cols()); ++level.rank) {
    Index largest;
    const Index r = level.rank;
    const double norm = B.bottomRows(m - r).rowwise().norm().maxCoeff(&largest);
    if (!(norm * scale > tolerance)) return;
    swap_rows(B, r, r + largest);
    swap_rows(Ut, r, r + largest);
    B.row(r) /= norm;
    level.S(r, r) = norm * scale;
  }
}

// Makes row r of A orthonormal to the rows before it, and the rows after it orthogonal to it; what
// it takes from row i goes to C(r, place[i]). Twice for the row itself: once loses digits.
struct Orthonormalizer {
  MatrixRef A, C;
  Index* place;

  void take(Index r) {
    for (Index j = 0; j < r; ++j) {
      const double c = A.row(j).dot(A.row(r));
      A.row(r) -= c * A.row(j);
      C(j, place[r]) += c;
    }
    const double norm = A.row(r).norm();
    C(r, place[r]) = norm;
    A.row(r) /= norm;
    for (Index i = r + 1; i < A.rows(); ++i) {
      const double c = A.row(r).dot(A.row(i));
      A.row(i) -= c * A.row(r);
      C(r, place[i]) = c;
    }
  }
};

// rows of B with the largest first: B = L Y~'; then L = U S
void factor_orthogonal(MatrixRef B, double tolerance, LevelFactor& level) {
  const Index m = B.rows();
  for (Index i = 0; i < m; ++i) level.order[i] = i;
  MatrixRef L = level.Ut.topLeftCorner(m, m);
  L.setZero();
  Orthonormalizer rows{B, L, level.order.data()};
  for (; level.rank < std::min(m, B.cols()); ++level.rank) {
    Index largest;
    const Index r = level.rank;
    if (!(B.bottomRows(m - r).rowwise().norm().maxCoeff(&largest) > tolerance)) break;
    swap_rows(B, r, r + largest);
    std::swap(level.order[r], level.order[r + largest]);
    rows.take(r);
  }
  for (Index i = 0; i < m; ++i) level.order[i] = i;
  MatrixRef S = level.S.topLeftCorner(level.rank, level.rank);
  S.setZero();
  Orthonormalizer columns{L.topRows(level.rank), S, level.order.data()};
  for (Index j = 0; j < level.rank; ++j) columns.take(j);
}

// solves (N + rho^2 I) s = s by Cholesky; the lower triangle of N is overwritten
void solve_positive(MatrixRef N, VectorRef s) {
  const Index l = N.rows();
  for (Index j = 0; j < l; ++j) {
    N(j, j) = std::sqrt(N(j, j) - N.row(j).head(j).squaredNorm());
    for (Index i = j + 1; i < l; ++i) {
      N(i, j) = (N(i, j) - N.row(i).head(j).dot(N.row(j).head(j))) / N(j, j);
    }
    s[j] = (s[j] - N.row(j).head(j).dot(s.head(j))) / N(j, j);
  }
  for (Index j = l - 1; j >= 0; --j) {
    s[j] /= N(j, j);
    s.head(j) -= s[j] * N.row(j).head(j).transpose();
  }
}

}  // namespace

void factor(MatrixRef B, double tolerance, LevelFactor& level) {
  level.rows = B.rows();
  level.rank = 0;
  if (B.rows() == 0 || B.cols() == 0) return;
  if (level.kind == FactorKind::SingularValues) {
    factor_singular(B, tolerance, level);
  } else {
    factor_orthogonal(B, tolerance, level);
  }
}

void solve_damped(const LevelFactor& level, double rho, VectorRef s, MatrixRef work) {
  const Index l = level.rank;
  if (level.kind == FactorKind::SingularValues) {
    for (Index i = 0; i < l; ++i) {
      const double sigma = level.S(i, i);
      s[i] *= rho == 0.0 ? 1.0 / sigma : sigma / (sigma * sigma + rho * rho);  // [T 3.3.39]
    }
  } else if (rho == 0.0) {
    for (Index i = l - 1; i >= 0; --i) {
      s[i] = (s[i] - level.S.row(i).segment(i + 1, l - i - 1).dot(s.segment(i + 1, l - i - 1))) /
             level.S(i, i);
    }
  } else {
    // S'S + rho^2 I, and S' s from the last entry on
    MatrixRef N = work.topLeftCorner(l, l);
    for (Index i = 0; i < l; ++i) {
      for (Index j = 0; j <= i; ++j) {
        N(i, j) = level.S.col(i).head(j + 1).dot(level.S.col(j).head(j + 1));
      }
      N(i, i) += rho * rho;
    }
    for (Index i = l - 1; i >= 0; --i) s[i] = level.S.col(i).head(i + 1).dot(s.head(i + 1));
    solve_positive(N, s);
  }
}

void solve_transposed(const LevelFactor& level, VectorRef c) {
  for (Index i = 0; i < level.rank; ++i) {
    if (level.kind == FactorKind::CompleteOrthogonal) {
      c[i] -= level.S.col(i).head(i).dot(c.head(i));
    }
    c[i] /= level.S(i, i);
  }
}

}  // namespace hurcules

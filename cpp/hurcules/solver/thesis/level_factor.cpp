#include "hurcules/solver/thesis/level_factor.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels/kernels.hpp"

namespace hurcules {

namespace {

using ConstMap = Eigen::Map<const Vector>;

constexpr int kMaxSweeps = 40;         // three to four are usual
constexpr double kOrthogonal = 1e-15;  // cosine of two rows that need no rotation
constexpr double kNothing = 1e-13;     // a row that is rounding, relative to the largest

void swap_rows(MatrixRef M, Index i, Index j) {
  if (i != j) std::swap_ranges(M.row(i).data(), M.row(i).data() + M.cols(), M.row(j).data());
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

// rows of B with the largest first: B = L Y~', L' in the first `rank` rows of U'; what is left of a
// row and below `tolerance` counts as zero
void triangularize_rows(MatrixRef B, double tolerance, LevelFactor& level, FactorRoom& room) {
  const Index m = B.rows();
  for (Index i = 0; i < m; ++i) room.order[i] = i;
  MatrixRef L = level.Ut.topLeftCorner(m, m);
  L.setZero();
  Orthonormalizer rows{B, L, room.order.data()};
  for (; level.rank < std::min(m, B.cols()); ++level.rank) {
    Index largest;
    const Index r = level.rank;
    if (!(B.bottomRows(m - r).rowwise().norm().maxCoeff(&largest) > tolerance)) break;
    swap_rows(B, r, r + largest);
    std::swap(room.order[r], room.order[r + largest]);
    rows.take(r);
  }
}

// one-sided Jacobi: rotations until the rows of T, L' at first, are orthogonal: W' L' = S U'
void diagonalize(const MatrixRef& L, double scale, FactorRoom& room) {
  const Index r = L.rows(), m = L.cols(), size = padded(m);
  PaddedRows& T = room.turned;
  T.shape(size + r);
  T.set_zero(r);
  for (Index i = 0; i < r; ++i) {
    for (Index j = 0; j < m; ++j) T.row(i)[j] = scale * L(i, j);
    T.row(i)[size + i] = 1.0;
  }
  const auto sweep = kernels::chosen->sweep;
  for (int i = 0; i < kMaxSweeps; ++i) {
    if (!sweep(T.row(0), r, size, T.stride(), kOrthogonal, room.squares.data())) return;
  }
}

// B = L Y', then L' = W S U' and Y~' = W' Y'. The rotations meet the short rows of L', which are
// nearly orthogonal already, instead of the long ones of B (Drmac, Veselic: New fast and accurate
// Jacobi SVD algorithm I, 2008).
void factor_singular(MatrixRef B, double tolerance, LevelFactor& level, FactorRoom& room) {
  const double scale = B.rowwise().norm().maxCoeff();
  if (!(scale > tolerance)) return;
  triangularize_rows(B, kNothing * scale, level, room);
  const Index m = B.rows(), o = B.cols(), r = level.rank;
  diagonalize(level.Ut.topLeftCorner(r, m), 1.0 / scale, room);
  PaddedRows& Y = room.Y;
  Y.shape(o);
  for (Index i = 0; i < r; ++i) std::copy_n(B.row(i).data(), o, Y.row(i));
  for (level.rank = 0; level.rank < r; ++level.rank) {
    const Index k = level.rank;
    Index largest;
    const double sigma = std::sqrt(room.squares.head(r).maxCoeff(&largest));
    if (!(sigma * scale > tolerance)) return;
    room.squares[largest] = -1.0;  // taken
    level.S(k, k) = sigma * scale;
    const double *u = room.turned.row(largest), *w = u + padded(m);
    level.Ut.row(k).head(m) = ConstMap(u, m).transpose() / sigma;
    std::fill_n(room.row.data(), Y.stride(), 0.0);
    kernels::chosen->axpys(Y.row(0), r, Y.stride(), w, room.row.data());
    std::copy_n(room.row.data(), o, B.row(k).data());
  }
}

// B = L Y~', then L = U S
void factor_orthogonal(MatrixRef B, double tolerance, LevelFactor& level, FactorRoom& room) {
  triangularize_rows(B, tolerance, level, room);
  for (Index i = 0; i < B.rows(); ++i) room.order[i] = i;
  MatrixRef S = level.S.topLeftCorner(level.rank, level.rank);
  S.setZero();
  Orthonormalizer columns{level.Ut.topLeftCorner(level.rank, B.rows()), S, room.order.data()};
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

void FactorRoom::reserve(Index rows, Index columns) {
  const Index rank = std::min(rows, columns);
  order.resize(rows);
  turned.reserve(rank, padded(rows) + rank);
  Y.reserve(rank, columns);
  row.reserve(columns);
  squares.resize(rank);
}

void factor(MatrixRef B, double tolerance, LevelFactor& level, FactorRoom& room) {
  level.rows = B.rows();
  level.rank = 0;
  if (B.rows() == 0 || B.cols() == 0) return;
  if (level.kind == FactorKind::SingularValues) {
    factor_singular(B, tolerance, level, room);
  } else {
    factor_orthogonal(B, tolerance, level, room);
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

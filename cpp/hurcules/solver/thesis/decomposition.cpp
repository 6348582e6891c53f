#include "hurcules/solver/thesis/decomposition.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

using Map = Eigen::Map<Vector>;
using ConstMap = Eigen::Map<const Vector>;

double dot(Index n, const double* a, const double* b) {
  return ConstMap(a, n).dot(ConstMap(b, n));
}

// y += s x
void axpy(Index n, double s, const double* x, double* y) {
  Map(y, n) += s * ConstMap(x, n);
}

}  // namespace

void HierarchicalDecomposition::reserve(Index unknowns, std::span<const Index> rows) {
  unknowns_ = unknowns;
  basis_.resize(unknowns, unknowns);
  normal_.resize(unknowns, unknowns);
  s_.resize(unknowns);
  w_.resize(unknowns);
  levels_.resize(rows.size());
  Index most = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Index rank = std::min(rows[k], unknowns);
    levels_[k].kind = kind_;
    levels_[k].Ut.resize(rows[k], rows[k]);
    levels_[k].S.resize(rank, rank);
    most = std::max(most, rows[k]);
  }
  B_.resize(most, unknowns);
  room_.reserve(most, unknowns);
}

void HierarchicalDecomposition::start() {
  size_ = 0;
  used_ = 0;
  basis_.setIdentity();
}

void HierarchicalDecomposition::add_level(const RowTable& table, std::span<const HeldLimit> held) {
  Level& level = levels_[size_++];
  level.first = used_;
  const Index rows = static_cast<Index>(held.size()), o = free();
  MatrixRef B = B_.topLeftCorner(rows, o);
  double largest = 0.0;
  for (Index i = 0; i < rows; ++i) {
    const Row& row = table[held[i].row];
    largest = std::max(largest, row.norm);
    for (Index j = 0; j < o; ++j) {
      const double* z = direction(used_ + j);
      const double value =
          row.dense < 0 ? z[row.row] : dot(unknowns_, table.dense_row(row.dense), z);
      B(i, j) = held[i].sign * value;
    }
  }
  factor(B, tolerance::kRank * largest, level, room_);  // [T 3.3.29], [T 3.5.123]
  extend_basis(level);
}

// Reflections that carry the rows of Y~' onto the first coordinates carry Z_{k-1} onto [Y_k Z_k]
// [T 3.3.34].
void HierarchicalDecomposition::extend_basis(Level& level) {
  const Index o = free();
  MatrixRef Y = B_.topLeftCorner(level.rank, o);
  for (Index i = 0; i < level.rank; ++i) {
    auto v = Y.row(i).tail(o - i);
    const double side = v[0] > 0.0 ? -1.0 : 1.0;  // Y_i becomes side times the coordinate
    v[0] -= side;
    const double half = 0.5 * v.squaredNorm();
    if (half > 0.0) {
      for (Index l = i + 1; l < level.rank; ++l) {
        auto y = Y.row(l).tail(o - i);
        y -= (v.dot(y) / half) * v;
      }
      auto Z = basis_.middleRows(used_ + i, o - i);
      w_.setZero();
      for (Index j = 0; j < o - i; ++j) w_ += (v[j] / half) * Z.row(j).transpose();
      for (Index j = 0; j < o - i; ++j) Z.row(j) -= v[j] * w_.transpose();
    }
    if (side < 0.0) basis_.row(used_ + i) *= -1.0;
  }
  used_ += level.rank;
}

void HierarchicalDecomposition::step(Index k, double rho, VectorRef residual, Vector& x) {
  const Level& level = levels_[k];
  auto s = s_.head(level.rank);
  for (Index i = 0; i < level.rank; ++i) {
    const auto u = level.Ut.row(i).head(level.rows);
    s[i] = u.dot(residual);
    residual -= s[i] * u.transpose();
  }
  solve_damped(level, rho, s, normal_);
  for (Index i = 0; i < level.rank; ++i) {
    axpy(unknowns_, s[i], direction(level.first + i), x.data());
  }
}

void HierarchicalDecomposition::multipliers(Index k, const Vector& gradient, VectorRef mu) {
  const Level& level = levels_[k];
  auto c = s_.head(level.rank);
  for (Index i = 0; i < level.rank; ++i) {
    c[i] = dot(unknowns_, direction(level.first + i), gradient.data());
  }
  solve_transposed(level, c);
  mu.setZero();
  for (Index i = 0; i < level.rank; ++i) {
    mu -= c[i] * level.Ut.row(i).head(level.rows).transpose();
  }
}

void HierarchicalDecomposition::add_projection(Index k, double scale, const Vector& x,
                                               Vector& y) const {
  const Level& level = levels_[k];
  for (Index i = level.first; i < level.first + level.rank; ++i) {
    axpy(unknowns_, scale * dot(unknowns_, direction(i), x.data()), direction(i), y.data());
  }
}

}  // namespace hurcules

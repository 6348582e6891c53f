#include "hurcules/solver/chain.hpp"

#include <cmath>

#include "hurcules/solver/kernels.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

void Chain::reserve(Index unknowns, Index rows, Index levels) {
  Q_.resize(unknowns, unknowns);
  if (L_.rows() < rows || L_.cols() != unknowns) L_.resize(rows, unknowns);
  v_.resize(unknowns);
  rest_.resize(unknowns);
  rank_.reserve(levels + 1);
  pivot_row_.resize(unknowns);
}

void Chain::read_row(const RowTable& rows, int i) {
  v_.setZero();
  rows.add_to(i, 1.0, v_);
}

void Chain::orthogonalize(double* l) {
  for (Index j = 0; j < count_; ++j) {
    const double part = kernels::dot(v_.size(), direction(j), v_.data());
    l[j] += part;
    kernels::axpy(v_.size(), -part, direction(j), v_.data());
  }
}

void Chain::build(const RowTable& rows) {
  const Index n = unknowns();
  count_ = 0;
  complete_ = false;
  rank_.assign(1, 0);
  for (int k = 0; k < rows.levels(); ++k) {
    for (int i = rows.begin(k); i < rows.begin(k + 1); ++i) {
      if (!rows[i].equality) continue;
      double* l = L_.row(i).data();
      std::fill(l, l + n, 0.0);
      read_row(rows, i);
      // a row close to the span of those before is cleaned again, until it stays
      double before = rows[i].norm, left = before;
      for (int pass = 0; pass < 4; ++pass) {
        orthogonalize(l);
        left = v_.norm();
        if (left >= 0.5 * before) break;
        before = left;
      }
      if (left <= tolerance::kRank * rows[i].norm || count_ == n) continue;
      Q_.row(count_) = v_.transpose() / left;
      l[count_] = left;
      pivot_row_[count_] = i;
      ++count_;
    }
    rank_.push_back(count_);
  }
}

void Chain::complete(const RowTable& rows) {
  if (complete_) return;
  complete_ = true;
  const Index n = unknowns();
  // what each unit vector still has outside the span
  rest_.setOnes();
  for (Index j = 0; j < count_; ++j) rest_ -= Q_.row(j).transpose().cwiseAbs2();
  while (count_ < n) {
    Index b = 0;
    rest_.maxCoeff(&b);
    v_.setZero();
    v_[b] = 1.0;
    double* unused = L_.row(L_.rows() - 1).data();  // the scratch row after all rows
    orthogonalize(unused);
    orthogonalize(unused);
    Q_.row(count_) = v_.transpose() / v_.norm();
    rest_ -= Q_.row(count_).transpose().cwiseAbs2();
    ++count_;
  }
  for (int i = 0; i < rows.size(); ++i) {
    if (rows[i].equality) continue;
    for (Index j = 0; j < n; ++j) {
      L_(i, j) = rows[i].a ? kernels::dot(n, direction(j), rows[i].a) : Q_(j, rows[i].row);
    }
  }
}

void Chain::remove_first(Index r, Vector& y) const {
  for (Index j = 0; j < r; ++j) {
    kernels::axpy(y.size(), -kernels::dot(y.size(), direction(j), y.data()), direction(j),
                  y.data());
  }
}

}  // namespace hurcules

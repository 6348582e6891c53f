#include "hurcules/control/orthonormal_rows.hpp"

#include <cmath>

namespace hurcules {

namespace {

constexpr double kRank = 1e-10;  // as the solver's, of rows of length 1

}  // namespace

void OrthonormalRows::resize(Index n) {
  directions_ = Matrix::Zero(n, n);
  sources_.resize(static_cast<std::size_t>(n));
  parts_ = Vector::Zero(n);
  rank_ = 0;
}

void OrthonormalRows::remove_from(VectorRef v) {
  for (Index j = 0; j < rank_; ++j) parts_[j] = directions_.row(j).dot(v);
  for (Index j = 0; j < rank_; ++j) v -= parts_[j] * directions_.row(j).transpose();
}

void OrthonormalRows::add(VectorRef v, Source source) {
  if (full()) return;
  remove_from(v);
  double length = v.norm();
  if (length < kRank) return;
  v /= length;
  if (length < 0.5) {  // what cancelled left rounding behind
    remove_from(v);
    length = v.norm();
    v /= length;
  }
  sources_[static_cast<std::size_t>(rank_)] = source;
  directions_.row(rank_++) = v;
}

double OrthonormalRows::add_rows(MatrixRef rows, double least, double none) {
  for (Index i = 0; i < rows.rows(); ++i) {
    for (Index j = 0; j < rank_; ++j) parts_[j] = directions_.row(j).dot(rows.row(i));
    for (Index j = 0; j < rank_; ++j) rows.row(i) -= parts_[j] * directions_.row(j);
  }
  double weakest = none;
  for (Index count = 0; count < rows.rows() && !full(); ++count) {
    Index strongest = 0;
    const double length = std::sqrt(rows.rowwise().squaredNorm().maxCoeff(&strongest));
    if (length < least) break;
    weakest = length;
    directions_.row(rank_) = rows.row(strongest) / length;
    for (Index i = 0; i < rows.rows(); ++i)
      rows.row(i) -= rows.row(i).dot(directions_.row(rank_)) * directions_.row(rank_);
    ++rank_;
  }
  return weakest;
}

}  // namespace hurcules

#include "hurcules/solver/problem/nullspace_bases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/kernels/kernels.hpp"

namespace hurcules {

namespace {

// h below this gives nothing: a step of this part of the residual, no more than rounding asks
constexpr double kLeastPart = 1e-8;
// a level with less regularisation takes what it gets as a level without would
constexpr double kLeastReceiver = 1e-4;

}  // namespace

double transition_weight(double ratio, double receiver) {
  if (!(ratio < 1.0) || receiver < kLeastReceiver) return 0.0;
  const double square = ratio * ratio, part = (1.0 - square) * (1.0 - square);
  if (part < kLeastPart) return 0.0;
  const double p = std::min(receiver, 1.0), shared = part * p * p;
  // 1 - h without cancellation
  return std::sqrt(shared / (square * (2.0 - square) + shared));
}

void NullspaceBases::reserve(Index unknowns, Index rows, Index levels, bool smooth) {
  smooth_ = smooth;
  nullspaces_.resize(smooth ? std::max<Index>(1, levels) : 1);
  for (NullspaceBasis& nullspace : nullspaces_) {
    nullspace.reserve(unknowns, rows, levels);
    if (smooth) nullspace.reserve_basis(unknowns, levels);
  }
  for (auto* v : {&rho_, &receiver_}) v->reserve(levels);
  segment_.reserve(levels + 1);
  work_.reserve(padded(unknowns) + 4);
}

void NullspaceBases::start(const RowTable& rows, HierarchyView hierarchy) {
  used_ = 1;
  segment_.assign(rows.levels() + 1, 0);
  nullspaces_[0].build(rows);
  if (smooth_) find_receivers(rows, hierarchy);
}

void NullspaceBases::find_receivers(const RowTable& rows, HierarchyView hierarchy) {
  rho_.assign(rows.levels(), 0.0);
  receiver_.assign(rows.levels(), 0.0);
  double least = std::numeric_limits<double>::infinity();
  for (int k = rows.levels() - 1; k >= 0; --k) {
    rho_[k] = hierarchy[k].rho;
    // nobody below: nothing to give
    receiver_[k] = std::isinf(least) ? 0.0 : least;
    double norm = 0.0;
    for (int i = rows.begin(k); i < rows.begin(k + 1); ++i) norm = std::max(norm, rows[i].norm);
    if (norm > 0.0) least = std::min(least, rho_[k] / norm);
  }
}

void NullspaceBases::close(const RowTable& rows, LevelSvd& svd, int k) {
  segment_[k + 1] = segment_[k];
  if (!smooth_ || receiver_[k] < kLeastReceiver || svd.all_at_least(rho_[k])) return;
  svd.decompose();
  const auto weight = [&](Index i) {
    return transition_weight(svd.sigma(i) / rho_[k], receiver_[k]);
  };
  bool weak = false;
  for (Index i = 0; i < svd.size(); ++i) weak |= weight(i) > 0.0;
  if (!weak) return;
  of(k).complete(rows);
  segment_[k + 1] = used_++;
  fill_basis(rows, svd, k);
  of(k + 1).build_behind(rows, k);
}

int NullspaceBases::handed_to() const {
  if (used_ == 1) return -1;
  const auto first = std::find(segment_.begin(), segment_.end(), 1);
  return static_cast<int>(first - segment_.begin());
}

void NullspaceBases::fill_basis(const RowTable& rows, const LevelSvd& svd, int k) {
  const kernels::Table& kernel = *kernels::chosen;
  const NullspaceBasis& before = of(k);
  WeightedNullspaceBasis& basis = of(k + 1).weighted_basis();
  basis.start(before.weighted_basis(), before.unknowns(), rows.unknowns(), k);
  const Index first = before.rank_before(k), end = before.rank_before(k + 1);
  const int equality = rows.equalities(k), count = rows.equalities(k + 1) - equality;
  for (Index i = 0; i < svd.size(); ++i) {
    const double w = transition_weight(svd.sigma(i) / rho_[k], receiver_[k]);
    std::fill_n(work_.data(), rows.stride(), 0.0);
    if (w > 0.0) {
      kernel.axpys(before.unit_direction(first), svd.size(), before.stride(), svd.right(i),
                   work_.data());
      basis.add(work_.data(), w);
    } else {
      // u_i' A of the level's rows A is what it keeps
      kernel.axpys(rows.dense_row(equality), count, rows.stride(), svd.image(i), work_.data());
      basis.keep(work_.data());
    }
  }
  for (Index j = end; j < before.unknowns(); ++j) basis.add(before.unit_direction(j), 1.0);
}

}  // namespace hurcules

#include "hurcules/solver/sensitivity/nullspace_derivative.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/kernels/dense_decompositions.hpp"
#include "hurcules/solver/problem/nullspace_bases.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

std::vector<Receiver> receivers(const SolvedHierarchy& solved) {
  std::vector<Receiver> result(solved.levels());
  if (!solved.handed_over()) return result;
  Receiver least{.p = std::numeric_limits<double>::infinity()};
  for (int k = solved.levels() - 1; k >= 0; --k) {
    if (std::isfinite(least.p)) result[k] = least;
    int longest = -1;
    for (int i = solved.begin(k); i < solved.begin(k + 1); ++i) {
      if (longest < 0 || solved.row(i).norm > solved.row(longest).norm) longest = i;
    }
    if (longest < 0 || solved.row(longest).norm == 0.0) continue;
    const double p = solved.asked_rho(k) / solved.row(longest).norm;
    if (p < least.p) least = {.p = p, .level = k, .row = longest};
  }
  for (Receiver& receiver : result) {
    // more than 1 counts as 1
    if (receiver.p > 1.0) receiver = {.p = 1.0};
  }
  return result;
}

NullspaceDerivative::NullspaceDerivative(const SolvedHierarchy& solved, int k, double receiver,
                                         Matrix basis, Index free)
    : rho_(solved.asked_rho(k)),
      receiver_(receiver),
      smooth_(solved.handed_over() && rho_ > 0.0 && transition_weight(0.0, receiver) > 0.0),
      B_(std::move(basis)),
      free_(free) {
  for (int i = solved.begin(k); i < solved.begin(k + 1); ++i) {
    if (solved.row(i).equality) rows_.push_back(i);
  }
  decompose(solved);
  weigh();
  find_rho_rates(solved, k);
}

void NullspaceDerivative::decompose(const SolvedHierarchy& solved) {
  const Index n = solved.unknowns(), m = static_cast<Index>(rows_.size());
  A_.resize(m, n);
  double longest = 0.0;
  for (Index i = 0; i < m; ++i) {
    A_.row(i) = solved.dense(rows_[static_cast<std::size_t>(i)]).transpose();
    longest = std::max(longest, A_.row(i).norm());
  }
  count_ = std::min(m, free_);
  sigma_.setZero(n);
  V_.setIdentity(n, n);
  MV_.setZero(m, n);
  if (m == 0) return;
  const Eigen::MatrixXd M = A_ * B_;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeThinU | Eigen::ComputeFullV);
  V_ = svd.matrixV();
  for (Index i = 0; i < count_; ++i) {
    if (svd.singularValues()[i] <= tolerance::kRank * longest) break;
    sigma_[i] = svd.singularValues()[i];
    MV_.col(i) = sigma_[i] * svd.matrixU().col(i);
    ++rank_;
  }
}

double NullspaceDerivative::part(Index i) const {
  const double ratio = sigma_[i] / rho_;
  return std::max(0.0, (1.0 - ratio) * (1.0 + ratio));
}

void NullspaceDerivative::weigh() {
  const Index n = sigma_.size();
  psi_.setZero(n);
  psi_by_rho_.setZero(n);
  psi_by_receiver_.setZero(n);
  const double p2 = receiver_ * receiver_;
  for (Index i = 0; i < n; ++i) {
    if (sigma_[i] == 0.0) psi_[i] = 1.0;
    if (!smooth_ || sigma_[i] == 0.0) continue;
    psi_[i] = transition_weight(sigma_[i] / rho_, receiver_);
    if (psi_[i] == 0.0) continue;
    // psi^2 = h p^2 / D,  D = (1 - h) + h p^2,  h = u^2,  u = 1 - (sigma / rho)^2
    const double u = part(i), h = u * u, D = (1.0 - h) + h * p2;
    psi_by_receiver_[i] = receiver_ * h * (1.0 - h) / (D * D * psi_[i]);
    psi_by_rho_[i] = 2.0 * u * p2 * sigma_[i] * sigma_[i] / (D * D * psi_[i] * std::pow(rho_, 3));
  }
  differences_.resize(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) differences_(i, j) = difference(i, j);
  }
}

double NullspaceDerivative::difference(Index i, Index j) const {
  const double si = sigma_[i] * sigma_[i], sj = sigma_[j] * sigma_[j];
  if (smooth_ && psi_[i] > 0.0 && psi_[j] > 0.0) {
    // without the difference of two numbers that may be equal
    const double p2 = receiver_ * receiver_, ui = part(i), uj = part(j);
    const double Di = 1.0 - ui * ui * (1.0 - p2), Dj = 1.0 - uj * uj * (1.0 - p2);
    return -p2 * (ui + uj) / (rho_ * rho_ * Di * Dj * (psi_[i] + psi_[j]));
  }
  return psi_[i] == psi_[j] ? 0.0 : (psi_[i] - psi_[j]) / (si - sj);
}

void NullspaceDerivative::find_rho_rates(const SolvedHierarchy& solved, int k) {
  sigma_by_M_.setZero(A_.rows(), A_.cols());
  const double threshold = solved.rules().threshold;
  if (!solved.rules().adaptive || rho_ == 0.0 || count_ == 0) return;
  const Index last = count_ - 1;
  rho_by_rho_ = solved.rho(k) / rho_;
  if (solved.rho(k) == 0.0 || sigma_[last] == 0.0) return;
  // rho sqrt(1 - (sigma / threshold)^2)
  rho_by_sigma_ = -rho_ * sigma_[last] / (threshold * threshold * rho_by_rho_);
  sigma_by_M_ = MV_.col(last) / sigma_[last] * V_.col(last).transpose();
}

Index NullspaceDerivative::free_behind() const {
  return free_ - std::count(psi_.begin(), psi_.end(), 0.0);
}

Matrix NullspaceDerivative::image_change(const DirectionsChange& change) const {
  return change.A * B_ + A_ * change.B;
}

Matrix NullspaceDerivative::behind_change(const DirectionsChange& change) const {
  const Eigen::MatrixXd half = MV_.transpose() * image_change(change) * V_;
  Eigen::MatrixXd turned = differences_.cwiseProduct(half + half.transpose());
  turned.diagonal() += psi_by_rho_ * change.rho + psi_by_receiver_ * change.receiver;
  return change.B * psi_matrix() + B_ * (V_ * turned * V_.transpose());
}

double NullspaceDerivative::rho_change(const DirectionsChange& change) const {
  if (rho_by_sigma_ == 0.0) return rho_by_rho_ * change.rho;
  return rho_by_rho_ * change.rho +
         rho_by_sigma_ * sigma_by_M_.cwiseProduct(image_change(change)).sum();
}

void NullspaceDerivative::add_gradient(const Matrix& behind_bar, double rho_bar,
                                       DirectionsChange& gradient) const {
  const Eigen::MatrixXd turned_bar = V_.transpose() * B_.transpose() * behind_bar * V_;
  gradient.rho += rho_by_rho_ * rho_bar + psi_by_rho_.dot(turned_bar.diagonal());
  gradient.receiver += psi_by_receiver_.dot(turned_bar.diagonal());
  const Eigen::MatrixXd weighed = differences_.cwiseProduct(turned_bar);
  const Matrix M_bar = MV_ * (weighed + weighed.transpose()) * V_.transpose() +
                       rho_bar * rho_by_sigma_ * sigma_by_M_;
  gradient.A += M_bar * B_.transpose();
  gradient.B += behind_bar * psi_matrix() + A_.transpose() * M_bar;
}

std::vector<NullspaceDerivative> nullspace_derivatives(const SolvedHierarchy& solved) {
  const std::vector<Receiver> below = receivers(solved);
  std::vector<NullspaceDerivative> result;
  result.reserve(solved.final_levels());
  Matrix basis = Matrix::Identity(solved.unknowns(), solved.unknowns());
  Index free = solved.unknowns();
  for (int k = 0; k < solved.final_levels(); ++k) {
    result.emplace_back(solved, k, below[k].p, std::move(basis), free);
    basis = result.back().behind();
    free = result.back().free_behind();
  }
  return result;
}

}  // namespace hurcules

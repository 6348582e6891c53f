#include "hurcules/solver/level_piece.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

using Target = DecidingRow::Target;

// a held row stands at its limit, not beyond it: relative to |a| max(1, |x|); the solve itself
// leaves rows within 1e-12
constexpr double kAtLimit = 1e-10;

Target side_of(const HeldRow& held) {
  return held.side == Side::Upper ? Target::Upper : Target::Lower;
}

// a row above that was violated at x_above is held at the value that it had there
Target target_above(const SolvedHierarchy& solved, const HeldRow& held, const Vector& x_above) {
  const double room =
      kAtLimit * solved.row(held.row).norm * std::max(1.0, x_above.lpNorm<Eigen::Infinity>());
  const double beyond = static_cast<double>(held.side) * solved.violation(held.row, x_above);
  return beyond > room ? Target::Present : side_of(held);
}

Matrix stack(const SolvedHierarchy& solved, const std::vector<DecidingRow>& rows) {
  Matrix stacked(static_cast<Index>(rows.size()), solved.unknowns());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    stacked.row(static_cast<Index>(i)) = solved.dense(rows[i].row).transpose();
  }
  return stacked;
}

using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

double largest_row(const Matrix& rows) {
  return rows.rows() > 0 ? rows.rowwise().norm().maxCoeff() : 0.0;
}

Index count_above(const Vector& sigma, double least) {
  return static_cast<Index>(
      std::count_if(sigma.begin(), sigma.end(), [least](double value) { return value > least; }));
}

}  // namespace

void EqualityRows::add_level(const SolvedHierarchy& solved, int k) {
  for (int i = solved.begin(k); i < solved.begin(k + 1); ++i) {
    if (solved.row(i).equality && space.add(solved.dense(i))) rows.push_back(i);
  }
}

LevelPiece::LevelPiece(const SolvedHierarchy& solved, int k, const EqualityRows& above)
    : rho(solved.rho(k)), x_above(solved.x(k - 1)), x(solved.x(k)), C(above.space) {
  collect(solved, k, above);
  decompose();
  refine_violation();
  find_multipliers();
  if (rho == 0.0) find_smallest_step_multipliers();
}

void LevelPiece::collect(const SolvedHierarchy& solved, int k, const EqualityRows& above) {
  for (const int i : above.rows) fixed.push_back({i, Target::Present});
  for (int i = solved.begin(k); i < solved.begin(k + 1); ++i) {
    if (solved.row(i).equality) own.push_back({i, Target::Both});
  }
  for (const HeldRow& held : solved.held(k)) {
    if (held.role != Role::Idle) collect_held(solved, k, held);
  }
  for (const HeldRow& held : solved.smallest_step(k)) {
    if (held.role != Role::SmallestStep) continue;
    // a small rho: what only holds the step holds against rho
    if (rho > 0.0) {
      collect_held(solved, k, held);
      continue;
    }
    const bool its_own = solved.row(held.row).level == k;
    keeping.push_back({held.row, its_own ? side_of(held) : target_above(solved, held, x_above)});
  }
  C_rows = stack(solved, fixed);
  V = stack(solved, own);
  W = stack(solved, keeping);
  e.resize(V.rows());
  for (Index i = 0; i < e.size(); ++i) {
    const Row& row = solved.row(own[i].row);
    e[i] = V.row(i).dot(x) - (own[i].target == Target::Upper ? row.upper : row.lower);
  }
}

void LevelPiece::collect_held(const SolvedHierarchy& solved, int k, const HeldRow& held) {
  if (solved.row(held.row).level == k) {
    own.push_back({held.row, side_of(held)});
  } else if (C.add(solved.dense(held.row))) {
    fixed.push_back({held.row, target_above(solved, held, x_above)});
  }
}

void LevelPiece::decompose() {
  Z = C.free_basis();
  U.resize(V.rows(), 0), Y.resize(V.cols(), 0), sigma.resize(0);
  if (V.rows() == 0 || Z.cols() == 0) return;
  const Svd svd(V * Z, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const Index rank = count_above(svd.singularValues(), tolerance::kRank * largest_row(V));
  U = svd.matrixU().leftCols(rank);
  sigma = svd.singularValues().head(rank);
  const Eigen::MatrixXd turned = Z * svd.matrixV();
  Y = turned.leftCols(rank);
  Z = turned.rightCols(Z.cols() - rank);
}

void LevelPiece::refine_violation() {
  // stationarity along Y: sigma U'e + rho^2 Y't = 0. V x - b has an absolute error, which 1 / rho^2
  // would make large
  const Vector t = x - x_above;
  for (Index j = 0; j < sigma.size(); ++j) {
    if (sigma[j] <= rho) continue;
    e += U.col(j) * (-rho * rho * Y.col(j).dot(t) / sigma[j] - U.col(j).dot(e));
  }
}

void LevelPiece::find_multipliers() {
  mu = C.solve_transposed(-rho * rho * (x - x_above) - V.transpose() * e);
  q.setZero(C.size());
  s.setZero(W.rows());
  Vp.setZero(V.rows());
  W_inverse.setZero(V.cols(), W.rows());
}

void LevelPiece::find_smallest_step_multipliers() {
  const Vector t = x - x_above;
  if (W.rows() > 0 && Z.cols() > 0) {
    const Svd svd(W * Z, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Index rank = count_above(svd.singularValues(), tolerance::kRank * largest_row(W));
    W_inverse = Z * svd.matrixV().leftCols(rank) *
                svd.singularValues().head(rank).cwiseInverse().asDiagonal() *
                svd.matrixU().leftCols(rank).transpose();
    s = -W_inverse.transpose() * t;
  }
  // V p = U sigma (Y'p),  Y'p = -Y'(t + W's) / sigma^2
  const Vector balance = t + W.transpose() * s;
  Vp = -U * (Y.transpose() * balance).cwiseQuotient(sigma);
  q = C.solve_transposed(-balance - V.transpose() * Vp);
}

Vector LevelPiece::step(const Vector& right, const Vector& force) const {
  const Vector along = sigma.cwiseProduct(U.transpose() * right) - Y.transpose() * force;
  const double rho2 = rho * rho;
  Vector t = Y * along.cwiseQuotient((sigma.array().square() + rho2).matrix());
  if (rho > 0.0) t -= Z * (Z.transpose() * force / rho2);
  return t;
}

LevelPiece::StepGradient LevelPiece::step_transposed(const Vector& t_bar) const {
  const double rho2 = rho * rho;
  const Vector along =
      (Y.transpose() * t_bar).cwiseQuotient((sigma.array().square() + rho2).matrix());
  StepGradient gradient{U * sigma.cwiseProduct(along), -Y * along};
  if (rho > 0.0) gradient.force -= Z * (Z.transpose() * t_bar / rho2);
  return gradient;
}

}  // namespace hurcules

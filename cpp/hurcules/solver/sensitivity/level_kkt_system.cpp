#include "hurcules/solver/sensitivity/level_kkt_system.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels/dense_decompositions.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

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

// what a row still wants at x_above: its target there less its value
Vector wanted(const SolvedHierarchy& solved, const std::vector<DecidingRow>& rows,
              const Vector& x_above) {
  Vector values = Vector::Zero(static_cast<Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].target == Target::Present) continue;
    const Row& row = solved.row(rows[i].row);
    const double target = rows[i].target == Target::Upper ? row.upper : row.lower;
    values[static_cast<Index>(i)] = target - solved.dense(rows[i].row).dot(x_above);
  }
  return values;
}

using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

double largest_row(const SolvedHierarchy& solved, const std::vector<DecidingRow>& rows) {
  double largest = 0.0;
  for (const DecidingRow& row : rows) largest = std::max(largest, solved.row(row.row).norm);
  return largest;
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

LevelKktSystem::LevelKktSystem(const SolvedHierarchy& solved, int k, const EqualityRows& above)
    : rho(solved.rho(k)), x_above(solved.x(k - 1)), x(solved.x(k)), C(above.space) {
  for (const int i : above.rows) fixed.push_back({i, Target::Present});
  find(solved, k);
}

LevelKktSystem::LevelKktSystem(const SolvedHierarchy& solved, int k, const Matrix& basis)
    : rho(solved.rho(k)), x_above(solved.x(k - 1)), x(solved.x(k)), B(basis), C(solved.unknowns()) {
  find(solved, k);
}

void LevelKktSystem::find(const SolvedHierarchy& solved, int k) {
  collect(solved, k);
  decompose(solved);
  invert_keeping(solved);
  find_step(solved);
  refine_violation();
  find_multipliers();
  if (rho == 0.0) find_smallest_step_multipliers();
  find_forces(solved);
}

Vector LevelKktSystem::on_step(const Vector& v) const {
  if (B.size() == 0) return v;
  return B.transpose() * v;
}

Vector LevelKktSystem::step_in_x(const Vector& step) const {
  if (B.size() == 0) return step;
  return B * step;
}

Matrix LevelKktSystem::stack(const SolvedHierarchy& solved,
                             const std::vector<DecidingRow>& rows) const {
  Matrix stacked(static_cast<Index>(rows.size()), solved.unknowns());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    stacked.row(static_cast<Index>(i)) = on_step(solved.dense(rows[i].row)).transpose();
  }
  return stacked;
}

void LevelKktSystem::collect(const SolvedHierarchy& solved, int k) {
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
  V = stack(solved, own);
  W = stack(solved, keeping);
  e.resize(V.rows());
  for (Index i = 0; i < e.size(); ++i) {
    const Row& row = solved.row(own[i].row);
    e[i] =
        solved.dense(own[i].row).dot(x) - (own[i].target == Target::Upper ? row.upper : row.lower);
  }
}

void LevelKktSystem::collect_held(const SolvedHierarchy& solved, int k, const HeldRow& held) {
  if (solved.row(held.row).level == k) {
    own.push_back({held.row, side_of(held)});
    return;
  }
  const Vector row = on_step(solved.dense(held.row));
  if (row.norm() > tolerance::kRank * solved.row(held.row).norm && C.add(row)) {
    fixed.push_back({held.row, target_above(solved, held, x_above)});
  }
}

void LevelKktSystem::decompose(const SolvedHierarchy& solved) {
  Z = C.free_basis();
  U.resize(V.rows(), 0), Y.resize(V.cols(), 0), sigma.resize(0);
  if (V.rows() == 0 || Z.cols() == 0) return;
  const Svd svd(V * Z, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const Index rank = count_above(svd.singularValues(), tolerance::kRank * largest_row(solved, own));
  U = svd.matrixU().leftCols(rank);
  sigma = svd.singularValues().head(rank);
  const Eigen::MatrixXd turned = Z * svd.matrixV();
  Y = turned.leftCols(rank);
  Z = turned.rightCols(Z.cols() - rank);
}

void LevelKktSystem::invert_keeping(const SolvedHierarchy& solved) {
  W_inverse.setZero(V.cols(), W.rows());
  if (W.rows() == 0 || Z.cols() == 0) return;
  const Svd svd(W * Z, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Index rank =
      count_above(svd.singularValues(), tolerance::kRank * largest_row(solved, keeping));
  W_inverse = Z * svd.matrixV().leftCols(rank) *
              svd.singularValues().head(rank).cwiseInverse().asDiagonal() *
              svd.matrixU().leftCols(rank).transpose();
}

void LevelKktSystem::find_step(const SolvedHierarchy& solved) {
  t = x - x_above;
  if (B.size() == 0) return;
  // B need not be regular: the t of its own conditions
  t = C.solve(wanted(solved, fixed, x_above));
  t += step(wanted(solved, own, x_above) - V * t, Vector::Zero(t.size()));
  t += W_inverse * (wanted(solved, keeping, x_above) - W * t);
}

void LevelKktSystem::refine_violation() {
  // stationarity along Y: sigma U'e + rho^2 Y't = 0. V x - b has an absolute error, which 1 / rho^2
  // would make large
  for (Index j = 0; j < sigma.size(); ++j) {
    if (sigma[j] <= rho) continue;
    e += U.col(j) * (-rho * rho * Y.col(j).dot(t) / sigma[j] - U.col(j).dot(e));
  }
}

void LevelKktSystem::find_multipliers() {
  mu = C.solve_transposed(-rho * rho * t - V.transpose() * e);
  q.setZero(C.size());
  s.setZero(W.rows());
  Vp.setZero(V.rows());
}

void LevelKktSystem::find_smallest_step_multipliers() {
  s = -W_inverse.transpose() * t;
  // V p = U sigma (Y'p),  Y'p = -Y'(t + W's) / sigma^2
  const Vector balance = t + W.transpose() * s;
  Vp = -U * (Y.transpose() * balance).cwiseQuotient(sigma);
  q = C.solve_transposed(-balance - V.transpose() * Vp);
}

void LevelKktSystem::find_forces(const SolvedHierarchy& solved) {
  force.setZero(x.size());
  force_of_step.setZero(x.size());
  if (B.size() == 0) return;
  const auto add = [&](const std::vector<DecidingRow>& rows, const Vector& by, Vector& sum) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      sum += by[static_cast<Index>(i)] * solved.dense(rows[i].row);
  };
  add(own, e, force);
  add(fixed, mu, force);
  add(own, Vp, force_of_step);
  add(fixed, q, force_of_step);
  add(keeping, s, force_of_step);
}

Vector LevelKktSystem::step(const Vector& right, const Vector& push) const {
  const Vector along = sigma.cwiseProduct(U.transpose() * right) - Y.transpose() * push;
  const double rho2 = rho * rho;
  Vector smallest = Y * along.cwiseQuotient((sigma.array().square() + rho2).matrix());
  if (rho > 0.0) smallest -= Z * (Z.transpose() * push / rho2);
  return smallest;
}

LevelKktSystem::StepGradient LevelKktSystem::step_transposed(const Vector& t_bar) const {
  const double rho2 = rho * rho;
  const Vector along =
      (Y.transpose() * t_bar).cwiseQuotient((sigma.array().square() + rho2).matrix());
  StepGradient gradient{U * sigma.cwiseProduct(along), -Y * along};
  if (rho > 0.0) gradient.push -= Z * (Z.transpose() * t_bar / rho2);
  return gradient;
}

}  // namespace hurcules

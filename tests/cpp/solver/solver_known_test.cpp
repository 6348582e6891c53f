// Strategy: hierarchies built around an answer that is known beforehand. Active limits,
// multipliers, ranks and conflicts are drawn first; step and right-hand sides follow from the
// optimality conditions (solver.md §1, [T 3.4.100-113]), the same for every regularisation from 1
// to 1e-9 and 0.
//
// The unknowns fall into three groups of orthonormal directions F, one for each task. With
//     A = M F,  N = G F  (G orthonormal),  t = -F'(M'w + G'nu),  v = rho^2 w + s + u,
// where the conflict u has A'u = 0 and s pushes against the first limit alone (M's + G_1' mu_s =
// 0),
//     rho^2 t + A'v + N'mu = 0   for   mu = rho^2 nu + (mu_s, 0 ..) > 0,
// so that x_{k-1} + t is the answer of the level, and the limits N that lie at it hold.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>

#include "hurcules/solver/solver.hpp"
#include "support/draw.hpp"
#include "support/hierarchy_text.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;

constexpr Index kUnknowns = 18;
constexpr Index kGroups = 3;

class KnownHierarchy {
 public:
  KnownHierarchy(unsigned seed, double rho) : draw_(seed), rho_(rho) {
    frame_ = orthonormal(kUnknowns, kUnknowns);
    lower_ = upper_ = x = Vector::Zero(kUnknowns);
    levels.emplace_back();
    for (Index group = 0; group < kGroups; ++group) add_group(group);
    // a box that nothing touches on the way
    levels[0] = make_bounds(lower_ - draw_.uniform_vector(kUnknowns, 0.05, 1.0),
                            upper_ + draw_.uniform_vector(kUnknowns, 0.05, 1.0));
  }

  Hierarchy levels;
  Vector x;                        // the answer
  std::vector<Vector> violations;  // of the tasks, at the end
  std::vector<ActiveRow> pushing;  // limits that hold

 private:
  static constexpr Index kSize = kUnknowns / kGroups;

  // m orthonormal rows of length n
  Matrix orthonormal(Index m, Index n) {
    const Eigen::MatrixXd random = draw_.unit_rows(n, n);
    const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(random).householderQ();
    return Q.topRows(m);
  }

  void add_group(Index group) {
    const Matrix F = frame_.middleRows(group * kSize, kSize);
    const Index rank = draw_.integer(1, 3), held = draw_.integer(0, kSize - rank);
    const Index conflicts = draw_.integer(0, 2);
    const Matrix basis = draw_.unit_rows(rank, kSize), mix = draw_.unit_rows(conflicts, rank);
    Matrix M(rank + conflicts, kSize);
    M << basis, mix * basis;
    const Vector w = draw_.vector(rank + conflicts);
    const Vector wanted = -M.transpose() * w;  // where the task would go without limits
    // the conflict, and what one limit keeps the task from
    Vector v = rho_ * rho_ * w, strong = Vector::Zero(rank + conflicts);
    const Vector u = draw_.vector(conflicts);
    v.tail(conflicts) += u;
    v.head(rank) -= mix.transpose() * u;
    if (held > 0) strong.head(rank) = draw_.vector(rank) * draw_.choose({0.0, 1.0});
    if ((M.transpose() * strong).dot(wanted) > 0.0) strong = -strong;
    const Vector nu = add_limits(F, M.transpose() * strong, wanted, held);
    add_task(F, M, rank, v + strong);
    Vector step = wanted;
    for (Index i = 0; i < held; ++i) step -= nu[i] * G_.row(i).transpose();
    finish_group(F, M, rank, F.transpose() * step);
  }

  // orthonormal normals that the task runs into; the first takes the force `strong`
  Vector add_limits(const Matrix& F, const Vector& strong, const Vector& wanted, Index held) {
    const Matrix random = draw_.unit_rows(held, kSize);
    G_ = random;
    if (strong.norm() > 0.0) G_.row(0) = -strong.transpose();
    Vector nu(held);
    const int task = static_cast<int>(levels.size()) + 1;
    for (Index i = 0; i < held; ++i) {
      for (Index j = 0; j < i; ++j) G_.row(i) -= G_.row(i).dot(G_.row(j)) * G_.row(j);
      G_.row(i).normalize();
      if (G_.row(i).dot(wanted) < 0.0) G_.row(i) *= -1.0;
      nu[i] = draw_.uniform(0.1, 0.9) * G_.row(i).dot(wanted);
      if (nu[i] < 1e-3) continue;  // at right angles to the task: touched, not pushed
      const double force = rho_ * rho_ * nu[i] + (i == 0 ? strong.norm() : 0.0);
      pushing.push_back({task - 1, static_cast<int>(i), Side::Upper, task, force});
    }
    levels.push_back(
        interval(G_ * F + above(held), Vector::Constant(held, -kNoLimit), Vector::Zero(held), 0.0));
    return nu;
  }

  void add_task(const Matrix& F, const Matrix& M, Index rank, const Vector& v) {
    Level task = equality(M * F + above(M.rows()), v, rho_);
    // a conflicting row may as well be one-sided, on the side where it is violated
    for (Index i = rank; i < M.rows(); ++i) {
      if (draw_.chance(0.5)) continue;
      (v[i] > 0.0 ? task.lower : task.upper)[i] = v[i] > 0.0 ? -kNoLimit : kNoLimit;
    }
    levels.push_back(task);
    violations.push_back(v);
  }

  // right-hand sides, once the step is known
  void finish_group(const Matrix& F, const Matrix& M, Index rank, const Vector& step) {
    x += step;
    Level& task = levels[levels.size() - 1];
    Level& limits = levels[levels.size() - 2];
    limits.upper = limits.A * x;
    for (Vector* side : {&task.lower, &task.upper}) {
      *side = side->array().isFinite().select(task.A * x - *side, *side);
    }
    lower_ = lower_.cwiseMin(x);
    upper_ = upper_.cwiseMax(x);
    taken_.conservativeResize(taken_.rows() + rank, kUnknowns);
    taken_.bottomRows(rank) = M.topRows(rank) * F;
  }

  // rows may also contain what the tasks above have taken
  Matrix above(Index rows) { return draw_.unit_rows(rows, taken_.rows()) * taken_; }

  Draw draw_;
  double rho_;
  Matrix frame_, G_;
  Matrix taken_{0, kUnknowns};
  Vector lower_, upper_;
};

class SolverKnown : public testing::TestWithParam<double> {
 protected:
  static constexpr unsigned kProblems = 100;
};

TEST_P(SolverKnown, FindsTheAnswerThatTheHierarchyWasBuiltAround) {
  for (unsigned seed = 0; seed < kProblems; ++seed) {
    const KnownHierarchy known(seed, GetParam());
    Solver solver(kUnknowns);
    const Solution& solution = solver.solve(known.levels);
    const double size = std::max(1.0, known.x.lpNorm<Eigen::Infinity>());
    ASSERT_EQ(to_string(solution.status), "solved") << "seed " << seed;
    ASSERT_LE((solution.x - known.x).lpNorm<Eigen::Infinity>(), 1e-8 * size)
        << "seed " << seed << "\n"
        << as_text(known.levels) << vector_text(known.x);
    for (Index group = 0; group < kGroups; ++group) {
      const Vector& wanted = known.violations[group];
      ASSERT_LE((solution.violations[2 * group + 2] - wanted).norm(), 1e-9 * size)
          << "seed " << seed;
    }
  }
}

TEST_P(SolverKnown, NamesTheLimitsThatHoldAndTheirMultipliers) {
  for (unsigned seed = 0; seed < kProblems; ++seed) {
    const KnownHierarchy known(seed, GetParam());
    Solver solver(kUnknowns);
    const Solution& solution = solver.solve(known.levels);
    for (const ActiveRow& wanted : known.pushing) {
      const auto found = std::find_if(
          solution.working_set.begin(), solution.working_set.end(), [&](const ActiveRow& row) {
            return row.level == wanted.level && row.row == wanted.row && row.side == wanted.side &&
                   row.held_by == wanted.held_by;
          });
      ASSERT_NE(found, solution.working_set.end())
          << "seed " << seed << ": level " << wanted.level << ", row " << wanted.row;
      EXPECT_NEAR(found->multiplier, wanted.multiplier, 1e-9 * std::max(1.0, known.x.norm()))
          << "seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Regularisations, SolverKnown,
                         testing::Values(1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9,
                                         0.0));

}  // namespace
}  // namespace hurcules

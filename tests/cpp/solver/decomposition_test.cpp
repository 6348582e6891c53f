// Strategy: the defining properties of both kinds of decomposition on random levels: ranks lost by
// construction, more rows than directions, no rows, zero rows, mixed scales. The identities of the
// thesis on top of it: claims_decomposition_test.
#include "hurcules/solver/thesis/decomposition.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>
#include <vector>

#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using hurcules_test::RandomHierarchy;

class BothKinds : public testing::TestWithParam<FactorKind> {};

struct Levels {
  explicit Levels(Hierarchy levels, FactorKind kind)
      : hierarchy(std::move(levels)), decomposition(kind) {
    std::vector<Index> rows;
    Index all = 0;
    for (const Level& level : hierarchy) {
      views.push_back(view(level));
      rows.push_back(level.rows());
      all += level.rows();
    }
    table.reserve(7, all, static_cast<Index>(rows.size()));
    EXPECT_TRUE(table.read(views));
    decomposition.reserve(7, rows);
    decomposition.start();
    for (int k = 0; k < table.levels(); ++k) {
      std::vector<HeldLimit> held;
      for (int i = table.begin(k); i < table.begin(k + 1); ++i) held.push_back({i, 1.0, 0.0});
      decomposition.add_level(table, held);
    }
    basis.resize(7, 7);
    for (Index j = 0; j < 7; ++j) {
      basis.row(j) = Eigen::Map<const Vector>(decomposition.direction(j), 7);
    }
  }

  Hierarchy hierarchy;
  std::vector<LevelView> views;
  RowTable table;
  HierarchicalDecomposition decomposition;
  Matrix basis;
};

Hierarchy awkward(unsigned seed) {
  RandomHierarchy random(seed);
  Hierarchy levels = {random.equality(2, 7, 0.0), random.equality(5, 7, 0.0),
                      Level{.A = Matrix(0, 7), .lower = {}, .upper = {}},
                      random.equality(9, 7, 0.0)};
  levels[0].A.row(1) *= 1e3;
  levels[1].A.row(0) = 2.0 * levels[0].A.row(0);
  levels[1].A.row(3) = levels[1].A.row(2) - levels[1].A.row(1);
  levels[1].A.row(4).setZero();
  levels[3].A *= 1e-3;
  return levels;
}

TEST_P(BothKinds, RanksAreThoseOfTheConstruction) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Levels levels(awkward(seed), GetParam());
    const Index wanted[] = {2, 2, 0, 3};
    for (Index k = 0; k < 4; ++k) EXPECT_EQ(levels.decomposition.level(k).rank, wanted[k]) << seed;
    EXPECT_EQ(levels.decomposition.free(), 0);
  }
}

TEST_P(BothKinds, TheBasisIsOrthonormalAndTheLevelIsUSInIt) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Levels levels(awkward(seed), GetParam());
    EXPECT_LT((levels.basis * levels.basis.transpose() - Matrix::Identity(7, 7)).norm(), 1e-13);
    for (std::size_t k = 0; k < 4; ++k) {
      const LevelFactor& level = levels.decomposition.level(static_cast<Index>(k));
      const Index l = level.rank, first = levels.decomposition.first(static_cast<Index>(k));
      const Matrix U = level.Ut.topLeftCorner(l, level.rows).transpose();
      Matrix S = level.S.topLeftCorner(l, l).triangularView<Eigen::Upper>();
      if (GetParam() == FactorKind::SingularValues) S = Matrix(S.diagonal().asDiagonal());
      const Matrix& J = levels.hierarchy[k].A;
      const double scale = J.size() ? J.norm() : 1.0;
      const Matrix JY = J * levels.basis.middleRows(first, l).transpose();
      EXPECT_LT((JY - U * S).norm(), 1e-13 * scale) << seed << " level " << k;
      EXPECT_LT((U.transpose() * U - Matrix::Identity(l, l)).norm(), 1e-13);
      // nothing of it is left for the levels below  [T 3.3.34]
      EXPECT_LT((J * levels.basis.bottomRows(7 - first - l).transpose()).norm(), 1e-13 * scale);
    }
  }
}

std::string kind_of(const testing::TestParamInfo<FactorKind>& kind) {
  return kind.param == FactorKind::SingularValues ? "SingularValues" : "CompleteOrthogonal";
}

INSTANTIATE_TEST_SUITE_P(Decomposition, BothKinds,
                         testing::Values(FactorKind::SingularValues,
                                         FactorKind::CompleteOrthogonal),
                         kind_of);

TEST(Decomposition, SingularValuesFitTraceAndDeterminant) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomHierarchy random(seed);
    const Levels levels({random.equality(4, 7, 0.0)}, FactorKind::SingularValues);
    const LevelFactor& level = levels.decomposition.level(0);
    const Matrix& J = levels.hierarchy[0].A;
    const Vector sigma = level.S.topLeftCorner(4, 4).diagonal();
    EXPECT_NEAR(sigma.squaredNorm(), (J * J.transpose()).trace(), 1e-12 * J.squaredNorm());
    EXPECT_NEAR(sigma.prod(), std::sqrt(Matrix(J * J.transpose()).determinant()), 1e-11);
    for (Index i = 1; i < 4; ++i) EXPECT_GE(sigma[i - 1], sigma[i]);
  }
}

}  // namespace
}  // namespace hurcules

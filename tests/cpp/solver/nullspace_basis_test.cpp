// Strategy: the defining properties of the basis on random rows, with rank deficiency by
// construction. [T 2.2.15-23]
#include "hurcules/solver/problem/nullspace_basis.hpp"

#include <gtest/gtest.h>

#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

struct Built {
  Hierarchy levels;
  std::vector<LevelView> views;
  RowTable rows;
  NullspaceBasis nullspace;
};

void build(Built& built, Index unknowns) {
  for (const Level& level : built.levels) built.views.push_back(view(level));
  const Index levels = static_cast<Index>(built.levels.size());
  Index rows = 0;
  for (const Level& level : built.levels) rows += level.rows();
  built.rows.reserve(unknowns, rows, levels);
  ASSERT_TRUE(built.rows.read(built.views));
  built.nullspace.reserve(unknowns, rows, levels);
  built.nullspace.build(built.rows);
}

// level 1 repeats a row of level 0 and sums two others, so it adds one direction only
Hierarchy rank_deficient(unsigned seed) {
  hurcules_test::RandomHierarchy random(seed);
  Hierarchy levels = {random.equality(3, 8, 0.1), random.equality(3, 8, 0.1),
                      random.interval(4, 8, 0.1)};
  levels[1].A.row(0) = levels[0].A.row(2);
  levels[1].A.row(2) = levels[0].A.row(0) - 2.0 * levels[0].A.row(1);
  return levels;
}

TEST(NullspaceBasis, DirectionsAreOrthonormalAndCompleteTheSpace) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Built built{.levels = rank_deficient(seed), .views = {}, .rows = {}, .nullspace = {}};
    build(built, 8);
    built.nullspace.complete(built.rows);
    Matrix Q(8, 8);
    for (Index j = 0; j < 8; ++j)
      Q.row(j) = Eigen::Map<const Vector>(built.nullspace.direction(j), 8);
    EXPECT_LT((Q * Q.transpose() - Matrix::Identity(8, 8)).norm(), 1e-13) << "seed " << seed;
  }
}

TEST(NullspaceBasis, RankCountsOnlyNewDirections) {
  Built built{.levels = rank_deficient(7), .views = {}, .rows = {}, .nullspace = {}};
  build(built, 8);
  EXPECT_EQ(built.nullspace.rank_before(0), 0);
  EXPECT_EQ(built.nullspace.rank_before(1), 3);
  EXPECT_EQ(built.nullspace.rank_before(2), 4);  // by construction
  EXPECT_EQ(built.nullspace.rank_before(3), 4);  // interval rows take no direction
}

TEST(NullspaceBasis, FreeDirectionsDoNotMoveTheRowsAbove) {
  Built built{.levels = rank_deficient(3), .views = {}, .rows = {}, .nullspace = {}};
  build(built, 8);
  built.nullspace.complete(built.rows);
  for (Index j = 4; j < 8; ++j) {
    const Vector z = Eigen::Map<const Vector>(built.nullspace.direction(j), 8);
    EXPECT_LT((built.levels[0].A * z).norm(), 1e-13);  // J_{k-1} Z_{k-1} = 0
    EXPECT_LT((built.levels[1].A * z).norm(), 1e-13);
  }
}

TEST(NullspaceBasis, CoordinatesRebuildEveryRow) {
  Built built{.levels = rank_deficient(5), .views = {}, .rows = {}, .nullspace = {}};
  build(built, 8);
  built.nullspace.complete(built.rows);
  for (int i = 0; i < built.rows.size(); ++i) {
    Vector a = Vector::Zero(8);
    for (Index j = 0; j < 8; ++j) {
      a += built.nullspace.coordinates(built.rows[i])[j] *
           Eigen::Map<const Vector>(built.nullspace.direction(j), 8);
    }
    const double* row = built.rows.dense_row(built.rows[i].dense);
    EXPECT_LT((a - Eigen::Map<const Vector>(row, 8)).norm(), 1e-13) << "row " << i;
  }
}

}  // namespace
}  // namespace hurcules

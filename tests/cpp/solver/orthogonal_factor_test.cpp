// Strategy: the defining properties  rows = L Q, Q orthonormal, L triangular  on seeded rows, built
// at once, row by row, and after removals; rows next to the span of others by construction. Not
// tested here: what the rows mean.
#include "hurcules/solver/kernels/orthogonal_factor.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hurcules/base/types.hpp"

namespace hurcules {
namespace {

constexpr Index kColumns = 11;
constexpr double kTolerance = 1e-10;

Matrix random_rows(Index rows, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(rows, kColumns, [&] { return normal(generator); });
}

void put(OrthogonalFactor& factor, Index i, const Eigen::RowVectorXd& row) {
  std::fill_n(factor.row(i), padded(kColumns), 0.0);
  std::copy_n(row.data(), kColumns, factor.row(i));
}

OrthogonalFactor built(const Matrix& rows) {
  OrthogonalFactor factor;
  factor.reserve(rows.rows() + 1, kColumns);
  factor.start(rows.rows(), kColumns);
  const Vector norm2 = rows.rowwise().squaredNorm();
  for (Index i = 0; i < rows.rows(); ++i) put(factor, i, rows.row(i));
  factor.run(0, rows.rows(), norm2.data(), kTolerance);
  factor.clear_unknown(0, rows.rows());
  return factor;
}

Matrix directions(const OrthogonalFactor& factor) {
  Matrix Q(factor.rank(), kColumns);
  for (Index j = 0; j < factor.rank(); ++j) {
    Q.row(j) = Eigen::Map<const Eigen::RowVectorXd>(factor.direction(j), kColumns);
  }
  return Q;
}

void expect_factors(const OrthogonalFactor& factor, const Matrix& rows) {
  const Matrix Q = directions(factor);
  EXPECT_LT((Q * Q.transpose() - Matrix::Identity(Q.rows(), Q.rows())).norm(), 1e-13);
  for (Index i = 0; i < rows.rows(); ++i) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(kColumns);
    for (Index j = 0; j < std::min(i + 1, factor.rank()); ++j) {
      row += factor.coordinates(i)[j] * Q.row(j);
    }
    EXPECT_LT((row - rows.row(i)).norm(), 1e-13 * rows.row(i).norm()) << "row " << i;
  }
}

TEST(OrthogonalFactor, RowsAreRebuiltFromTheirCoordinates) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Matrix rows = random_rows(1 + seed % kColumns, seed);
    const OrthogonalFactor factor = built(rows);
    ASSERT_EQ(factor.rank(), rows.rows());
    expect_factors(factor, rows);
  }
}

TEST(OrthogonalFactor, ARowNextToTheSpanStaysOrthogonal) {
  for (const double off : {1e-3, 1e-6, 1e-9}) {
    Matrix rows = random_rows(4, 3);
    rows.row(2) = rows.row(0) - 2.0 * rows.row(1) + off * random_rows(1, 4);
    const OrthogonalFactor factor = built(rows);
    ASSERT_EQ(factor.rank(), 4) << off;
    expect_factors(factor, rows);
  }
}

TEST(OrthogonalFactor, DependentRowsGiveNoDirection) {
  Matrix rows = random_rows(4, 5);
  rows.row(1) = -3.0 * rows.row(0);
  rows.row(3).setZero();
  const OrthogonalFactor factor = built(rows);
  ASSERT_EQ(factor.rank(), 2);
  EXPECT_EQ(factor.pivot(0), 0);
  EXPECT_EQ(factor.pivot(1), 2);
}

TEST(OrthogonalFactor, AppendedAndRemovedRowsGiveTheFactorOfTheRest) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Matrix rows = random_rows(6, seed);
    OrthogonalFactor factor = built(rows.topRows(4));
    for (Index i = 4; i < 6; ++i) {
      put(factor, i, rows.row(i));
      ASSERT_TRUE(factor.append(rows.row(i).squaredNorm(), kTolerance));
    }
    expect_factors(factor, rows);
    // g of L g = b turns with the removal
    const Vector b = Vector::LinSpaced(6, 1.0, 2.0);
    Vector g = b;
    factor.solve(g.data());
    const Index gone = seed % 6;
    factor.remove(gone, g.data());
    Matrix rest(5, kColumns);
    Vector b_rest(5);
    for (Index i = 0; i < 5; ++i) {
      rest.row(i) = rows.row(i + (i >= gone));
      b_rest[i] = b[i + (i >= gone)];
    }
    expect_factors(factor, rest);
    factor.solve(b_rest.data());
    EXPECT_LT((g.head(5) - b_rest).norm(), 1e-11 * b_rest.norm());
  }
}

TEST(OrthogonalFactor, ADependentRowIsNotAppended) {
  const Matrix rows = random_rows(3, 9);
  OrthogonalFactor factor = built(rows);
  const Eigen::RowVectorXd sum = rows.row(0) + rows.row(2);
  put(factor, 3, sum);
  EXPECT_FALSE(factor.append(sum.squaredNorm(), kTolerance));
  EXPECT_EQ(factor.rank(), 3);
}

}  // namespace
}  // namespace hurcules

// Claims R01, R02, R05 to R10 and R12 on the decomposition itself: identities of sections 2.2
// and 3.3 of the thesis on seeded random rows with rank deficiency inside and between levels by
// construction. R02 is stated for tasks of full rank, so it has its own rows. Tolerance: rounding
// of 9 unknowns.
#include <Eigen/QR>
#include <vector>

#include "hurcules/solver/thesis/decomposition.hpp"
#include "support/expect.hpp"
#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using hurcules_test::near;
using hurcules_test::RandomHierarchy;

constexpr Index kUnknowns = 9;
constexpr double kRounding = 1e-12;
constexpr unsigned kSeeds = 50;

Matrix pseudo_inverse(const Matrix& A) {
  return Eigen::MatrixXd(A).completeOrthogonalDecomposition().pseudoInverse();
}

// V of [U V], orthogonal: an orthonormal basis of what the columns of U leave
Matrix complement(const Matrix& U) {
  const Index m = U.rows(), l = U.cols();
  if (l == 0) return Matrix::Identity(m, m);
  const Eigen::MatrixXd all = Eigen::HouseholderQR<Eigen::MatrixXd>(U).householderQ();
  return all.rightCols(m - l);
}

// the objects of section 3.3.3 as full matrices, in the letters of the thesis
struct Case {
  Hierarchy levels;
  std::vector<LevelView> views;
  RowTable table;
  HierarchicalDecomposition decomposition{FactorKind::SingularValues};
  std::vector<Matrix> U, V, S, Y, Z;  // Z[k] = Z_k after level k

  explicit Case(Hierarchy hierarchy) : levels(std::move(hierarchy)) {
    std::vector<Index> rows;
    for (const Level& level : levels) {
      views.push_back(view(level));
      rows.push_back(level.rows());
    }
    table.reserve(kUnknowns, 9, 3);
    EXPECT_TRUE(table.read(views));
    decomposition.reserve(kUnknowns, rows);
    decomposition.start();
    for (int k = 0; k < table.levels(); ++k) add(k);
  }

  void add(int k) {
    std::vector<HeldLimit> held;
    for (int i = table.begin(k); i < table.begin(k + 1); ++i) {
      held.push_back({i, 1.0, table[i].upper});
    }
    decomposition.add_level(table, held);
    const LevelFactor& factor = decomposition.level(k);
    const Index m = factor.rows, l = factor.rank, first = decomposition.first(k);
    U.push_back(factor.Ut.topLeftCorner(l, m).transpose());
    V.push_back(complement(U.back()));
    S.push_back(factor.S.topLeftCorner(l, l).diagonal().asDiagonal());
    Matrix basis(kUnknowns, kUnknowns);  // columns
    for (Index j = 0; j < kUnknowns; ++j) {
      basis.col(j) = Eigen::Map<const Vector>(decomposition.direction(j), kUnknowns);
    }
    Y.push_back(basis.middleCols(first, l));
    Z.push_back(basis.rightCols(kUnknowns - first - l));
  }

  [[nodiscard]] int size() const { return static_cast<int>(levels.size()); }
  [[nodiscard]] const Matrix& J(int k) const { return levels[k].A; }
  [[nodiscard]] const Vector& y(int k) const { return levels[k].upper; }
  // levels 0 .. k below each other
  [[nodiscard]] Matrix stacked_J(int k) const {
    Matrix result(table.begin(k + 1), kUnknowns);
    for (int j = 0; j <= k; ++j) result.middleRows(table.begin(j), J(j).rows()) = J(j);
    return result;
  }
  [[nodiscard]] Vector stacked_y(int k) const {
    Vector result(table.begin(k + 1));
    for (int j = 0; j <= k; ++j) result.segment(table.begin(j), y(j).size()) = y(j);
    return result;
  }
  [[nodiscard]] Matrix stacked_Y(int k) const {
    Matrix result(kUnknowns, 0);
    for (int j = 0; j <= k; ++j) {
      result.conservativeResize(Eigen::NoChange, result.cols() + Y[j].cols());
      result.rightCols(Y[j].cols()) = Y[j];
    }
    return result;
  }
  // filtered inverse of the singular values  [T 3.3.38]
  [[nodiscard]] Matrix S_hat(int k, double rho) const {
    const Vector sigma = S[k].diagonal();
    return (sigma.array() / (sigma.array().square() + rho * rho)).matrix().asDiagonal();
  }
  // Y_k S^_k U_k'
  [[nodiscard]] Matrix inverse(int k, double rho) const {
    return Y[k] * S_hat(k, rho) * U[k].transpose();
  }
  // J_k^{rho #}, recursively  [T 3.3.85], [T 3.3.88]
  [[nodiscard]] Matrix stacked_inverse(int k, double rho) const {
    Matrix result(kUnknowns, 0);
    for (int j = 0; j <= k; ++j) {
      const Matrix I = Matrix::Identity(kUnknowns, kUnknowns);
      const Matrix left = (I - inverse(j, rho) * J(j)) * result;
      result.resize(kUnknowns, left.cols() + J(j).rows());
      result << left, inverse(j, rho);
    }
    return result;
  }
  [[nodiscard]] std::vector<Vector> x(double rho) {
    std::vector<Vector> result;
    Vector x = Vector::Zero(kUnknowns);
    for (int k = 0; k < size(); ++k) {
      Vector r = y(k) - J(k) * x;
      decomposition.step(k, rho, r, x);
      result.push_back(x);
    }
    return result;
  }
};

// level 1 repeats a row of level 0 and sums two others; level 2 repeats a row of its own
Hierarchy deficient(unsigned seed) {
  RandomHierarchy random(seed);
  Hierarchy levels = {random.equality(3, kUnknowns, 0.1), random.equality(3, kUnknowns, 0.1),
                      random.equality(3, kUnknowns, 0.1)};
  levels[1].A.row(0) = levels[0].A.row(2);
  levels[1].A.row(2) = levels[0].A.row(0) - 2.0 * levels[0].A.row(1);
  levels[2].A.row(2) = levels[2].A.row(1);
  return levels;
}

int moore_penrose(const Matrix& A, const Matrix& X) {
  return near(A * X * A, A, 1e-10) + near(X * A * X, X, 1e-10) +
         near((A * X).transpose(), A * X, 1e-10) + near((X * A).transpose(), X * A, 1e-10);
}

TEST(Claims, R01ProjectorsFollowTheRecursion) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Case c(deficient(seed));
    const Matrix I = Matrix::Identity(kUnknowns, kUnknowns);
    Matrix P = I;
    for (int k = 0; k < c.size(); ++k) {
      P -= c.Y[k] * c.Y[k].transpose();  // [T 2.3.29]
      const Matrix J = c.stacked_J(k), X = pseudo_inverse(J);
      ASSERT_EQ(moore_penrose(J, X), 4) << "seed " << seed;           // [T 2.2.9-12]
      EXPECT_TRUE(near(P, I - X * J, kRounding)) << "seed " << seed;  // [T 2.2.8]
      EXPECT_TRUE(near(P, P.transpose(), kRounding));
      EXPECT_TRUE(near(P * P, P, kRounding));
    }
    EXPECT_EQ(moore_penrose(c.J(0), c.inverse(0, 0.0)), 4) << "seed " << seed;  // [T 3.3.33]
  }
}

TEST(Claims, R02LowerTasksDoNotDisturbHigherOnes) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    RandomHierarchy random(seed);
    Case c({random.equality(3, kUnknowns, 0.0), random.equality(3, kUnknowns, 0.0),
            random.equality(2, kUnknowns, 0.0)});
    const Vector x = c.x(0.0).back();
    for (int k = 0; k < c.size(); ++k) {
      EXPECT_TRUE(near(c.J(k) * x, c.y(k), 1e-11)) << "seed " << seed;  // [T 2.2.18], [T 2.2.21]
      if (k == 0) continue;
      const Matrix P = c.Z[k - 1] * c.Z[k - 1].transpose();
      EXPECT_TRUE(near(pseudo_inverse(c.J(k) * P), c.inverse(k, 0.0), 1e-11));
      EXPECT_LT((c.stacked_J(k - 1) * c.inverse(k, 0.0)).norm(), 1e-11);  // [T 2.2.23]
    }
  }
}

TEST(Claims, R05RegularisationLeavesTheNullSpaceToLowerLevels) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Case c(deficient(seed));
    for (int k = 0; k < c.size(); ++k) {
      const Matrix H = c.J(k).transpose() * c.J(k) +
                       0.01 * c.Y[k] * c.Y[k].transpose();  // [T 3.3.17], [T 3.3.35]
      EXPECT_LT((H * c.Z[k]).norm(), kRounding);            // [T 3.3.92]
      EXPECT_LT((c.y(k).transpose() * c.J(k) * c.Z[k]).norm(), kRounding);  // [T 3.3.93]
    }
  }
}

TEST(Claims, R06NullSpaceBasisGivesTheProjector) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Case c(deficient(seed));
    Index used = 0;
    for (const Index rank : {3, 1, 2}) {  // by construction
      const auto k = static_cast<std::size_t>(used == 0 ? 0 : (used == 3 ? 1 : 2));
      used += rank;
      const Matrix J = c.stacked_J(static_cast<int>(k));
      EXPECT_EQ(c.Z[k].cols(), kUnknowns - used);
      EXPECT_TRUE(near(c.Z[k] * c.Z[k].transpose(),
                       Matrix::Identity(kUnknowns, kUnknowns) - pseudo_inverse(J) * J,
                       kRounding));  // [T 3.3.42]
    }
  }
}

TEST(Claims, R07ErrorSplitsIntoInfeasibleAndRegularisationPart) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Case c(deficient(seed));
    for (const double rho : {0.0, 0.1, 1.0}) {
      const std::vector<Vector> x = c.x(rho);
      for (int k = 0; k < c.size(); ++k) {
        const Vector above = k ? x[k - 1] : Vector::Zero(kUnknowns);
        const Vector before = c.J(k) * above - c.y(k), e = c.J(k) * x[k] - c.y(k);
        const Vector sigma = c.S[k].diagonal();
        const Vector T = rho * rho / (sigma.array().square() + rho * rho);           // [T 3.3.46]
        const Vector v = c.V[k] * (c.V[k].transpose() * before);                     // [T 3.3.78]
        const Vector u = c.U[k] * (T.asDiagonal() * (c.U[k].transpose() * before));  // [T 3.3.80]
        EXPECT_TRUE(near(e, v + u, 1e-11)) << "seed " << seed << " rho " << rho;
        EXPECT_EQ(u.norm() == 0.0, rho == 0.0);
        // level 0 is not singular
        if (k == 0) {
          EXPECT_LT(v.norm(), kRounding);
        }
      }
    }
  }
}

// W S Y' of levels 0 .. k  [T 3.3.81-83]
struct Stacked {
  Matrix W, S, Y;
};

Stacked stacked(const Case& c, int last) {
  const Index m = c.table.begin(last + 1);
  Stacked result{Matrix::Zero(m, m), Matrix::Zero(m, c.stacked_Y(last).cols()), c.stacked_Y(last)};
  for (int k = 0; k <= last; ++k) {
    const Index first = c.table.begin(k), rows = c.J(k).rows(), l = c.U[k].cols();
    Matrix W(rows, rows);
    W << c.U[k], c.V[k];  // [T 3.3.65]
    result.W.block(first, first, rows, rows) = W;
    const Index place = c.decomposition.first(k);
    // [E S; F 0] = [U' J Y_above, S; V' J Y_above, 0]  [T 3.3.62-66]
    result.S.block(first, 0, rows, place) = W.transpose() * c.J(k) * result.Y.leftCols(place);
    result.S.block(first, place, l, l) = c.S[k];
  }
  return result;
}

TEST(Claims, R08HierarchicalDecompositionRebuildsTheRows) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Case c(deficient(seed));
    for (int k = 0; k < c.size(); ++k) {
      const Stacked s = stacked(c, k);
      EXPECT_TRUE(near(s.W * s.S * s.Y.transpose(), c.stacked_J(k), kRounding)) << "seed " << seed;
      EXPECT_TRUE(near(s.W.transpose() * s.W, Matrix::Identity(s.W.rows(), s.W.rows()), kRounding));
    }
  }
}

TEST(Claims, R09RegularisedInverseMeetsNoMoorePenroseCondition) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Case c(deficient(seed));
    const Matrix J = c.stacked_J(2), X = c.stacked_inverse(2, 0.1);
    EXPECT_TRUE(near(c.x(0.1).back(), X * c.stacked_y(2), 1e-10)) << "seed " << seed;  // [T 3.3.84]
    EXPECT_EQ(moore_penrose(J, X), 0) << "seed " << seed;
  }
}

TEST(Claims, R10UnregularisedInverseMeetsThreeOfThem) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Case c(deficient(seed));
    const Matrix J = c.stacked_J(2), X = c.stacked_inverse(2, 0.0), Y = c.stacked_Y(2);
    EXPECT_TRUE(near(X * J, Y * Y.transpose(), 1e-10)) << "seed " << seed;  // [T 3.3.91]
    EXPECT_EQ(moore_penrose(J, X), 3) << "seed " << seed;
    EXPECT_FALSE(near((J * X).transpose(), J * X, 1e-6)) << "seed " << seed;
  }
}

TEST(Claims, R12MultiplierRecursionEqualsTheClosedForm) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Case c(deficient(seed));
    const std::vector<Vector> x = c.x(0.1);
    for (int k = 1; k < c.size(); ++k) {
      const Vector own = c.J(k) * x[k] - c.y(k);  // mu_k = v_k + u_k  [T 3.4.108]
      const Vector closed =
          -c.stacked_inverse(k - 1, 0.0).transpose() * (c.J(k).transpose() * own);  // [T 3.4.109]
      Vector gradient = c.J(k).transpose() * own;
      for (int j = k - 1; j >= 0; --j) {  // [T 3.4.115]
        Vector mu(c.J(j).rows());
        c.decomposition.multipliers(j, gradient, mu);
        EXPECT_TRUE(near(mu, closed.segment(c.table.begin(j), mu.size()), 1e-9)) << "seed " << seed;
        gradient += c.J(j).transpose() * mu;
      }
    }
  }
}

}  // namespace
}  // namespace hurcules

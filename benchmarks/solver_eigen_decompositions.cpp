// Claim M18 with the classes that the thesis used (§4.3.4): the decompositions of one solve alone,
// 19 rows shared out over the levels, JacobiSVD for RHQP beside CompleteOrthogonalDecomposition
// with one triangular solve for HQP, and with the inverse of Q'Q + rho^2 I for DLS-HQP. Least of
// many rounds, the methods in turns.
#include <Eigen/Dense>
#include <array>
#include <cstdio>
#include <limits>

#include "measure.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using hurcules_benchmark::seconds_of;

constexpr int kUnknowns = 19, kRounds = 500;
constexpr double kRho2 = 0.01;

// rows of a level in the directions that it is left with, and what they ask for
struct Block {
  MatrixXd B;
  VectorXd y;
};

// as evenly as it goes; at eight levels as in the thesis
std::vector<int> rows_of(int levels) {
  if (levels == 8) return {3, 3, 3, 3, 2, 3, 2};
  std::vector<int> rows;
  for (int left = kUnknowns, tasks = levels - 1; tasks > 0; --tasks) {
    rows.push_back((left + tasks - 1) / tasks);
    left -= rows.back();
  }
  return rows;
}

VectorXd by_singular_values(const Block& block) {
  const Eigen::JacobiSVD<MatrixXd> svd(block.B, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const VectorXd sigma = svd.singularValues();
  const auto l = sigma.size();
  const VectorXd filtered = sigma.array() / (sigma.array().square() + kRho2);
  return svd.matrixV().leftCols(l) *
         filtered.cwiseProduct(svd.matrixU().leftCols(l).transpose() * block.y);
}

VectorXd by_orthogonal(const Block& block, bool damped) {
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> cod(block.B);
  const MatrixXd Z = cod.matrixZ(), U = cod.householderQ();
  const auto l = cod.rank();
  const MatrixXd Q = cod.matrixT().topLeftCorner(l, l).triangularView<Eigen::Upper>();
  VectorXd z = U.leftCols(l).transpose() * block.y;
  if (damped) {
    const MatrixXd normal = Q.transpose() * Q + kRho2 * MatrixXd::Identity(l, l);
    z = normal.inverse() * (Q.transpose() * z);
  } else {
    Q.triangularView<Eigen::Upper>().solveInPlace(z);
  }
  return cod.colsPermutation() * (Z.topRows(l).transpose() * z);
}

}  // namespace

int main() {
  double sum = 0.0;  // so that nothing is left out
  std::printf("levels  SVD [us]  HQP [us]  DLS-HQP [us]  SVD/HQP  SVD/DLS-HQP\n");
  for (int levels = 2; levels <= 8; ++levels) {
    std::vector<Block> blocks;
    int left = kUnknowns;
    for (const int m : rows_of(levels)) {
      blocks.push_back({MatrixXd::Random(m, left), VectorXd::Random(m)});
      left -= m;
    }
    std::array<double, 3> least;
    least.fill(std::numeric_limits<double>::infinity());
    const auto take = [&](std::size_t method, auto&& decompose) {
      const double seconds = seconds_of([&] {
        for (const Block& block : blocks) sum += decompose(block)[0];
      });
      least[method] = std::min(least[method], 1e6 * seconds);
    };
    for (int i = 0; i < kRounds; ++i) {
      take(0, by_singular_values);
      take(1, [](const Block& block) { return by_orthogonal(block, false); });
      take(2, [](const Block& block) { return by_orthogonal(block, true); });
    }
    std::printf("%6d %9.1f %9.1f %13.1f %8.2f %12.2f\n", levels, least[0], least[1], least[2],
                least[0] / least[1], least[0] / least[2]);
  }
  return sum == sum ? 0 : 1;
}

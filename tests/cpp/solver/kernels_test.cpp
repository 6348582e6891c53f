// Strategy: every kernel against the plain loop that defines it, for each instruction set that the
// machine has; then whole solves, which must agree between the sets to rounding. Not tested here:
// speed.
#include "hurcules/solver/kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "hurcules/solver/solver.hpp"
#include "support/random_hierarchy.hpp"

namespace hurcules {
namespace {

using kernels::Size;
using Numbers = std::vector<double>;

constexpr double kAbsent = std::numeric_limits<double>::infinity();

class Kernels : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    before_ = kernels::chosen->name;
    if (!kernels::choose(GetParam())) GTEST_SKIP() << "this machine has no " << GetParam();
    EXPECT_EQ(kernels::chosen->name, std::string(GetParam()));
  }
  void TearDown() override { kernels::choose(before_.c_str()); }

  Numbers numbers(Size count) {
    Numbers result(static_cast<std::size_t>(count));
    for (double& x : result) x = normal_(generator_);
    return result;
  }

 private:
  std::mt19937 generator_{1};
  std::normal_distribution<double> normal_;
  std::string before_;
};

double plain_dot(Size size, const double* a, const double* b) {
  double sum = 0.0;
  for (Size j = 0; j < size; ++j) sum += a[j] * b[j];
  return sum;
}

TEST_P(Kernels, DotsAndSumsAreThoseOfPlainLoops) {
  const kernels::Table& kernel = *kernels::chosen;
  for (const Size stride : {4, 8, 12, 20, 40}) {
    for (const Size count : {1, 2, 3, 4, 5, 7, 11}) {
      const Numbers rows = numbers((count + 3) * stride), x = numbers(stride), s = numbers(count);
      Numbers out(count + 4), norms(count + 4), y = x, wanted = x;
      kernel.dots(rows.data(), count, stride, x.data(), out.data());
      kernel.norms2(rows.data(), count, stride, norms.data());
      kernel.axpys(rows.data(), count, stride, s.data(), y.data());
      for (Size i = 0; i < count; ++i) {
        const double* row = rows.data() + i * stride;
        EXPECT_NEAR(out[i], plain_dot(stride, row, x.data()), 1e-13);
        EXPECT_NEAR(norms[i], plain_dot(stride, row, row), 1e-12);
        for (Size j = 0; j < stride; ++j) wanted[j] += s[i] * row[j];
      }
      for (Size j = 0; j < stride; ++j) EXPECT_NEAR(y[j], wanted[j], 1e-13);
    }
  }
}

TEST_P(Kernels, EliminationLeavesRowsWithoutAPartAlongThePivot) {
  const Size stride = 20, count = 6;
  const Numbers pivot = numbers(stride);
  Numbers rows = numbers((count + 3) * stride), coordinates((count + 3) * stride);
  const double scale = 1.0 / std::sqrt(plain_dot(stride, pivot.data(), pivot.data()));
  const Numbers before = rows;
  kernels::chosen->eliminate(pivot.data(), scale, rows.data(), count, stride, coordinates.data());
  for (Size i = 0; i < count; ++i) {
    EXPECT_NEAR(plain_dot(stride, pivot.data(), rows.data() + i * stride), 0.0, 1e-13);
    EXPECT_NEAR(coordinates[i * stride],
                scale * plain_dot(stride, pivot.data(), before.data() + i * stride), 1e-13);
  }
}

TEST_P(Kernels, TransposeSwapsRowsAndColumns) {
  const Size stride = 12;
  const Numbers rows = numbers(stride * stride);
  Numbers out(stride * stride);
  kernels::chosen->transpose(rows.data(), stride, stride, out.data());
  for (Size i = 0; i < stride; ++i) {
    for (Size j = 0; j < stride; ++j) EXPECT_EQ(out[j * stride + i], rows[i * stride + j]);
  }
}

TEST_P(Kernels, TheLargestNumberIsFoundAndNaNIsNotHidden) {
  Numbers x = {1.0, -7.0, 3.0, 0.0, 2.0, 5.0, -1.0, 4.0};
  EXPECT_EQ(kernels::chosen->largest(8, x.data()), 7.0);
  for (const double bad : {std::nan(""), kAbsent, -kAbsent}) {
    x[6] = bad;
    EXPECT_FALSE(std::isfinite(kernels::chosen->largest(8, x.data())));
  }
}

TEST_P(Kernels, TheFirstLimitOnTheWayBlocksAndTiesGoToTheFastest) {
  const Numbers value(8, 0.0), norm(8, 1.0);
  Numbers target(8, 0.0), lower(8, -kAbsent), upper(8, kAbsent);
  target[2] = 4.0;
  upper[2] = 1.0;  // at a quarter of the way
  target[5] = -2.0;
  lower[5] = -1.0;  // at half of it
  const kernels::LimitArrays limits = {lower.data(), upper.data(), norm.data()};
  const auto first = [&] {
    return kernels::chosen->first_blocking(8, value.data(), target.data(), limits, 1e-12, 0.0);
  };
  EXPECT_EQ(first().candidate, 2);
  EXPECT_DOUBLE_EQ(first().way, 0.25);
  target[7] = 8.0;
  upper[7] = 2.0;  // at a quarter, too, and twice as fast
  EXPECT_EQ(first().candidate, 7);
  upper[2] = upper[7] = kAbsent;
  lower[5] = -2.0;  // reached, not broken
  EXPECT_EQ(first().candidate, -1);
  EXPECT_LE(kernels::chosen->worst_excess(8, target.data(), limits, 1e-12, 0.0), 0.0);
}

TEST_P(Kernels, WholeSolvesAgreeWithTheBaselineToRounding) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Hierarchy levels = hurcules_test::RandomHierarchy(seed).conflicting(12, 0.1);
    kernels::choose(GetParam());
    const Vector wide = Solver(12).solve(levels).x;
    kernels::choose("baseline");
    const Vector narrow = Solver(12).solve(levels).x;
    EXPECT_LT((wide - narrow).lpNorm<Eigen::Infinity>(), 1e-9) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, Kernels, testing::Values("baseline", "avx2"),
                         [](const auto& set) { return std::string(set.param); });

TEST(KernelChoice, AnUnknownSetIsRefused) {
  const std::string before = kernels::chosen->name;
  EXPECT_FALSE(kernels::choose("abacus"));
  EXPECT_EQ(kernels::chosen->name, before);
}

}  // namespace
}  // namespace hurcules

// Strategy: every kernel against the plain loop that defines it, for each instruction set that the
// machine has; then whole solves, which must agree between the sets to rounding. Not tested here:
// speed.
#include "hurcules/solver/kernels/kernels.hpp"

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

TEST_P(Kernels, MovesAndDifferencesAreThoseOfPlainLoops) {
  const kernels::Table& kernel = *kernels::chosen;
  for (const Size size : {4, 8, 12, 20, 40}) {
    const Numbers a = numbers(size), b = numbers(size);
    Numbers scaled(size), moved = b, difference(size);
    kernel.scale(size, -1.5, a.data(), scaled.data());
    kernel.advance(size, 0.25, a.data(), moved.data());
    const double norm2 = kernel.scaled_difference(size, 2.0, a.data(), b.data(), difference.data());
    for (Size j = 0; j < size; ++j) {
      EXPECT_EQ(scaled[j], -1.5 * a[j]);
      EXPECT_NEAR(moved[j], b[j] + 0.25 * (a[j] - b[j]), 1e-15);
      EXPECT_NEAR(difference[j], 2.0 * (a[j] - b[j]), 1e-15);
    }
    EXPECT_NEAR(norm2, plain_dot(size, difference.data(), difference.data()), 1e-12);
  }
}

TEST_P(Kernels, SumsOverRowsAreThoseOfPlainLoops) {
  const kernels::Table& kernel = *kernels::chosen;
  const Size stride = 12;
  for (const Size count : {1, 2, 3, 4, 5, 7, 11}) {
    const Numbers rows = numbers((count + 3) * stride), x = numbers(stride);
    Numbers norm(count, 2.0), rest(stride, 0.0);
    norm[0] = 0.0;  // no row: left out
    double squares = 0.0, way = 0.0;
    for (Size i = 0; i < count; ++i) {
      const double part = plain_dot(stride, rows.data() + i * stride, x.data());
      squares += part * part;
      if (i > 0) way = std::max(way, std::abs(part) / norm[i]);
    }
    EXPECT_NEAR(kernel.norm2_along(rows.data(), count, stride, x.data()), squares, 1e-12);
    const double largest = kernel.largest_way(rows.data(), count, stride, x.data(), norm.data());
    EXPECT_TRUE(std::isinf(largest)) << "what moves without a norm has moved too far";
    norm[0] = 1e300;
    EXPECT_NEAR(kernel.largest_way(rows.data(), count, stride, x.data(), norm.data()), way, 1e-13);
    kernel.take_squares(rows.data(), count, stride, rest.data());
    for (Size j = 0; j < stride; ++j) {
      double wanted = 0.0;
      for (Size i = 0; i < count; ++i) wanted -= rows[i * stride + j] * rows[i * stride + j];
      EXPECT_NEAR(rest[j], wanted, 1e-13);
    }
  }
}

TEST_P(Kernels, RowsAreCopiedAndWhatIsBehindThemStays) {
  for (const Size length : {1, 2, 3, 4, 5, 7, 8, 19}) {
    const Size stride = (length + 3) / 4 * 4, count = 3;
    const Numbers from = numbers(count * length);
    Numbers to(count * stride, 7.0);
    kernels::chosen->copy_rows(from.data(), count, length, to.data(), stride);
    for (Size i = 0; i < count; ++i) {
      for (Size j = 0; j < stride; ++j) {
        EXPECT_EQ(to[i * stride + j], j < length ? from[i * length + j] : 7.0);
      }
    }
  }
}

TEST_P(Kernels, ProjectionLeavesNoPartAlongOrthonormalRows) {
  const Size stride = 8;
  for (const Size count : {1, 2, 3, 4, 5, 6}) {
    // unit vectors; what stands behind the last row must not count
    Numbers rows((count + 3) * stride, std::nan("")), v = numbers(stride);
    std::fill_n(rows.begin(), count * stride, 0.0);
    for (Size i = 0; i < count; ++i) rows[i * stride + i] = 1.0;
    const Numbers before = v;
    Numbers part(8, 0.5);
    const double left = kernels::chosen->project(rows.data(), count, stride, v.data(), part.data());
    EXPECT_NEAR(left, plain_dot(stride, v.data(), v.data()), 1e-14);
    for (Size j = 0; j < stride; ++j) EXPECT_NEAR(v[j], j < count ? 0.0 : before[j], 1e-15);
    for (Size i = 0; i < count; ++i) EXPECT_NEAR(part[i], 0.5 + before[i], 1e-15);
  }
}

TEST_P(Kernels, ProjectionOfSplitNumbersIsThatInLongDouble) {
  using Long = long double;
  const Size stride = 16;
  const auto put = [](Long x, Numbers& high, Numbers& low, Size at) {
    high[at] = kernels::on_grid(static_cast<double>(x));
    low[at] = static_cast<double>(x - high[at]);
  };
  for (const Size count : {1, 2, 3, 4, 5, 8}) {
    // row i lies in the plane of coordinates 2 i and 2 i + 1
    Numbers rows_high(count * stride), rows_low(count * stride), v_high(stride), v_low(stride);
    Numbers part_high(8), part_low(8);
    const Numbers x = numbers(2 * stride);
    std::vector<Long> v(stride);
    for (Size j = 0; j < stride; ++j) v[j] = 0.02L * x[j] + 1e-14L * x[stride + j];
    for (Size j = 0; j < stride; ++j) put(v[j], v_high, v_low, j);
    std::vector<Long> parts(count);
    for (Size i = 0; i < count; ++i) {
      const Long c = std::cos(Long(i + 1)), s = std::sin(Long(i + 1));
      put(c, rows_high, rows_low, i * stride + 2 * i);
      put(s, rows_high, rows_low, i * stride + 2 * i + 1);
      parts[i] = c * v[2 * i] + s * v[2 * i + 1];
      v[2 * i] -= parts[i] * c;
      v[2 * i + 1] -= parts[i] * s;
    }
    kernels::chosen->project_split(rows_high.data(), rows_low.data(), count, stride,
                                   {v_high.data(), v_low.data()},
                                   {part_high.data(), part_low.data()});
    for (Size i = 0; i < count; ++i) {
      EXPECT_NEAR(static_cast<double>(part_high[i] + Long(part_low[i]) - parts[i]), 0.0, 1e-19);
    }
    for (Size j = 0; j < stride; ++j) {
      EXPECT_NEAR(static_cast<double>(v_high[j] + Long(v_low[j]) - v[j]), 0.0, 1e-19);
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

TEST_P(Kernels, SweepsEndWithOrthogonalRowsThatTheRotationsBesideThemMake) {
  const kernels::Table& kernel = *kernels::chosen;
  constexpr Size kSize = 12, kStride = 20, kSweeps = 12;
  for (const Size count : {1, 2, 3, 7, 8}) {
    Numbers rows = numbers((count + 3) * kStride), squares(count);
    for (Size i = 0; i < count; ++i) {  // the identity beside each row
      for (Size j = kSize; j < kStride; ++j) rows[i * kStride + j] = j - kSize == i ? 1.0 : 0.0;
    }
    const Numbers before = rows;
    int sweeps = 0;
    while (kernel.sweep(rows.data(), count, kSize, kStride, 1e-15, squares.data())) {
      ASSERT_LT(++sweeps, kSweeps);
    }
    for (Size i = 0; i < count; ++i) {
      const double* row = rows.data() + i * kStride;
      EXPECT_NEAR(squares[i], plain_dot(kSize, row, row), 1e-13);
      for (Size j = 0; j < i; ++j) {
        EXPECT_NEAR(plain_dot(kSize, row, rows.data() + j * kStride), 0.0, 1e-13);
      }
      Numbers made(kSize);
      for (Size j = 0; j < count; ++j) {
        for (Size l = 0; l < kSize; ++l) made[l] += row[kSize + j] * before[j * kStride + l];
      }
      for (Size l = 0; l < kSize; ++l) EXPECT_NEAR(made[l], row[l], 1e-13);
    }
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

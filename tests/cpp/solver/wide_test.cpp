// Strategy: identities of exact arithmetic, on seeded numbers of many sizes, hold to the rounding
// of two long double; what is infinite or no number stays so. The solver's use of it is tested by
// its answers (solver_proof_test.cpp).
#include "hurcules/solver/wide.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/draw.hpp"

namespace hurcules {
namespace {

using namespace hurcules_test;
using Long = long double;

constexpr Long kUnit = std::numeric_limits<Long>::epsilon() * std::numeric_limits<Long>::epsilon();

// a number with digits in both parts
Wide draw_wide(Draw& draw) {
  const Long high = static_cast<Long>(draw.uniform(-1.0, 1.0)) * draw.power(-9.0, 9.0);
  return Wide(high) + high * static_cast<Long>(draw.uniform(-1.0, 1.0)) * 1e-20L;
}

void expect_same(const Wide& a, const Wide& b, const Wide& size) {
  EXPECT_LE(static_cast<double>(abs(a - b) / abs(size)), static_cast<double>(16.0L * kUnit));
}

TEST(Wide, KeepsWhatLongDoubleLoses) {
  const Wide small = 1e-30L;
  EXPECT_EQ((Wide(1.0L) + small) - 1.0L, small);
  EXPECT_EQ(1.0L + 1e-30L - 1.0L, 0.0L);  // so the line above is no matter of course
  // (1 + e)(1 - e) = 1 - e^2
  const Wide e = std::ldexp(1.0L, -50);
  EXPECT_EQ((1.0L + e) * (1.0L - e) - 1.0L, -e * e);
  EXPECT_LT(Wide(1.0L), Wide(1.0L) + small);
  EXPECT_GT(Wide(1.0L), Wide(1.0L) - small);
}

TEST(Wide, KeepsTheIdentitiesOfExactArithmetic) {
  Draw draw(1);
  for (int i = 0; i < 2000; ++i) {
    const Wide a = draw_wide(draw), b = draw_wide(draw), c = draw_wide(draw);
    expect_same((a + b) - b, a, abs(a) + abs(b));
    expect_same(a * b, b * a, a * b);
    expect_same(a * (b + c), a * b + a * c, abs(a * b) + abs(a * c));
    expect_same(a / b * b, a, a);
    expect_same(sqrt(a * a), abs(a), a);
    expect_same(sqrt(abs(a)) * sqrt(abs(a)), abs(a), a);
  }
}

TEST(Wide, RoundsToTheNearestDouble) {
  EXPECT_EQ(static_cast<double>(Wide(1.0L) / 3.0L), 1.0 / 3.0);
  EXPECT_EQ(static_cast<double>(sqrt(Wide(2.0L))), std::sqrt(2.0));
  EXPECT_EQ(static_cast<double>(Wide(0.1) * 10.0 - 1.0), std::fma(0.1, 10.0, -1.0));
}

TEST(Wide, InfiniteAndNoNumberStayWhatTheyAre) {
  const Long inf = std::numeric_limits<Long>::infinity();
  EXPECT_TRUE(isinf(Wide(inf) - 3.0L));
  EXPECT_TRUE(isinf(Wide(-inf) / 7.0L));
  EXPECT_TRUE(isinf(Wide(2.0L) * Wide(inf)));
  EXPECT_LT(Wide(5.0L), Wide(inf));
  EXPECT_GT(Wide(5.0L), Wide(-inf));
  EXPECT_TRUE(std::isnan(static_cast<double>(Wide(inf) - Wide(inf))));
  EXPECT_TRUE(std::isnan(static_cast<double>(sqrt(Wide(-1.0L)))));
  EXPECT_EQ(sqrt(Wide(0.0L)), Wide(0.0L));
}

}  // namespace
}  // namespace hurcules

// Strategy: moments of many draws within four standard errors of what theory says; bits after a
// restore. Not tested: the tails, which end at six by construction.
#include "hurcules/base/random.hpp"

#include <cmath>
#include <vector>

#include "support/expect.hpp"

namespace {

using namespace hurcules;

TEST(Random, NormalHasTheMomentsOfTwelveUniformNumbers) {
  Random random(7);
  constexpr int kDraws = 200000;
  double sum = 0.0, square = 0.0, fourth = 0.0, most = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    sum += x;
    square += x * x;
    fourth += x * x * x * x;
    most = std::max(most, std::abs(x));
  }
  const double error = 1.0 / std::sqrt(kDraws);
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 * error);
  EXPECT_NEAR(square / kDraws, 1.0, 4.0 * std::sqrt(2.0) * error);
  EXPECT_NEAR(fourth / kDraws, 2.9, 4.0 * std::sqrt(96.0) * error);  // 3 - 1.2 / 12
  EXPECT_LT(most, 6.0);
}

TEST(Random, GoesOnWithTheSameBitsAfterARestore) {
  Random random(3);
  random.normal();
  std::vector<double> state;
  StateWriter writer(state);
  random.save(writer);
  const double next = random.normal();
  Random other(99);
  StateReader reader(state);
  other.restore(reader);
  EXPECT_EQ(other.normal(), next);
  EXPECT_TRUE(reader.at_end());
}

}  // namespace

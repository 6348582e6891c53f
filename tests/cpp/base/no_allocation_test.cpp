// What NoAllocation counts: each way to memory that the core and its libraries take.
#include "support/no_allocation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <functional>
#include <new>
#include <vector>

namespace {

using hurcules_test::NoAllocation;

TEST(NoAllocation, CountsEachWayToMemory) {
  struct alignas(64) Wide {
    double number[8];
  };
  void* volatile memory = nullptr;  // or the compiler leaves out what nobody uses
  Wide* volatile wide = nullptr;
  const std::vector<std::function<void()>> ways{
      [&] { memory = std::malloc(8), std::free(memory); },
      [&] { memory = std::calloc(1, 8), std::free(memory); },
      [&] { memory = std::aligned_alloc(64, 64), std::free(memory); },
      [&] { memory = ::operator new(8), ::operator delete(memory); },
      [&] { wide = new Wide(), delete wide; },
      [&] { memory = Eigen::VectorXd(3).data(); },
  };
  for (std::size_t way = 0; way < ways.size(); ++way) {
    const NoAllocation none;
    ways[way]();
    EXPECT_EQ(none.count(), 1u) << way;
  }
}

TEST(NoAllocation, CountsNothingOnTheStack) {
  const NoAllocation none;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix = (matrix * matrix).eval();
  EXPECT_EQ(none.count(), 0u);
  EXPECT_EQ(matrix.trace(), 3.0);
}

}  // namespace

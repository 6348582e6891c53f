// Strategy: each kind of wrong input, and that the text names level and row.
#include "hurcules/solver/hierarchy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hurcules/base/error.hpp"

namespace hurcules {
namespace {

Level good() {
  return {.A = Matrix::Ones(2, 3), .lower = Vector::Zero(2), .upper = Vector::Ones(2), .rho = 0.1};
}

std::string complaint(const Level& bad) {
  try {
    check({good(), bad}, 3);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Hierarchy, AcceptsWhatIsRight) {
  EXPECT_NO_THROW(check({good(), make_bounds(-Vector::Ones(3), Vector::Ones(3))}, 3));
}

TEST(Hierarchy, NamesLevelAndRowOfAWrongNumber) {
  Level level = good();
  level.lower[1] = 2.0;
  EXPECT_NE(complaint(level).find("level 1, row 1: lower must not exceed upper"),
            std::string::npos);
  level = good();
  level.upper[0] = std::nan("");
  EXPECT_NE(complaint(level).find("level 1, row 0: a bound is NaN"), std::string::npos);
  level = good();
  level.A(1, 2) = INFINITY;
  EXPECT_NE(complaint(level).find("level 1, row 1: A must be finite"), std::string::npos);
  level = good();
  level.lower[0] = level.upper[0] = INFINITY;
  EXPECT_NE(complaint(level).find("no x can meet"), std::string::npos);
}

TEST(Hierarchy, NamesWantedAndGivenShapes) {
  Level level = good();
  level.A = Matrix::Ones(2, 4);
  EXPECT_NE(complaint(level).find("A must be (2, 3)"), std::string::npos);
  EXPECT_NE(complaint(level).find("got (2, 4)"), std::string::npos);
  EXPECT_NE(complaint(make_bounds(Vector::Zero(2), Vector::Ones(2))).find("length 3"),
            std::string::npos);
}

TEST(Hierarchy, RefusesANegativeOrInfiniteRegularisation) {
  Level level = good();
  level.rho = -0.1;
  EXPECT_NE(complaint(level).find("rho must be finite and >= 0"), std::string::npos);
  level.rho = INFINITY;
  EXPECT_NE(complaint(level), "");
}

}  // namespace
}  // namespace hurcules

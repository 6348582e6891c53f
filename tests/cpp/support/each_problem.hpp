// One test a class of hierarchies: runs a check on seeded problems of it, and stops at the first
// that fails with what is needed to make it again.
//
// HURCULES_PROBLEMS sets the number of seeds a class and regularisation: a bulk run is the same
// test with a larger count.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "support/hierarchy_classes.hpp"

namespace hurcules_test {

inline constexpr double kProven =
    1e-9;  // "Must show" of the solver: residual relative to its forces

class EachClass : public testing::TestWithParam<HierarchyClass> {
 protected:
  // check(levels, draw): `draw` is for what the check itself chooses
  template <typename Check>
  void each_problem(int seeds, std::initializer_list<double> regularisations, Check&& check) {
    const HierarchyClass& kind = GetParam();
    if (const char* wanted = std::getenv("HURCULES_PROBLEMS")) seeds = std::atoi(wanted);
    for (const double rho : regularisations) {
      for (int seed = 0; seed < std::max(1, seeds / kind.rarity); ++seed) {
        Draw draw(seed);
        const Hierarchy levels = kind.make(draw, rho);
        SCOPED_TRACE("solver_proof --once --class " + std::string(kind.name) + " --rho " +
                     number_of(rho) + " --seed " + std::to_string(seed));
        check(levels, draw);
        if (HasFailure()) return;
      }
    }
  }
  [[nodiscard]] bool is(std::initializer_list<std::string> names) const {
    return std::find(names.begin(), names.end(), GetParam().name) != names.end();
  }

 private:
  static std::string number_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
  }
};

inline std::string class_name(const testing::TestParamInfo<HierarchyClass>& info) {
  return info.param.name;
}

// instantiates a fixture derived from EachClass for every class
#define HURCULES_FOR_EACH_CLASS(fixture)                                        \
  INSTANTIATE_TEST_SUITE_P(Hierarchies, fixture,                                \
                           testing::ValuesIn(hurcules_test::kHierarchyClasses), \
                           hurcules_test::class_name)

}  // namespace hurcules_test

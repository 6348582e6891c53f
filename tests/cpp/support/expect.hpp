// Comparison of vectors and matrices, and what an Error says.
//
// HURCULES_TOLERANCE=0.01 makes every tolerance a hundred times smaller: the failures then show the
// true residuals.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/base/types.hpp"

namespace hurcules_test {

inline double tolerance(double value) {
  const char* scale = std::getenv("HURCULES_TOLERANCE");
  return scale ? value * std::atof(scale) : value;
}

// every entry within `allowed`, and of the same shape
inline testing::AssertionResult near(const hurcules::Matrix& actual, const hurcules::Matrix& wanted,
                                     double allowed) {
  if (actual.rows() != wanted.rows() || actual.cols() != wanted.cols())
    return testing::AssertionFailure() << "shapes differ";
  const double worst = actual.size() ? (actual - wanted).cwiseAbs().maxCoeff() : 0.0;
  if (worst <= tolerance(allowed)) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "worst difference " << worst << " > " << tolerance(allowed) << "\nactual\n"
         << actual << "\nwanted\n"
         << wanted;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// what the Error of `action` says, "" when there was none
template <typename Action>
std::string error_text(Action&& action) {
  try {
    action();
  } catch (const hurcules::Error& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace hurcules_test

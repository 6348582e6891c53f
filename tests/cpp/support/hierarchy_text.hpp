// A hierarchy as C++ that can be pasted into a test, every number to the last bit.
#pragma once

#include <cstdio>
#include <string>

#include "hurcules/solver/hierarchy.hpp"

namespace hurcules_test {

inline std::string number_text(double value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

inline std::string vector_text(const hurcules::ConstVectorRef& v) {
  std::string text;
  for (const double value : v) text += (text.empty() ? "" : ", ") + number_text(value);
  return "vector({" + text + "})";
}

inline std::string as_text(const hurcules::Hierarchy& levels) {
  std::string text;
  for (const hurcules::Level& level : levels) {
    const std::string sides = vector_text(level.lower) + ",\n    " + vector_text(level.upper);
    if (level.bounds) {
      text += "levels.push_back(make_bounds(" + sides + "));\n";
      continue;
    }
    std::string A;
    for (hurcules::Index i = 0; i < level.rows(); ++i) {
      std::string row;
      for (const double a : level.A.row(i)) row += (row.empty() ? "" : ", ") + number_text(a);
      A += (i ? ",\n    {" : "{") + row + "}";
    }
    text += "levels.push_back(rows(Matrix{" + A + "},\n    " + sides + ", " +
            number_text(level.rho) + "));\n";
  }
  return text;
}

}  // namespace hurcules_test

#include "hurcules/solver/hierarchy.hpp"

#include <cmath>
#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"

namespace hurcules {

namespace {

std::string place(const std::string& level, Index row) {
  return level + ", row " + std::to_string(row);
}

void check_shape(const LevelView& level, const std::string& where, Index unknowns) {
  require(level.lower.size() == level.upper.size(),
          where + ": lower and upper must have one length, got " +
              std::to_string(level.lower.size()) + " and " + std::to_string(level.upper.size()));
  if (level.bounds) {
    require(level.rows() == unknowns, where + ": bounds must have length " +
                                          std::to_string(unknowns) + " (the unknowns), got " +
                                          std::to_string(level.rows()));
    require(level.rho == 0.0,
            where + ": bounds are never regularised, got rho = " + number_text(level.rho));
    return;
  }
  require(level.A.rows() == level.rows() && (level.rows() == 0 || level.A.cols() == unknowns),
          where + ": A must be (" + std::to_string(level.rows()) + ", " + std::to_string(unknowns) +
              ") to match its bounds and the unknowns, got (" + std::to_string(level.A.rows()) +
              ", " + std::to_string(level.A.cols()) + ")");
}

// what check_row asks, without a text
bool is_sound(const LevelView& level, Index i) {
  return level.lower[i] <= level.upper[i] && level.lower[i] < kInfinity &&
         level.upper[i] > -kInfinity &&
         (level.bounds || level.A.row(i).squaredNorm() <= kLongestRow * kLongestRow);
}

void check_row(const LevelView& level, const std::string& where, Index i) {
  require(!std::isnan(level.lower[i]) && !std::isnan(level.upper[i]),
          place(where, i) + ": a bound is NaN");
  require(level.lower[i] <= level.upper[i],
          place(where, i) + ": lower must not exceed upper, got " + number_text(level.lower[i]) +
              " > " + number_text(level.upper[i]));
  require(level.lower[i] < kInfinity && level.upper[i] > -kInfinity,
          place(where, i) + ": no x can meet a lower bound of +inf or an upper bound of -inf");
  if (level.bounds) return;
  require(level.A.row(i).allFinite(), place(where, i) + ": A must be finite");
  require(level.A.row(i).squaredNorm() <= kLongestRow * kLongestRow,
          place(where, i) + ": a row of A must not be longer than 1e100");
}

void check_numbers(const LevelView& level, const std::string& where) {
  require(std::isfinite(level.rho) && level.rho >= 0.0,
          where + ": rho must be finite and >= 0, got " + number_text(level.rho));
  for (Index i = 0; i < level.rows(); ++i) {
    if (!is_sound(level, i)) check_row(level, where, i);
  }
}

}  // namespace

Level make_bounds(const ConstVectorRef& lower, const ConstVectorRef& upper) {
  return {.A = Matrix(), .lower = lower, .upper = upper, .rho = 0.0, .bounds = true};
}

LevelView view(const Level& level) {
  return {.A = {level.A.data(), level.A.rows(), level.A.cols()},
          .lower = {level.lower.data(), level.lower.size()},
          .upper = {level.upper.data(), level.upper.size()},
          .rho = level.rho,
          .bounds = level.bounds};
}

void check(HierarchyView hierarchy, Index unknowns) {
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    check(hierarchy[k], unknowns, "level " + std::to_string(k));
  }
}

void check(const Hierarchy& hierarchy, Index unknowns) {
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    check(hierarchy[k], unknowns, "level " + std::to_string(k));
  }
}

void check(const LevelView& level, Index unknowns, const std::string& name) {
  check_shape(level, name, unknowns);
  check_numbers(level, name);
}

void check(const Level& level, Index unknowns, const std::string& name) {
  check(view(level), unknowns, name);
}

}  // namespace hurcules

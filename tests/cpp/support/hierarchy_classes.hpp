// Seeded hierarchies by class of difficulty (docs/solver-proof.md).
//
// `rho` regularises the levels of tasks; levels of limits have rho or none. Sizes are small
// (n = 2 .. 20), so that a million problems are minutes; the class `large` goes to 60.
#pragma once

#include <array>
#include <cmath>
#include <ostream>
#include <utility>

#include "support/crowded_limits.hpp"
#include "support/draw.hpp"
#include "support/robot_like.hpp"

namespace hurcules_test {

inline Index unknowns_of(const Hierarchy& levels) {
  return levels[0].bounds ? levels[0].rows() : levels[0].A.cols();
}

inline Index draw_unknowns(Draw& draw) {
  return draw.integer(2, 20);
}

// a level of limits may do without regularisation, as solver.md §1 wants it
inline double limits_rho(Draw& draw, double rho) {
  return draw.chance(0.5) ? 0.0 : rho;
}

// equality levels of unit rows that ask for more or less than one point can give
inline void add_tasks(Draw& draw, Hierarchy& levels, Index n, double rho, double reach) {
  for (Index k = draw.integer(1, 6); k > 0; --k) {
    const Index m = draw.integer(1, 3);
    levels.push_back(equality(draw.unit_rows(m, n), reach * draw.vector(m), rho));
  }
}

// every level can be met at one point, inside the box
inline Hierarchy no_conflict(Draw& draw, double rho) {
  const Index n = draw_unknowns(draw);
  const Vector x = draw.uniform_vector(n, -0.3, 0.3);
  Hierarchy levels = {box(n, 5.0)};
  for (Index k = draw.integer(1, 6); k > 0; --k) {
    const Matrix A = draw.unit_rows(draw.integer(1, 3), n);
    levels.push_back(equality(A, A * x, rho));
  }
  return levels;
}

inline Hierarchy box_conflict(Draw& draw, double rho) {
  const Index n = draw_unknowns(draw);
  Hierarchy levels = {box(n, draw.choose({0.05, 0.3, 1.0}))};
  add_tasks(draw, levels, n, rho, 1.0);
  return levels;
}

// more rows than unknowns, above a box that binds
inline Hierarchy level_conflict(Draw& draw, double rho) {
  const Index n = draw.integer(2, 8);
  Hierarchy levels = {box(n, 0.5)};
  for (Index k = draw.integer(2, 6); k > 0; --k) {
    const Index m = draw.integer(1, n);
    levels.push_back(equality(draw.unit_rows(m, n), 2.0 * draw.vector(m), rho));
  }
  return levels;
}

// equalities, intervals and one-sided rows in one level
inline Level mixed_level(Draw& draw, Index n, double rho) {
  const Index m = draw.integer(1, 4);
  Level level = interval(draw.choose({0.1, 1.0, 10.0}) * draw.unit_rows(m, n),
                         draw.uniform_vector(m, -2.0, 1.0), Vector::Zero(m), rho);
  for (Index i = 0; i < m; ++i) {
    level.upper[i] = level.lower[i] + draw.choose({0.0, 0.5, 2.0});
    if (level.lower[i] == level.upper[i]) continue;
    const Index kind = draw.integer(0, 3);
    if (kind == 1) level.lower[i] = -kNoLimit;
    if (kind == 2) level.upper[i] = kNoLimit;
  }
  return level;
}

inline Hierarchy mixed(Draw& draw, double rho) {
  const Index n = draw_unknowns(draw);
  Hierarchy levels;
  for (Index k = draw.integer(1, 6); k > 0; --k) {
    levels.push_back(mixed_level(draw, n, draw.chance(0.8) ? rho : 0.0));
  }
  if (draw.chance(0.7)) levels.insert(levels.begin() + draw.integer(0, 1), box(n, 1.0));
  return levels;
}

// the last row of a level is 1e-1 .. 1e-12 away from the span of the rows before it
inline Hierarchy near_singular(Draw& draw, double rho) {
  const Index n = draw_unknowns(draw);
  Hierarchy levels;
  add_tasks(draw, levels, n, rho, 1.0);
  Matrix seen(0, n);
  for (Level& level : levels) {
    const Index m = level.rows();
    if (seen.rows() > 0) {
      Vector near = seen.transpose() * draw.vector(seen.rows());
      near.normalize();
      level.A.row(m - 1) = near.transpose() + draw.power(-12.0, -1.0) * draw.unit_rows(1, n);
    }
    seen.conservativeResize(seen.rows() + m, n);
    seen.bottomRows(m) = level.A;
  }
  if (draw.chance(0.7)) levels.insert(levels.begin(), box(n, draw.choose({0.3, 3.0})));
  return levels;
}

// zero, duplicate, opposite and exactly dependent rows inside and between levels, empty levels
inline Hierarchy degenerate(Draw& draw, double rho) {
  Hierarchy levels = mixed(draw, rho);
  const Index n = unknowns_of(levels);
  for (Level& level : levels) {
    if (level.bounds) continue;
    const Index i = draw.integer(0, level.rows() - 1), what = draw.integer(0, 4);
    const Level& other = levels[draw.integer(0, static_cast<Index>(levels.size()) - 1)];
    if (what == 0) level.A.row(i).setZero();
    if (what == 1) append_row(level, level.A.row(i), level.lower[i], level.upper[i]);
    if (what == 2 && !other.bounds) level.A.row(i) = -other.A.row(0);
    if (what == 3) append_row(level, -2.0 * level.A.row(i), -1.0, draw.choose({-1.0, 0.5}));
    if (what == 4) append_row(level, level.A.colwise().sum(), 1.0, draw.choose({1.0, kNoLimit}));
  }
  levels.insert(levels.begin() + draw.integer(0, 1),
                interval(Matrix(0, n), Vector(0), Vector(0), rho));
  return levels;
}

// ties, exact vertices and exact dependence everywhere
inline Hierarchy whole_numbers(Draw& draw, double rho) {
  const Index n = draw.integer(1, 3);
  Hierarchy levels;
  for (Index k = draw.integer(1, 4); k > 0; --k) {
    const Index m = draw.integer(1, 3);
    Level level = interval(draw.whole(m, n, 2), Vector(m), Vector(m), draw.chance(0.7) ? rho : 0.0);
    for (Index i = 0; i < m; ++i) {
      level.lower[i] = 0.5 * static_cast<double>(draw.integer(-4, 4));
      level.upper[i] = level.lower[i] + static_cast<double>(draw.integer(0, 2));
    }
    levels.push_back(level);
  }
  return levels;
}

// one direction asked for several values with different weights: {2x = 4; x = 8} gives 3.2
inline Hierarchy weights(Draw& draw, double rho) {
  const Index n = draw.integer(1, 6);
  Hierarchy levels;
  if (draw.chance(0.5)) levels.push_back(box(n, 2.0));
  for (Index k = draw.integer(1, 3); k > 0; --k) {
    const Matrix a = draw.whole(1, n, 2);
    Level level = interval(Matrix(0, n), Vector(0), Vector(0), rho);
    for (Index i = draw.integer(2, 4); i > 0; --i) {
      const double weight = draw.choose({-1.0, 0.5, 1.0, 2.0, 1e-3, 1e3});
      const double target = weight * static_cast<double>(draw.integer(-8, 8));
      append_row(level, weight * a, target, target + draw.choose({0.0, 0.0, 1.0}));
    }
    levels.push_back(level);
  }
  return levels;
}

// rows and levels of sizes 1e-3 .. 1e3, answers of size 1e-3 .. 1e3
inline Hierarchy scales(Draw& draw, double rho) {
  Hierarchy levels = mixed(draw, rho);
  const double size = draw.power(-3.0, 3.0);
  for (Level& level : levels) {
    level.lower *= size;
    level.upper *= size;
    if (level.bounds) continue;
    const double whole_level = draw.power(-1.5, 1.5);
    for (Index i = 0; i < level.rows(); ++i) {
      const double row = whole_level * draw.power(-1.5, 1.5);
      level.A.row(i) *= row;
      level.lower[i] *= row;
      level.upper[i] *= row;
    }
  }
  return levels;
}

// a few problems of n up to 60
inline Hierarchy large(Draw& draw, double rho) {
  const Index n = draw.integer(30, 60);
  Hierarchy levels = {box(n, 0.5)};
  for (Index k = draw.integer(4, 10); k > 0; --k) {
    const Index m = draw.integer(2, 8);
    levels.push_back(equality(draw.unit_rows(m, n), 2.0 * draw.vector(m), rho));
    levels.push_back(mixed_level(draw, n, rho));
  }
  return levels;
}

struct HierarchyClass {
  const char* name;
  Hierarchy (*make)(Draw& draw, double rho);
  int rarity = 1;  // a bulk run makes one of so many of it
};
inline std::ostream& operator<<(std::ostream& out, const HierarchyClass& kind) {
  return out << kind.name;
}

inline constexpr std::array kHierarchyClasses = {
    HierarchyClass{"no_conflict", no_conflict},
    HierarchyClass{"box_conflict", box_conflict},
    HierarchyClass{"level_conflict", level_conflict},
    HierarchyClass{"mixed", mixed},
    HierarchyClass{"near_singular", near_singular},
    HierarchyClass{"degenerate", degenerate},
    HierarchyClass{"robot_like", robot_like},
    HierarchyClass{"crowded_vertex", crowded_vertex},
    HierarchyClass{"facing_limits", facing_limits},
    HierarchyClass{"thin_cones", thin_cones},
    HierarchyClass{"repeats", repeats},
    HierarchyClass{"several_bounds", several_bounds},
    HierarchyClass{"weights", weights},
    HierarchyClass{"scales", scales},
    HierarchyClass{"whole_numbers", whole_numbers},
    HierarchyClass{"large", large, 100},
};

// 0 and every regularisation that the solver is proven for
inline constexpr std::array kRegularisations = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5,
                                                1e-6, 1e-7, 1e-8, 1e-9, 0.0};

}  // namespace hurcules_test

// Hierarchies whose limits crowd: through one vertex, facing each other, in thin cones, repeated.
#pragma once

#include <cmath>

#include "support/draw.hpp"

namespace hurcules_test {

// tasks that pull towards the crowd
inline void pull(Draw& draw, Hierarchy& levels, Index n, double rho) {
  for (Index k = draw.integer(1, 4); k > 0; --k) {
    const Index m = draw.integer(1, 3);
    const bool exact = draw.chance(0.3);
    const Matrix A = exact ? draw.whole(m, n, 2) : draw.unit_rows(m, n);
    levels.push_back(equality(A, 2.0 * draw.vector(m), rho));
  }
}

// more limits through one point than there are unknowns
inline Hierarchy crowded_vertex(Draw& draw, double rho) {
  const Index n = draw.integer(2, 12), m = draw.integer(n, 3 * n);
  const Matrix A = draw.chance(0.5) ? draw.whole(m, n, 1) : draw.unit_rows(m, n);
  const Vector vertex = draw.whole(n, 1, 2) * draw.choose({0.0, 1.0});
  Hierarchy levels = {
      interval(A, Vector::Constant(m, -kNoLimit), A * vertex, draw.chance(0.7) ? 0.0 : rho)};
  pull(draw, levels, n, rho);
  return levels;
}

// pairs of limits with a gap of 0, 1e-14, 1e-9 or 1e-3 between them, as rows of their own
inline Hierarchy facing_limits(Draw& draw, double rho) {
  const Index n = draw.integer(2, 12);
  Hierarchy levels(draw.integer(1, 3), interval(Matrix(0, n), Vector(0), Vector(0), 0.0));
  const auto any = [&]() -> Level& {
    return levels[draw.integer(0, static_cast<Index>(levels.size()) - 1)];
  };
  for (Index pairs = draw.integer(1, n); pairs > 0; --pairs) {
    const Matrix a = draw.chance(0.3) ? draw.whole(1, n, 2) : draw.unit_rows(1, n);
    const double limit = draw.choose({0.0, 0.5, draw.normal()});
    const double gap = draw.choose({0.0, 1e-14, 1e-9, 1e-3}), scale = draw.choose({1.0, -1.0, 0.5});
    append_row(any(), a, -kNoLimit, limit);
    const double facing = scale * (limit - gap);
    append_row(any(), scale * a, scale > 0 ? facing : -kNoLimit, scale > 0 ? kNoLimit : facing);
  }
  pull(draw, levels, n, rho);
  return levels;
}

// The least angle between two limits of a cone. Where they meet, x is known to eps / angle of its
// size, summed over up to ten unknowns, and so is all that depends on it.
inline constexpr double kThinnest = 1e-8;
inline constexpr double kThinRounding = 10.0 * 2.2e-16 / kThinnest;

// pairs of nearly opposite limits: a wedge of angle 1e-1 .. 1e-8
inline Hierarchy thin_cones(Draw& draw, double rho) {
  const Index n = draw.integer(2, 10);
  Level cones = interval(Matrix(0, n), Vector(0), Vector(0), 0.0);
  for (Index pairs = draw.integer(1, n); pairs > 0; --pairs) {
    const Matrix a = draw.unit_rows(1, n),
                 off = draw.power(std::log10(kThinnest), -1.0) * draw.unit_rows(1, n);
    const double limit = draw.choose({0.0, 0.0, 1e-3, 1.0});
    append_row(cones, a, -kNoLimit, limit);
    append_row(cones, -a + off, -kNoLimit, draw.choose({0.0, -limit, 1e-3}));
  }
  Hierarchy levels = {cones};
  if (draw.chance(0.3)) levels.insert(levels.begin(), box(n, 1.0));
  pull(draw, levels, n, rho);
  return levels;
}

// every limit comes again, scaled by 1e-3 .. 2, in its own level or another
inline Hierarchy repeats(Draw& draw, double rho) {
  const Index n = draw.integer(2, 12);
  Hierarchy levels(draw.integer(1, 3), interval(Matrix(0, n), Vector(0), Vector(0), 0.0));
  for (Index rows = draw.integer(1, n + 2); rows > 0; --rows) {
    const Matrix a = draw.unit_rows(1, n);
    const double lower = draw.uniform(-1.0, 0.5), upper = lower + draw.choose({0.0, 0.2, 1.0});
    for (Index copies = draw.integer(1, 3); copies > 0; --copies) {
      const double scale = draw.choose({1.0, 1.0, 1e-3, 0.3, 2.0});
      Level& level = levels[draw.integer(0, static_cast<Index>(levels.size()) - 1)];
      append_row(level, scale * a, scale * lower, scale * upper);
    }
  }
  for (Level& level : levels) level.rho = draw.chance(0.5) ? 0.0 : rho;
  pull(draw, levels, n, rho);
  return levels;
}

// simple bounds at several priorities: tighter, disjoint, half open, locked
inline Hierarchy several_bounds(Draw& draw, double rho) {
  const Index n = draw.integer(2, 16);
  Hierarchy levels;
  for (Index k = draw.integer(2, 4); k > 0; --k) {
    Vector lower = draw.uniform_vector(n, -1.0, 0.5), upper = lower;
    for (Index j = 0; j < n; ++j) {
      upper[j] += draw.choose({0.0, 0.2, 1.0, 1.0, 2.0});
      if (draw.chance(0.1)) lower[j] = -kNoLimit;
      if (draw.chance(0.1)) upper[j] = kNoLimit;
    }
    levels.push_back(hurcules::make_bounds(lower, upper));
    if (draw.chance(0.7)) pull(draw, levels, n, rho);
  }
  return levels;
}

}  // namespace hurcules_test

// The problems of the solver's benchmarks: a robot's shape, moving smoothly, in four degrees of
// conflict. Same seed, same problems on every machine.
//
// Level 0 is a box |x| <= 1; the levels below have unit rows that move at 0.3 to 1.5 Hz and ask for
// A x = A x_des(t), where x_des lies inside the box (no conflict) or reaches beyond it (box). With
// conflicting levels some rows lie in the span of rows of the levels above and ask for something
// else than those; mixed inequality levels bound some of their rows from one or both sides only.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "hurcules/solver/hierarchy.hpp"

namespace hurcules_benchmark {

using namespace hurcules;

enum class Conflict { None, Box, Levels, Mixed };
inline constexpr Conflict kConflicts[] = {Conflict::None, Conflict::Box, Conflict::Levels,
                                          Conflict::Mixed};
inline const char* name(Conflict conflict) {
  const char* names[] = {"no conflict", "box conflicts", "conflicting levels", "mixed levels"};
  return names[static_cast<int>(conflict)];
}

struct Shape {
  Index unknowns = 0;
  std::vector<Index> rows;  // of the levels under the box
};
inline const Shape kRobot = {19, {3, 3, 3, 3, 3, 2, 2}};
inline const Shape kTwoRobots = {38, {6, 6, 3, 6, 6, 3, 8}};
// accelerations, forces and torques of a humanoid: the last level asks more than there is freedom
inline const Shape kHumanoid = {88, {33, 3, 2, 97}};

// offset + amplitude sin(2 pi frequency t + phase)
struct Wave {
  double offset = 0.0, amplitude = 0.0, frequency = 0.0, phase = 0.0;

  [[nodiscard]] double at(double t) const {
    return offset + amplitude * std::sin(2.0 * std::numbers::pi * frequency * t + phase);
  }
};

// One problem that moves: at(t) is the hierarchy at time t [s].
class Motion {
 public:
  Motion(Shape shape, Conflict conflict, double rho, std::uint64_t seed)
      : shape_(std::move(shape)), conflict_(conflict), rho_(rho), generator_(seed) {
    for (Index i = 0; i < shape_.unknowns; ++i) desired_.push_back(wave(reach(), 0.2 * reach()));
    Index above = 0;
    for (const Index rows : shape_.rows) {
      for (Index i = 0; i < rows; ++i) rows_.push_back(row(above));
      above += rows;
    }
  }

  [[nodiscard]] Hierarchy at(double t) const {
    const Vector box = Vector::Ones(shape_.unknowns);
    Hierarchy levels = {make_bounds(-box, box)};
    const Vector desired = sample(desired_, t);
    Matrix A(static_cast<Index>(rows_.size()), shape_.unknowns);
    Index first = 0;
    for (const Index rows : shape_.rows) {
      for (Index i = first; i < first + rows; ++i)
        A.row(i) = direction(rows_[i], A, t).normalized();
      levels.push_back(level(A.middleRows(first, rows), desired, first, t));
      first += rows;
    }
    return levels;
  }

 private:
  // how far x_des reaches, and the shares of rows that depend on those above or are inequalities:
  // at n = 19 a cold solve then changes its sets about 0, 27, 60 and 80 times
  static constexpr double kReach[] = {0.5, 1.55, 2.6, 2.8};
  static constexpr double kDependent = 0.2;
  static constexpr double kInequality = 0.35;

  enum class Kind { Equality, Interval, Above, Below };
  struct Row {
    std::vector<Wave> waves;  // its direction, or its parts along the rows above
    bool dependent = false;
    Kind kind = Kind::Equality;
    Wave offset;         // what it asks for beyond A x_des
    double width = 0.0;  // of an interval
  };

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  [[nodiscard]] double reach() const { return kReach[static_cast<int>(conflict_)]; }
  Wave wave(double offset, double amplitude) {
    return {uniform(-offset, offset), amplitude, uniform(0.3, 1.5),
            uniform(0.0, 2.0 * std::numbers::pi)};
  }

  Row row(Index above) {
    Row row;
    const bool levels = conflict_ == Conflict::Levels || conflict_ == Conflict::Mixed;
    row.dependent = above > 0 && uniform(0.0, 1.0) < kDependent && levels;
    for (Index i = 0; i < (row.dependent ? above : shape_.unknowns); ++i)
      row.waves.push_back(wave(1.0, 0.2));
    if (row.dependent) row.offset = wave(0.5 * reach(), 0.1 * reach());
    if (conflict_ == Conflict::Mixed && uniform(0.0, 1.0) < kInequality)
      row.kind = static_cast<Kind>(1 + generator_() % 3);
    row.width = uniform(0.0, 0.5);
    return row;
  }

  static Vector sample(const std::vector<Wave>& waves, double t) {
    Vector values(static_cast<Index>(waves.size()));
    for (Index i = 0; i < values.size(); ++i) values[i] = waves[static_cast<std::size_t>(i)].at(t);
    return values;
  }

  static Vector direction(const Row& row, const Matrix& A, double t) {
    const Vector values = sample(row.waves, t);
    return row.dependent ? Vector(A.topRows(values.size()).transpose() * values) : values;
  }

  [[nodiscard]] Level level(const Matrix& A, const Vector& desired, Index first, double t) const {
    Level level{.A = A, .lower = A * desired, .upper = Vector(A.rows()), .rho = rho_};
    for (Index i = 0; i < A.rows(); ++i) {
      const Row& row = rows_[static_cast<std::size_t>(first + i)];
      const double middle = level.lower[i] + (row.dependent ? row.offset.at(t) : 0.0);
      const double half = row.kind == Kind::Equality ? 0.0 : 0.5 * row.width;
      level.lower[i] = row.kind == Kind::Below ? -kInfinity : middle - half;
      level.upper[i] = row.kind == Kind::Above ? kInfinity : middle + half;
    }
    return level;
  }

  Shape shape_;
  Conflict conflict_;
  double rho_;
  std::mt19937_64 generator_;
  std::vector<Wave> desired_;
  std::vector<Row> rows_;
};

// the rows of `levels` with the targets that the motion has at time t [s]: an operator's jump
inline Hierarchy with_targets_of(const Motion& motion, double t, Hierarchy levels) {
  const Hierarchy later = motion.at(t);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    levels[k].lower = later[k].lower;
    levels[k].upper = later[k].upper;
  }
  return levels;
}
inline constexpr double kJump = 0.3;  // [s]

}  // namespace hurcules_benchmark

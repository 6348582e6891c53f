// Bytes to a hierarchy: every string of bytes is a problem, and small changes make related ones.
//
// The first byte chooses how wild the numbers are. Tame: small whole numbers, halves, 16-bit
// fractions; hard: also sizes 1e-3 .. 1e3, rows that differ by 1e-12 .. 1e-3, and tiny
// regularisation; wild: also NaN, infinities and the ends of the range of doubles.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hurcules/solver/hierarchy.hpp"

namespace hurcules_fuzz {

using hurcules::Hierarchy;
using hurcules::Index;
using hurcules::Level;
using hurcules::Matrix;
using hurcules::Vector;

enum class Wildness { Tame, Hard, Wild };

// the bytes, one after the other; zeros when they are used up
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}
  std::uint8_t next() { return data_ < end_ ? *data_++ : std::uint8_t{0}; }
  // 0 .. count - 1
  Index next(Index count) { return next() % count; }
  [[nodiscard]] bool empty() const { return data_ == end_; }

 private:
  const std::uint8_t* data_;
  const std::uint8_t* end_;
};

struct Problem {
  Index unknowns = 1;
  Wildness wildness = Wildness::Tame;
  // has rows so close to dependent that the rank tolerance of 1e-10 is near
  bool delicate = false;
  Hierarchy levels;
};

class Decoder {
 public:
  Decoder(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  Problem problem() {
    const Index wild = bytes_.next(16);
    problem_.wildness = wild < 8 ? Wildness::Tame : wild < 14 ? Wildness::Hard : Wildness::Wild;
    problem_.unknowns = 1 + bytes_.next(8);
    for (Index count = 1 + bytes_.next(6); count > 0 && !bytes_.empty(); --count) {
      problem_.levels.push_back(bytes_.next(5) == 0 ? bounds() : level());
    }
    return problem_;
  }

 private:
  double tame() {
    constexpr double kSmall[] = {0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.5, 3.0};
    const std::uint8_t code = bytes_.next();
    if (code < 192) return kSmall[code % 8];
    return static_cast<double>(code * 256 + bytes_.next() - 57344) / 4096.0;  // -2 .. 2
  }
  static constexpr double kNearOne[] = {1.0 + 1e-9, 1.0 - 1e-12};
  double number() {
    constexpr double kHard[] = {1e-3, -1e-3, 1e3, -1e3, kNearOne[0], kNearOne[1], 30.0, -0.03};
    constexpr double kWild[] = {1e300, -1e300, 1e155, 1e-155, 1e-300, 5e-324, 1e19,     -1e20,
                                1e100, 1e-100, 1e20,  -1e8,   1e8,    1e-8,   INFINITY, NAN};
    if (problem_.wildness == Wildness::Tame) return tame();
    const std::uint8_t code = bytes_.next();
    if (code < 16) return kHard[code % 8];
    if (code < 24 && problem_.wildness == Wildness::Wild) return kWild[bytes_.next() % 16];
    return tame();
  }
  double regularisation() {
    constexpr double kTame[] = {0.1, 0.0, 1.0, 0.01};
    const Index code = bytes_.next(12);
    if (code < 6 || problem_.wildness == Wildness::Tame) return kTame[code % 4];
    return std::pow(10.0, static_cast<double>(3 - code));  // 1e-3 .. 1e-8
  }

  Level bounds() {
    const Index n = problem_.unknowns;
    Level level{.A = Matrix(), .lower = Vector(n), .upper = Vector(n), .rho = 0.0, .bounds = true};
    for (Index i = 0; i < n; ++i) limits(level, i);
    return level;
  }
  Level level() {
    const Index m = bytes_.next(5);
    Level level{.A = Matrix(m, problem_.unknowns),
                .lower = Vector(m),
                .upper = Vector(m),
                .rho = regularisation()};
    for (Index i = 0; i < m; ++i) {
      row(level, i);
      limits(level, i);
    }
    return level;
  }

  void row(Level& level, Index i) {
    const Index kind = bytes_.next(8);
    if (kind < 5 || rows_.empty()) {
      for (double& a : level.A.row(i)) a = number();
      // beside entries of 1 they stand out by 1e-9 and 1e-12
      problem_.delicate |= (level.A.row(i).array() == kNearOne[0]).any() ||
                           (level.A.row(i).array() == kNearOne[1]).any();
    } else {
      // a row that came before, scaled, or nearly so
      level.A.row(i) = rows_[bytes_.next(static_cast<Index>(rows_.size()))].transpose();
      if (kind != 5) level.A.row(i) *= tame();
      if (kind == 7 && problem_.wildness != Wildness::Tame) {
        const Index j = bytes_.next(problem_.unknowns), digits = 3 + bytes_.next(10);
        const double change = std::pow(10.0, static_cast<double>(-digits));
        problem_.delicate |= digits > 4 || turned(level.A.row(i), j, change) <= 1e-8;
        level.A(i, j) += change;
      }
    }
    rows_.push_back(level.A.row(i).transpose());
  }

  // by how much [rad] a row turns when entry j changes; little where that entry is nearly all of it
  static double turned(const Vector& row, Index j, double change) {
    const double norm = row.norm();
    if (norm == 0.0) return 1.0;
    const double across = (row - row[j] * Vector::Unit(row.size(), j)).norm() / norm;
    return change * across / norm;
  }

  void limits(Level& level, Index i) {
    constexpr double kGap[] = {1.0, 0.5, 1e-3, 1e-9, 1e-14, 2.0};
    const Index kind = bytes_.next(8);
    const double at = number();
    level.lower[i] = level.upper[i] = at;
    if (kind < 3) return;  // an equality
    level.upper[i] += kGap[bytes_.next(6)];
    if (kind == 3) level.lower[i] = -INFINITY;
    if (kind == 4) level.upper[i] = INFINITY;
    if (kind == 5 && problem_.wildness == Wildness::Wild) level.upper[i] = number();
  }

  Bytes bytes_;
  Problem problem_;
  std::vector<Vector> rows_;
};

}  // namespace hurcules_fuzz

// The thresholds of a careful level, by the number that it computes with.
#pragma once

#include <limits>

#include "hurcules/base/types.hpp"
#include "hurcules/solver/tolerances.hpp"
#include "hurcules/solver/wide.hpp"

namespace hurcules {

template <class Scalar>
struct CarefulTolerances;

template <>
struct CarefulTolerances<long double> {
  using Long = long double;
  // limits of rows above are moved outwards by this part of max(1, |x|), and up to twice as much
  static constexpr Long kApart = 1e-14L;
  // an own row is violated beyond this part of the longest step so far: what rounds is its value,
  // and in cones of 1e-8 rad violations of 1e-19 decide where x of 1e-3 goes
  static constexpr Long kViolated = 1e-17L;
  // a step that is rounding, relative to max(1, |x|)
  static constexpr Long kNoStep = 1e-17L;
  // a multiplier pulls below this part of the forces, or of the step
  static constexpr Long kPull = 1e-16L;
  // ... which grows so many times at most
  static constexpr Index kLadder = 16;
  // a limit that pushes by more than this part of the forces stays where the violation is the
  // smallest; the others may not move against it either, but that is found out
  static constexpr Long kFixed = 1e-8L;
  // an own row is met to this part of max(1, abs x)
  static constexpr Long kMet = 1e-14L;
  // a row that moves by less than this part of a step does not block it
  static constexpr Long kBlocking = 1e-13L;
  // a held row that has less than this outside the rows before it is held by them
  static constexpr Long kImplied = 1e-12L;
  // what is left of an equality row that has a direction by the chain is rounding
  static constexpr Long kPivot = 1e-17L;
  // ... and has so much of it that its rounding is below what a proof allows
  static constexpr Long kTold = std::numeric_limits<Long>::epsilon() / tolerance::kProven;
};

// the same relative to its rounding, which leaves 1e10 between it and each of them, so that rows of
// which 1e-15 is left still count
template <>
struct CarefulTolerances<Wide> {
  using Long = long double;
  static constexpr Long kUnit =
      std::numeric_limits<Long>::epsilon() * std::numeric_limits<Long>::epsilon();
  static constexpr Long kApart = 1e10L * kUnit;
  static constexpr Long kViolated = 1e7L * kUnit;
  static constexpr Long kNoStep = 1e7L * kUnit;
  static constexpr Long kPull = 1e8L * kUnit;
  static constexpr Index kLadder = 2;
  static constexpr Long kFixed = 1e16L * kUnit;
  static constexpr Long kMet = 1e10L * kUnit;
  static constexpr Long kBlocking = 1e12L * kUnit;
  static constexpr Long kImplied = 1e14L * kUnit;
  static constexpr Long kPivot = 1e3L * kUnit;
  static constexpr Long kTold = kUnit / tolerance::kProven;
};

}  // namespace hurcules

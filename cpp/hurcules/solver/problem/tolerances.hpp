// Every threshold of the solver, in one place. Each was varied alone over orders of magnitude
// without a wrong answer; all are relative to the scale that stands beside
// them.
#pragma once

namespace hurcules::tolerance {

// an equality row depends on the rows before it: what is left of it, relative to |a|
inline constexpr double kRank = 1e-10;
// an own row of an unregularised level depends on the limits that are held: only rounding is left
// of it, whatever is more takes part in the least squares
inline constexpr double kOwnRank = 1e-13;
// an inequality row has no part in the free directions of a level, relative to |a|
inline constexpr double kLost = 1e-10;
// a limit is broken, relative to max(1, |x|) |a| ...
inline constexpr double kBroken = 5e-13;
// ... plus the rounding of the target, relative to max |z0|
inline constexpr double kBrokenTarget = 1e-14;
// a multiplier is negative, relative to the largest
inline constexpr double kNegative = 1e-11;
// ... where a set is only checked: what was found within the line above must pass here
inline constexpr double kNegativeWarm = 1e-10;
// a sum of forces that is rounding, relative to the largest of them
inline constexpr double kNoise = 1e-14;
// a row depends on the working set: what is left of it, relative to its norm in z
inline constexpr double kDependent = 1e-10;
// an active row misses its limit and is worth a correction, relative to max(1, |x|)
inline constexpr double kMiss = 2e-14;
// a limit settles the violation of a level with rho = 0 when its multiplier is above this part of
// the largest
inline constexpr double kSettling = 1e-9;
// ... and when it is no rounding: relative to max |a|^2 max(1, |x|) of the level
inline constexpr double kNoForce = 1e-12;
// how far rows above may get worse before another strategy is tried, relative to |a| max(1, |x|)
inline constexpr double kHarm = 1e-12;
// a level is proven when its optimality residual is below this
inline constexpr double kProven = 1e-9;
// what a multiplier counts for in the forces that an imbalance is measured against: its rounding is
// 1e-15 of it, and kProven what is allowed
inline constexpr double kForceRounding = 1e-6;
// forces below this part of |a|^2 max(1, |x|) are not told from rounding
inline constexpr double kLeastForce = 1e-3;
// the regularisation with which the working set of a level with less is first sought, relative to
// max |a|
inline constexpr double kProximal = 1e-4;
// a regularisation so small, relative to max |a|, that the least-distance form loses digits
inline constexpr double kSmall = 1e-2;
// a regularisation that counts as none where all else failed, relative to max |a|: its square is
// lost in the rounding of the forces
inline constexpr double kTiny = 1e-8;
// a residual that is rounding and moves nothing, relative to |a| |x| + |b|
inline constexpr double kZeroResidual = 1e-15;

// Algorithm 1 (ModifiedActiveSet); its rows are met to rounding or not at all.
// a row is violated, relative to |a| max(1, |x|)
inline constexpr double kViolated = 1e-10;
// a multiplier is negative, relative to the largest of its level ...
inline constexpr double kNegativeMultiplier = 1e-10;
// ... plus the rounding of a multiplier that is a difference of two numbers, relative to them
inline constexpr double kDifference = 1e-13;
// a level is violated less than before, relative to max(1, violation)
inline constexpr double kLess = 1e-9;

}  // namespace hurcules::tolerance

// How far episodes side by side are from their goals, for how long they have been there, and how
// they swing; one episode a row.
#pragma once

#include "hurcules/base/types.hpp"

namespace hurcules {

// Rows (n, h size) of h poses each: place [m], then, where size is 7, quaternion w, x, y, z of any
// length. Rounded: as float32 has them, which is how they are seen.

// (n, h) [m] between the places of two rows. Throws Error for arrays of another shape.
[[nodiscard]] Matrix distances(const ConstMatrixRef& one, const ConstMatrixRef& other, Index size,
                               bool rounded);

// (n, h) cosine, from 0 to 1, of half the angle between two orientations. Throws Error likewise.
[[nodiscard]] Matrix half_angle_cosines(const ConstMatrixRef& one, const ConstMatrixRef& other,
                                        Index size, bool rounded);

// (n) whether all of a row are smaller
[[nodiscard]] Flags all_below(const ConstMatrixRef& values, double bound);

// (n) factor times the mean of a row
[[nodiscard]] Vector means(const ConstMatrixRef& values, double factor);

// (n) sum of the squares of a row
[[nodiscard]] Vector squares(const ConstMatrixRef& values);

// Counts for how long [s] something holds without a break, after a step of dt [s]: `held` (n, 1);
// `done` (n, 1) is 1 from when that was `least` [s]. Returns (n) what `done` grew by.
Vector hold(const FlagsRef& now, double dt, double least, MatrixRef held, MatrixRef done);

struct Swing {                 // (n, k) each, of points in springs, along each axis alike
  MatrixRef place, velocity;   // [m], [m/s] of what they hang in, at its last step
  MatrixRef deflection, rate;  // [m], [m/s]
};

// Carries the deflections on by dt [s], at whose start what they hang in changed its velocity and
// came to `place` (n, k). free: (2, 2) what deflection and rate become in dt by themselves. Returns
// (n, k) where the points are. Throws Error for arrays of another shape.
Matrix swing(const ConstMatrixRef& place, const ConstMatrixRef& free, double dt, Swing& state);

}  // namespace hurcules

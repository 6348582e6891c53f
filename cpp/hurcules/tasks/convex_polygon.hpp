// A convex polygon in a plane, the one that a robot stands within.
#pragma once

#include <string>

#include "hurcules/base/types.hpp"

namespace hurcules {

class ConvexPolygon {
 public:
  // corners: (k, 2) [m] in x and y, in either turn; throws Error, naming the task, unless three or more,
  // finite and convex
  ConvexPolygon(const Matrix& corners, const std::string& task);

  [[nodiscard]] Index sides() const { return normals_.rows(); }
  [[nodiscard]] const Matrix& corners() const { return corners_; }  // (k, 2); side i begins at i
  [[nodiscard]] const Matrix& normals() const { return normals_; }  // (k, 2), of length 1, inward

 private:
  Matrix corners_, normals_;
};

}  // namespace hurcules

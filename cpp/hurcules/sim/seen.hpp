// What is seen and commanded of episodes side by side: arrays of their tasks put together as a
// policy wants them, and what it answers cut to its range.
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

using FloatVector = Eigen::Matrix<float, Eigen::Dynamic, 1>;
using FloatMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Writes parts (n, ...) side by side into rows; errors (n, e) come first, onto the first columns,
// then what is beyond +-bound is cut off. Returns whether all are finite. Throws Error for arrays
// of another shape.
bool put_together(const std::vector<ConstMatrixRef>& parts, const ConstMatrixRef& errors,
                  const Eigen::Ref<const FloatVector>& bound, Eigen::Ref<FloatMatrix> rows);

// Cuts numbers to [-1, 1]. Returns whether all were finite.
bool cut(VectorRef numbers);

}  // namespace hurcules

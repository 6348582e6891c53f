// Checks of vectors that a caller gives; each throws Error with what was wanted and what came.
#pragma once

#include <string_view>

#include "hurcules/base/types.hpp"

namespace hurcules {

// "qpos wants 7 numbers, 6 came"
void require_size(std::string_view what, Index size, Index wanted);
// "mass_matrix wants a matrix of (6, 6), (5, 5) came"
void require_shape(std::string_view what, const MatrixRef& matrix, Index rows, Index columns);
// as many, and finite: "qpos wants finite numbers, number 2 is nan"
void require_values(std::string_view what, const ConstVectorRef& values, Index wanted);

// "dt wants a positive time [s], 0 came" unless it holds
void require_number(bool holds, std::string_view wanted, double came);

}  // namespace hurcules

// Householder reflections for the small blocks of a level.
#pragma once

#include "hurcules/base/types.hpp"

namespace hurcules {

// makes the first `columns` columns of a block (rows, columns + 1) upper triangular; the last
// column is a right-hand side
template <class Block>
void triangularize(Block& block, Index rows, Index columns);

}  // namespace hurcules

// Householder reflections for the small blocks of a level.
#pragma once

#include "hurcules/base/types.hpp"
#include "hurcules/solver/kernels/padded.hpp"

namespace hurcules {

// Makes the first `columns` columns of a block (rows, columns + 1) upper triangular; the last
// column is a right-hand side. What stands below the diagonal then has no meaning.
template <class Block>
void triangularize(Block& block, Index rows, Index columns);
// the same by the kernels; `work` has room for a row and a column
void triangularize(PaddedRows& block, Index rows, Index columns, double* work);
// y (columns) with R y = c, of a block (R, c) that is triangular
void solve_triangular(const PaddedRows& block, Index columns, double* y);

}  // namespace hurcules

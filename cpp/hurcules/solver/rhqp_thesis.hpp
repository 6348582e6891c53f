// The method of the thesis, literally: Algorithm 1 with one working set over all levels, singular
// values, and multipliers that contain the regularisation error [T 3.3.37], [T 3.4.108-116],
// [T alg. 1].
//
// One repair: every violated row blocks, also where (3.4.117) finds alpha >= 1 because its limit is
// negative. What remains wrong is shown in solver.md §3: the first level can end far from its
// optimum, a regularised limit stops at sigma^2 / (sigma^2 + rho^2) of itself, and cycles happen.
#pragma once

#include "hurcules/solver/modified_active_set.hpp"

namespace hurcules {

class RhqpThesis : public ModifiedActiveSet {
 public:
  RhqpThesis(Index unknowns, const SolverOptions& options);
};

}  // namespace hurcules

// The unregularised hierarchical quadratic program: every rho counts as 0, complete orthogonal
// decompositions, the same active set loop [T 3.3.28], [T §3.5].
#pragma once

#include "hurcules/solver/modified_active_set.hpp"

namespace hurcules {

class Hqp : public ModifiedActiveSet {
 public:
  Hqp(Index unknowns, const SolverOptions& options);
};

}  // namespace hurcules

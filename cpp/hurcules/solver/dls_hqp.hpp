// HQP with a damped inverse [T 3.5.123-126]: the same x as RhqpThesis for the same working set, but
// multipliers without the regularisation error u_k. So it cycles near singularities and fails to
// release limits [T 4.3.3], [T 4.3.4].
#pragma once

#include "hurcules/solver/modified_active_set.hpp"

namespace hurcules {

class DlsHqp : public ModifiedActiveSet {
 public:
  DlsHqp(Index unknowns, const SolverOptions& options);
};

}  // namespace hurcules

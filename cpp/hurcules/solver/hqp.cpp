#include "hurcules/solver/hqp.hpp"

namespace hurcules {

Hqp::Hqp(Index unknowns, const SolverOptions& options)
    : ModifiedActiveSet(unknowns, options,
                        {.factor = FactorKind::CompleteOrthogonal, .regularized = false}) {}

}  // namespace hurcules

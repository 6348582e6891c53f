#include "hurcules/solver/dls_hqp.hpp"

namespace hurcules {

DlsHqp::DlsHqp(Index unknowns, const SolverOptions& options)
    : ModifiedActiveSet(unknowns, options,
                        {.factor = FactorKind::CompleteOrthogonal, .regularization_error = false}) {
}

}  // namespace hurcules

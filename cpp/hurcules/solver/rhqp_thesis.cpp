#include "hurcules/solver/rhqp_thesis.hpp"

namespace hurcules {

RhqpThesis::RhqpThesis(Index unknowns, const SolverOptions& options)
    : ModifiedActiveSet(unknowns, options, {}) {}

}  // namespace hurcules

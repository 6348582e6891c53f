#include "hurcules/solver/solution.hpp"

namespace hurcules {

std::string to_string(SolverStatus status) {
  switch (status) {
    case SolverStatus::Solved:
      return "solved";
    case SolverStatus::ReducedAccuracy:
      return "reduced accuracy";
    case SolverStatus::IterationLimit:
      return "iteration limit";
    case SolverStatus::LostPrecision:
      return "lost precision";
    case SolverStatus::InvalidInput:
      return "invalid input";
  }
  return "unknown";
}

}  // namespace hurcules

#include "hurcules/solver/solver.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/solver/workspace.hpp"

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

Solver::Solver(Index unknowns, SolverOptions options)
    : workspace_(std::make_unique<Workspace>(unknowns, std::move(options))) {}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::reserve(const Hierarchy& hierarchy) {
  workspace_->reserve(hierarchy);
}
const Solution& Solver::solve(const Hierarchy& hierarchy) {
  return workspace_->solve(hierarchy);
}
const Solution& Solver::solution() const {
  return workspace_->solution();
}
Index Solver::unknowns() const {
  return workspace_->unknowns();
}
const SolverOptions& Solver::options() const {
  return workspace_->options();
}
std::vector<std::vector<Vector>> Solver::multipliers() const {
  return workspace_->multipliers();
}
void Solver::reset() {
  workspace_->reset();
}
void Solver::save(StateWriter& writer) const {
  workspace_->save(writer);
}
void Solver::restore(StateReader& reader) {
  workspace_->restore(reader);
}

}  // namespace hurcules

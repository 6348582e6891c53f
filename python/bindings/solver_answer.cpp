#include "solver_answer.hpp"

namespace hurcules_bindings {

using namespace hurcules;

Answer::Answer(const Solver& solver) : solution_(solver.solution()), solved_(solver.solved()) {
  if (!solved_) multipliers_ = solver.multipliers();
}

const std::vector<std::vector<Vector>>& Answer::multipliers() {
  if (!multipliers_) multipliers_ = hurcules::multipliers(*solved_);
  return *multipliers_;
}

const std::vector<LevelReport>& Answer::reports() {
  require_solved(solved_.get());
  if (!reports_) reports_ = level_reports(*solved_);
  return *reports_;
}

const Sensitivity& Answer::sensitivity() {
  if (!sensitivity_) sensitivity_.emplace(solved_);
  return *sensitivity_;
}

}  // namespace hurcules_bindings

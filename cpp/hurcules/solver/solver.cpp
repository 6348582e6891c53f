#include "hurcules/solver/solver.hpp"

#include "hurcules/base/error.hpp"
#include "hurcules/solver/method.hpp"
#include "hurcules/solver/sensitivity/level_report.hpp"
#include "hurcules/solver/sensitivity/sensitivity.hpp"

namespace hurcules {

namespace {

// a square of them is kept: 800 MB
constexpr Index kMostUnknowns = 10'000;

}  // namespace

Solver::Solver(Index unknowns, SolverOptions options)
    : unknowns_(unknowns), options_(std::move(options)) {
  require(unknowns > 0, "a solver needs at least one unknown, got " + std::to_string(unknowns));
  require(unknowns <= kMostUnknowns, "a dense solver takes up to " + std::to_string(kMostUnknowns) +
                                         " unknowns, got " + std::to_string(unknowns));
  check(options_);
  method_ = make_method(unknowns_, options_);
}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::reserve(const Hierarchy& hierarchy) {
  views_.reserve(hierarchy.size());
  read(hierarchy);
  method_->reserve(views_);
}

void Solver::read(const Hierarchy& hierarchy) {
  views_.clear();
  for (const Level& level : hierarchy) views_.push_back(view(level));
}

const Solution& Solver::solve(const Hierarchy& hierarchy) & {
  read(hierarchy);
  return method_->solve(views_);
}
Solution Solver::solve(const Hierarchy& hierarchy) && {
  return solve(hierarchy);  // *this has a name here
}

const Solution& Solver::solve_views(HierarchyView hierarchy) {
  return method_->solve(hierarchy);
}
const Solution& Solver::solution() const {
  return method_->solution();
}
std::vector<std::vector<Vector>> Solver::multipliers() const {
  return method_->multipliers();
}
std::shared_ptr<const SolvedHierarchy> Solver::solved() const {
  return method_->solved();
}
Sensitivity Solver::sensitivity() const {
  return Sensitivity(solved());
}
std::vector<LevelReport> Solver::reports() const {
  const std::shared_ptr<const SolvedHierarchy> copy = solved();
  require_solved(copy.get());
  return level_reports(*copy);
}
void Solver::reset() {
  method_->reset();
}
void Solver::save(StateWriter& writer) const {
  method_->save(writer);
}
void Solver::restore(StateReader& reader) {
  method_->restore(reader);
}

}  // namespace hurcules

// Solves regularised hierarchical quadratic programs.
#pragma once

#include <memory>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/solver/hierarchy.hpp"
#include "hurcules/solver/solution.hpp"
#include "hurcules/solver/solver_options.hpp"

namespace hurcules {

class Method;
class Sensitivity;
class SolvedHierarchy;
struct LevelReport;

// Keeps its working sets between solves: the next solve starts warm where the pattern of levels is
// the same. A solve allocates nothing once a problem of its size was solved or reserved; it never
// throws and always ends.
class Solver {
 public:
  explicit Solver(Index unknowns, SolverOptions options = {});
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  // sizes the memory for problems of this shape
  void reserve(const Hierarchy& hierarchy);
  // the reference stays valid until the next solve
  const Solution& solve(const Hierarchy& hierarchy) &;
  // of a solver that nobody keeps: Solver(3).solve(hierarchy)
  [[nodiscard]] Solution solve(const Hierarchy& hierarchy) &&;
  // the same on numbers that lie elsewhere, without a copy
  const Solution& solve_views(HierarchyView hierarchy);
  [[nodiscard]] const Solution& solution() const;
  [[nodiscard]] Index unknowns() const { return unknowns_; }
  [[nodiscard]] const SolverOptions& options() const { return options_; }
  // multipliers[k][j] (m_j) of the rows of level j in the optimality of level k, j <= k [T 3.4.116]
  [[nodiscard]] std::vector<std::vector<Vector>> multipliers() const;
  // What follows is made when asked, from the arrays of the last solve: they must still be there
  // and unchanged. What comes back owns its numbers.
  [[nodiscard]] std::shared_ptr<const SolvedHierarchy> solved() const;  // null: the method has none
  // these throw Error then; sensitivity.hpp, level_report.hpp
  [[nodiscard]] Sensitivity sensitivity() const;
  [[nodiscard]] std::vector<LevelReport> reports() const;  // a final level
  // forgets the working sets: the next solve is cold
  void reset();

  // the working sets, so that a restored run gives the same bits
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void read(const Hierarchy& hierarchy);

  Index unknowns_;
  SolverOptions options_;
  std::unique_ptr<Method> method_;
  std::vector<LevelView> views_;
};

}  // namespace hurcules

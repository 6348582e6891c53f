// The regularised hierarchical quadratic program: what a solve takes and what it returns.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules {

enum class SolverStatus {
  Solved,           // every level optimal, to the tolerances of NOTATION.md
  ReducedAccuracy,  // ended, but not all levels are proven: see optimality
  IterationLimit,   // max_changes met: x is feasible for all levels above, final_levels says which
                    // are optimal
  LostPrecision,    // numbers beyond double arithmetic: x is that of the levels above final_levels
  InvalidInput,     // NaN, lower > upper or a wrong shape: x is zero, nothing was solved
};
[[nodiscard]] std::string to_string(SolverStatus status);

enum class Side { Lower = -1, Upper = 1 };

// A row that holds x back at the end of a solve.
struct ActiveRow {
  int level = 0;  // level that the row belongs to
  int row = 0;    // its row there
  Side side = Side::Upper;
  int held_by = 0;          // level that pushes against it
  double multiplier = 0.0;  // >= 0, of that level's problem; 0: holds only the smallest step
};

// What becomes of a direction that a level's rows hardly see (chain_segments.hpp).
enum class Handover {
  Strict,  // it is the level's down to its rank tolerance: x jumps where a rank changes
  Smooth,  // it goes back to the levels below gradually, from sigma = rho of the level on
};
[[nodiscard]] std::string to_string(Handover handover);
// "strict" or "smooth"; throws Error on another name
[[nodiscard]] Handover handover_named(const std::string& name);

// The regularisation that a level with equality rows is solved with [T §3.3.3, §4.3.3].
enum class Regularization {
  Constant,  // its rho
  // rho sqrt(1 - (sigma_min / singular_threshold)^2), 0 above the threshold: no error away from
  // singularity; sigma_min of its equality rows on the directions left to it
  Adaptive,
};
[[nodiscard]] std::string to_string(Regularization regularization);
// "constant" or "adaptive"; throws Error on another name
[[nodiscard]] Regularization regularization_named(const std::string& name);

struct SolverOptions {
  std::string method = "lexicographic";  // solver.md §4
  // evaluate Solution::optimality at every solve; without, ways that are usually right are believed
  // and it is NaN: about a fifth of the time of an easy solve
  bool proof = true;
  int max_changes = 10000;  // working-set changes a solve, after which it ends with IterationLimit
  // of Algorithm 1 (rhqp_thesis, hqp, dls_hqp), which may cycle; thesis: 12 for dls_hqp
  int max_iterations = 100;
  // of "lexicographic", what it does near singularities:
  Handover handover = Handover::Strict;
  Regularization regularization = Regularization::Constant;
  double singular_threshold = 0.1;  // > 0, unit of A; below it Adaptive regularises
};

struct Solution {
  Vector x;  // (n)
  SolverStatus status = SolverStatus::Solved;
  std::vector<Vector> violations;      // a level (m): A x - clip(A x, lower, upper)
  std::vector<ActiveRow> working_set;  // by level that pushes
  int factorizations = 0;              // at least one a non-empty level
  int changes = 0;                     // working-set changes
  int final_levels = 0;                // levels known to be optimal
  double optimality = 0.0;  // worst relative residual of the optimality conditions of all levels;
                            // NaN when no proof was asked for
};

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
  const Solution& solve(const Hierarchy& hierarchy);
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

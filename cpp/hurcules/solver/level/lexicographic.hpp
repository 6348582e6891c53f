// The default method: the loop over the levels (solver.md §1, §4).
#pragma once

#include <vector>

#include "hurcules/solver/level/level_solver.hpp"
#include "hurcules/solver/level/working_set_cache.hpp"
#include "hurcules/solver/method.hpp"
#include "hurcules/solver/problem/level_svd.hpp"
#include "hurcules/solver/problem/nullspace_bases.hpp"
#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules {

class Lexicographic : public Method {
 public:
  Lexicographic(Index unknowns, const SolverOptions& options);
  void reserve(HierarchyView hierarchy) override;
  const Solution& solve(HierarchyView hierarchy) override;
  [[nodiscard]] const Solution& solution() const override { return solution_; }
  [[nodiscard]] std::vector<std::vector<Vector>> multipliers() const override;
  [[nodiscard]] std::shared_ptr<const SolvedHierarchy> solved() const override;
  void reset() override { kept_.clear(); }
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

 private:
  [[nodiscard]] bool fits(HierarchyView hierarchy) const;
  // all levels from the first on, until one cannot be ended; the answer of the last that was
  const double* solve_levels(HierarchyView hierarchy);
  // somebody asks for singular values
  [[nodiscard]] bool uses_svd() const {
    return options_.handover == Handover::Smooth ||
           options_.regularization == Regularization::Adaptive;
  }
  // rho of level k, constant or adapted to its singular values
  double regularization(double rho, int k);
  void fill_solution(const double* x);
  void fill_violations(int k);
  // what is proven about the levels may not have moved since
  void check_moved();
  const Solution& refuse();

  Index unknowns_;
  SolverOptions options_;
  Solution solution_;
  RowTable rows_;
  NullspaceBases nullspaces_;
  LevelSvd svd_;
  LevelSolver level_;
  WorkingSetCache kept_;
  PaddedVector zero_, equality_values_;
  std::vector<LevelRecord> records_;
  Index reserved_rows_ = 0, reserved_own_ = 0;
  std::size_t reserved_levels_ = 0;
};

}  // namespace hurcules

// The default's problem (solver.md §1) by one general quadratic program a level, as a cascade of
// off-the-shelf solvers does it [T §3.1.1]. Slow, always cold, for comparison; it allocates.
//
// Level k, from x_{k-1}, with orthonormal directions Z (n, o) that are still free:
//     min 1/2 |violation at x_{k-1} + Z t|^2 + 1/2 rho^2 |t|^2,  no inequality row above gets worse
// Own inequality rows get a slack variable each. rho = 0: proximal steps, then the smallest |t|.
#pragma once

#include <vector>

#include "hurcules/solver/method.hpp"
#include "hurcules/solver/problem/row_table.hpp"
#include "hurcules/solver/thesis/dual_program.hpp"

namespace hurcules {

class Cascade : public Method {
 public:
  Cascade(Index unknowns, const SolverOptions& options);
  void reserve(HierarchyView hierarchy) override;
  const Solution& solve(HierarchyView hierarchy) override;
  [[nodiscard]] const Solution& solution() const override { return solution_; }
  [[nodiscard]] std::vector<std::vector<Vector>> multipliers() const override;
  // nothing is kept between solves
  void reset() override {}
  void save(StateWriter& /*writer*/) const override {}
  void restore(StateReader& /*reader*/) override {}

 private:
  // one side of an inequality row in a level's program:  sign a x >= sign limit
  struct Limit {
    int row = 0;
    double sign = 1.0;
    double limit = 0.0;
  };
  struct Record {
    Vector gradient;     // (n): rho^2 (x_k - x_{k-1}) + forces of inequality rows and own rows
    Vector multipliers;  // a row of the table: side * multiplier in this level
  };

  [[nodiscard]] Vector row(int i) const;  // (n)
  // equality rows of level k as a matrix (rows, n)
  [[nodiscard]] Matrix equality_rows(int first_level, int last_level) const;
  [[nodiscard]] std::vector<Limit> limits(int k) const;
  // each moves t_ (o); false when a program was not solved
  bool solve_regularized(double rho, int k);  // around t_
  bool solve_unregularized(int k);
  bool smallest_step(int k);
  // rows of the table that a level with rho = 0 has settled
  [[nodiscard]] std::vector<char> settled_rows(int k) const;
  bool minimize_program();
  void finish_level(double rho, int k);
  [[nodiscard]] double residual(const Record& record, int k, const Vector& x_above) const;
  void fill_solution();

  Index unknowns_;
  SolverOptions options_;
  Solution solution_;
  RowTable rows_;
  Matrix Z_;      // (n, o)
  Vector x_, t_;  // x_{k-1}, (o)
  QuadraticProgram program_;
  QuadraticAnswer answer_;
  std::vector<Limit> limits_;    // a row of the program
  std::vector<Record> records_;  // a level solved
};

}  // namespace hurcules

// One solved level as a linear system: on the active piece x is a smooth function of the numbers of
// the hierarchy, and this is what it solves.
//
// t = x - x_above, C: the independent rows that keep a value (equality rows above, limits held
// against the violation), V: the level's equalities and violated rows, e = V x - b, W: rows that
// hold only the smallest step:
//     rho^2 t + V'e + C'mu = 0,   C t = d                                   [T 3.4.100-113]
// and for rho = 0 the smallest such t with W t = d_w:
//     t + V'(V p) + C'q + W's = 0,   C p = 0
// Where the levels above left the directions B (nullspace_derivative.hpp) the same holds in x =
// x_above
// + B t, with C B, V B, W B for C, V, W, and no equality rows above among C.
#pragma once

#include <vector>

#include "hurcules/solver/sensitivity/row_space.hpp"
#include "hurcules/solver/sensitivity/solved_hierarchy.hpp"

namespace hurcules {

// the equality rows of the levels above, as far as they are independent
struct EqualityRows {
  explicit EqualityRows(Index unknowns) : space(unknowns) {}
  // takes the equality rows of level k too
  void add_level(const SolvedHierarchy& solved, int k);

  RowSpace space;
  std::vector<int> rows;  // of the table, as `space` has them
};

// a row that decides where x lies, and what decides the value that it has there
struct DecidingRow {
  enum class Target { Both, Lower, Upper, Present };  // Both: an equality; Present: a x_above
  int row = 0;
  Target target = Target::Both;
};

class LevelKktSystem {
 public:
  LevelKktSystem(const SolvedHierarchy& solved, int k, const EqualityRows& above);
  // in the directions B (n, n)
  LevelKktSystem(const SolvedHierarchy& solved, int k, const Matrix& basis);

  // v as it acts on t, B'v; and the step B t
  [[nodiscard]] Vector on_step(const Vector& v) const;
  [[nodiscard]] Vector step_in_x(const Vector& step) const;
  // the smallest t with  rho^2 t + V'(V t - right) + push + C'(..) = 0,  C t = 0
  [[nodiscard]] Vector step(const Vector& right, const Vector& push) const;
  // step is linear: the gradients in `right` (own) and `push` (n) of t_bar t
  struct StepGradient {
    Vector right, push;
  };
  [[nodiscard]] StepGradient step_transposed(const Vector& t_bar) const;

  double rho = 0.0;
  Vector x_above, x, t;                          // (n)
  Matrix B;                                      // (n, n), empty: I
  std::vector<DecidingRow> fixed, own, keeping;  // rows of C, V, W
  RowSpace C;
  Matrix V, W;   // (own, n), (keeping, n), as they act on t
  Vector e;      // (own), V x - b
  Vector mu, q;  // (fixed)
  Vector s;      // (keeping)
  Vector Vp;     // (own), V p
  // (n) in x, V'e + C'mu and V'V p + C'q + W's: what turns with B; zero without
  Vector force, force_of_step;
  Matrix W_inverse;  // (n, keeping), pseudo-inverse of W on the directions Z
  // V = U diag(sigma) Y' on what C leaves free, as far as sigma is above the rank tolerance; Z:
  // what neither C nor V sees
  Eigen::MatrixXd U, Y, Z;  // (own, rank), (n, rank), (n, rest)
  Vector sigma;             // (rank)

 private:
  void find(const SolvedHierarchy& solved, int k);
  void collect(const SolvedHierarchy& solved, int k);
  void collect_held(const SolvedHierarchy& solved, int k, const HeldRow& held);
  [[nodiscard]] Matrix stack(const SolvedHierarchy& solved,
                             const std::vector<DecidingRow>& rows) const;
  void decompose(const SolvedHierarchy& solved);
  void invert_keeping(const SolvedHierarchy& solved);
  void find_step(const SolvedHierarchy& solved);
  void refine_violation();
  void find_multipliers();
  void find_smallest_step_multipliers();
  void find_forces(const SolvedHierarchy& solved);
};

}  // namespace hurcules

// One solved level as a linear system: on the active piece x is a smooth function of the numbers of
// the hierarchy, and this is what it solves.
//
// t = x - x_above, C: the independent rows that keep a value (equality rows above, limits held
// against the violation), V: the level's equalities and violated rows, e = V x - b, W: rows that
// hold only the smallest step:
//     rho^2 t + V'e + C'mu = 0,   C t = d                                   [T 3.4.100-113]
// and for rho = 0 the smallest such t with W t = d_w:
//     t + V'(V p) + C'q + W's = 0,   C p = 0
#pragma once

#include <vector>

#include "hurcules/solver/row_space.hpp"
#include "hurcules/solver/solved_hierarchy.hpp"

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

class LevelPiece {
 public:
  LevelPiece(const SolvedHierarchy& solved, int k, const EqualityRows& above);

  // the smallest t with  rho^2 t + V'(V t - right) + force + C'(..) = 0,  C t = 0
  [[nodiscard]] Vector step(const Vector& right, const Vector& force) const;
  // step is linear: the gradients in `right` (own) and `force` (n) of t_bar t
  struct StepGradient {
    Vector right, force;
  };
  [[nodiscard]] StepGradient step_transposed(const Vector& t_bar) const;

  double rho = 0.0;
  Vector x_above, x;                             // (n)
  std::vector<DecidingRow> fixed, own, keeping;  // rows of C, V, W
  RowSpace C;
  Matrix C_rows, V, W;  // (fixed, n), (own, n), (keeping, n)
  Vector e;             // (own), V x - b
  Vector mu, q;         // (fixed)
  Vector s;             // (keeping)
  Vector Vp;            // (own), V p
  Matrix W_inverse;     // (n, keeping), pseudo-inverse of W on the directions Z
  // V = U diag(sigma) Y' on what C leaves free, as far as sigma is above the rank tolerance; Z:
  // what neither C nor V sees
  Eigen::MatrixXd U, Y, Z;  // (own, rank), (n, rank), (n, rest)
  Vector sigma;             // (rank)

 private:
  void collect(const SolvedHierarchy& solved, int k, const EqualityRows& above);
  void collect_held(const SolvedHierarchy& solved, int k, const HeldRow& held);
  void decompose();
  void refine_violation();
  void find_multipliers();
  void find_smallest_step_multipliers();
};

}  // namespace hurcules

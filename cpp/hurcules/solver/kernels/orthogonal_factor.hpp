// Orthonormal directions of a list of rows, in their order: rows = L Q, L lower trapezoidal.
//
// Built for all rows at once by modified Gram-Schmidt that takes each new direction out of all
// later rows; a row close to the span of those before is cleaned again until it stays. Rows can
// then be appended and removed one by one.
#pragma once

#include <vector>

#include "hurcules/solver/kernels/kernels.hpp"
#include "hurcules/solver/kernels/padded.hpp"

namespace hurcules {

class OrthogonalFactor {
 public:
  void reserve(Index rows, Index columns);

  // A new list of rows; all of row(i) is then filled by the caller, with zeros behind `columns`.
  void start(Index rows, Index columns);
  [[nodiscard]] double* row(Index i) { return rest_.row(i); }
  // Takes the directions of rows [first, end); later rows get their coordinates only. A row counts
  // as dependent when less than `tolerance` of its norm is left (norm2: squared norms, by row).
  // `side`: a column b that becomes g of L g = b, when no row depends on others; or null.
  // A row with less than the part `clean` of its squared norm left has lost digits: cleaned first.
  void run(Index first, Index end, const double* norm2, double tolerance, double* side = nullptr,
           double clean = kClean);
  // Entries of L of directions that came after a row of [first, end) become zero; `run` leaves
  // them as they are.
  void clear_unknown(Index first, Index end);

  // Appends the row that the caller put into row(rank()), where every row so far gave a direction.
  // False, and nothing is changed, when it depends on the others.
  bool append(double norm2, double tolerance);
  // removes a row where every row gave a direction; g of L g = b turns with it
  void remove(Index slot, double* g);
  // v minus its parts along all directions; the parts; what is left, squared
  double project(double* v, double* part, double norm2) const;
  // L g = b and L' m = b, in place, for square L. What balances to `noise` or less on the way
  // counts as nothing: divided by a short row it would not.
  void solve(double* b) const;
  void solve_transposed(double* b, double noise = 0.0) const;
  // multipliers = -L^-T g, the push of every row in y = Q' g; what is within rounding of the
  // largest of g counts as nothing on the way
  void find_multipliers(const double* g, double* multiplier) const;
  // moves y by the least that changes every row by its entry of `change`, which becomes the change
  // of g
  void correct(double* change, double* y) const;

  [[nodiscard]] Index rank() const { return rank_; }
  [[nodiscard]] Index columns() const { return columns_; }
  [[nodiscard]] Index stride() const { return Q_.stride(); }
  [[nodiscard]] const double* direction(Index j) const { return Q_.row(j); }
  // coordinates of row i; zero for directions that came after it, unless it was never a pivot
  [[nodiscard]] const double* coordinates(Index i) const { return L_.row(i); }
  [[nodiscard]] double* coordinates(Index i) { return L_.row(i); }
  // the row that gave direction j
  [[nodiscard]] Index pivot(Index j) const { return pivot_[j]; }
  // what is left of a row outside the span
  [[nodiscard]] const double* rest(Index i) const { return rest_.row(i); }
  // place for one more unit direction, of no row
  double* push_direction() { return Q_.row(rank_++); }

 private:
  static constexpr double kClean = 1e-2;

  // a row that lost digits, cleaned first
  void take_cleaned(Index i, double norm2, double tolerance, double* side);
  [[nodiscard]] Index pivots_before(Index row) const;

  PaddedRows rest_, Q_, L_;
  mutable PaddedVector part_;
  std::vector<Index> pivot_;  // kernels::Size is the same type
  Index rows_ = 0, columns_ = 0, rank_ = 0;
};

}  // namespace hurcules

// The space that a few rows span: C = L Q', with orthonormal Q and triangular L, grown row by row.
//
// For what is asked after a solve; the solve itself has the basis. Both drop a row by one rule.
#pragma once

#include <Eigen/Core>

#include "hurcules/base/types.hpp"

namespace hurcules {

class RowSpace {
 public:
  explicit RowSpace(Index unknowns) : Q_(unknowns, 0), L_(0, 0) {}

  // false when the row depends on those before it (tolerance::kRank); then it is not taken
  bool add(const Vector& row);
  [[nodiscard]] Index size() const { return Q_.cols(); }
  // the part of v (n) that no row sees
  [[nodiscard]] Vector free_part(const Vector& v) const;
  // an orthonormal basis of what no row sees, (n, n - size)
  [[nodiscard]] Eigen::MatrixXd free_basis() const;
  // the smallest v (n) with C v = h, h (size)
  [[nodiscard]] Vector solve(const Vector& h) const;
  // y (size) with C'y = v on the space of the rows
  [[nodiscard]] Vector solve_transposed(const Vector& v) const;

 private:
  Eigen::MatrixXd Q_;  // (n, size)
  Eigen::MatrixXd L_;  // (size, size), lower triangle
};

}  // namespace hurcules

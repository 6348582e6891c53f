// Singular values of the equality rows of one level in the directions that it was left, and their
// right singular vectors: Lk = U diag(sigma) V', by one-sided Jacobi rotations.
//
// Away from singularity a bound is enough, sigma_min >= 1 / |T^-1| with the triangle T of the
// pivot rows; the rotations are made only where somebody needs them.
#pragma once

#include <vector>

#include "hurcules/solver/kernels/padded.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules {

class LevelSvd {
 public:
  void reserve(Index unknowns, Index most_own);
  // level k in the directions of its basis; decomposes nothing yet
  void start(const RowTable& rows, const NullspaceBasis& nullspace, int level);

  // own directions q = columns of Lk
  [[nodiscard]] Index size() const { return own_; }
  // no singular value of Lk is below `bound`; may decompose
  [[nodiscard]] bool all_at_least(double bound);
  // the smallest of the min(m, free directions) singular values: 0 where rows depend on others
  [[nodiscard]] double smallest();
  // the smallest is not below `bound`
  [[nodiscard]] bool regular(double bound) { return !dependent_ && all_at_least(bound); }

  // Once decomposed:
  void decompose();
  [[nodiscard]] double sigma(Index i) const { return sigma_[i]; }
  [[nodiscard]] const double* right(Index i) const { return right_.row(i); }  // v_i, (q)
  [[nodiscard]] const double* image(Index i) const { return image_.row(i); }  // Lk v_i, (m)

 private:
  // 1 / |T^-1|, not above the smallest singular value
  [[nodiscard]] double bound_below();
  bool rotate(Index i, Index j);

  const RowTable* rows_ = nullptr;
  const NullspaceBasis* nullspace_ = nullptr;
  int level_ = 0;
  Index first_ = 0, own_ = 0, count_ = 0;  // directions from first_; equality rows
  bool dependent_ = false, decomposed_ = false;
  double bound_ = -1.0;  // bound_below, once it was asked for
  PaddedRows image_, right_;
  PaddedVector sigma_, inverse_;
};

}  // namespace hurcules

// Orthonormal directions of the space that rows of a hierarchy span.
//
// Each direction remembers the row that it was added for (its source), or has none.
#pragma once

#include <utility>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

class OrthonormalRows {
 public:
  using Source = std::pair<std::size_t, Index>;  // a level and its row

  // of n columns; makes the memory
  void resize(Index n);
  [[nodiscard]] Index rank() const { return rank_; }
  [[nodiscard]] bool full() const { return rank_ == directions_.rows(); }
  // keeps the first `rank` directions
  void truncate(Index rank) { rank_ = rank; }
  [[nodiscard]] auto direction(Index j) const { return directions_.row(j); }
  [[nodiscard]] const Source& source(Index j) const {
    return sources_[static_cast<std::size_t>(j)];
  }
  // takes from v (n) what lies in the space
  void remove_from(VectorRef v);
  // v (n) of length 1; what lies in the space already is no direction; v is scratch
  void add(VectorRef v, Source source);
  // the directions in which these rows reach `least` or more outside the space, the strongest that
  // is left first, without a source; returns what the weakest of them reaches, `none` without one.
  // rows (m, n) are scratch
  double add_rows(MatrixRef rows, double least, double none);

 private:
  Matrix directions_;  // (n, n), the first rank_ count
  std::vector<Source> sources_;
  Index rank_ = 0;
  Vector parts_;  // scratch (n)
};

}  // namespace hurcules

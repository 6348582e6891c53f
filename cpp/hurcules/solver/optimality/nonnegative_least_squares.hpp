// The forces of fixed directions that best balance a given one, each pushing or not at all:
//     min |b + sum_i y_i c_i|   over y >= 0.
//
// In long double, by the active set of Lawson and Hanson: the direction that shortens what is left
// fastest enters, those whose weight vanishes on the way leave. It ends after a number of rounds,
// with the best weights so far. Nothing allocates.
#pragma once

#include <vector>

#include "hurcules/solver/extended_precision/extended_precision_basis.hpp"

namespace hurcules {

class NonnegativeLeastSquares {
 public:
  using Long = long double;
  // of at most `rows` directions c of length `columns`
  void reserve(Index columns, Index rows);
  // no directions yet
  void start(Index columns);
  // the place of the next direction, of length one when it is filled
  [[nodiscard]] Long* place() { return &directions_[size_ * columns_]; }
  // what was put there counts
  void add() { ++size_; }
  // finds y for b (columns); a pull of `no_pull` or less counts as none
  void solve(const Long* b, Long no_pull = 0.0L);

  [[nodiscard]] Index size() const { return size_; }
  [[nodiscard]] Long weight(Index i) const { return weight_[i]; }
  // b + sum y_i c_i, (columns), and its length
  [[nodiscard]] const Long* rest() const { return rest_.data(); }
  [[nodiscard]] Long left() const { return left_; }

 private:
  enum class State : char { Out, In, Barred };

  [[nodiscard]] const Long* direction(Index i) const { return &directions_[i * columns_]; }
  // the direction that pulls most at what is left, and more than `no_pull`, or -1
  [[nodiscard]] Index most_pulling(Long no_pull) const;
  // takes a direction in; false when it depends on those that are
  bool enter(Index i);
  // to the best weights of what is in; a direction whose weight vanishes leaves; false when it is
  // `entered`, before anything moved
  bool settle(Index entered);
  void build_basis();
  void find_wanted();
  void find_rest();
  // the same from the weights
  void add_up();

  Index columns_ = 0, size_ = 0;
  const Long* b_ = nullptr;
  ExtendedPrecisionBasis basis_;  // of those that are in
  std::vector<Long> directions_, weight_, wanted_, rest_;
  std::vector<State> state_;
  Long left_ = 0.0L;
};

}  // namespace hurcules

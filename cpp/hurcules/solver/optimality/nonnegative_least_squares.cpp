#include "hurcules/solver/optimality/nonnegative_least_squares.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

using Long = long double;

// a pull that is rounding, relative to b
constexpr Long kLeastPull = 1e-18L;
// a direction of which less is outside the others depends on them
constexpr Long kDependent = 1e-15L;

// the part of the way from y >= 0 to `wanted` <= 0 after which nothing is left of y
Long way_to_nothing(Long y, Long wanted) {
  return y > 0.0L ? y / (y - wanted) : 0.0L;
}

}  // namespace

void NonnegativeLeastSquares::reserve(Index columns, Index rows) {
  const std::size_t width = static_cast<std::size_t>(columns);
  const std::size_t count = static_cast<std::size_t>(rows);
  directions_.resize(std::max(directions_.size(), (count + 1) * width));
  weight_.resize(std::max(weight_.size(), count));
  state_.resize(std::max(state_.size(), count));
  wanted_.resize(std::max(wanted_.size(), width));
  rest_.resize(std::max(rest_.size(), width));
  basis_.reserve(columns, columns);
}

void NonnegativeLeastSquares::start(Index columns) {
  columns_ = columns;
  size_ = 0;
}

void NonnegativeLeastSquares::solve(const Long* b, Long no_pull) {
  b_ = b;
  std::fill_n(weight_.begin(), size_, 0.0L);
  std::fill_n(state_.begin(), size_, State::Out);
  basis_.start(columns_);
  find_rest();
  const Index most = 3 * size_ + 30;
  for (Index round = 0; round < most; ++round) {
    const Index i = most_pulling(no_pull);
    if (i < 0) break;
    if (!enter(i) || !settle(i)) {
      // rounding: until something else helped it may not come in again
      state_[i] = State::Barred;
      build_basis();
      continue;
    }
    const Long before = left_;
    find_rest();
    if (left_ >= before) continue;
    for (Index j = 0; j < size_; ++j) {
      if (state_[j] == State::Barred) state_[j] = State::Out;
    }
  }
  add_up();
}

Index NonnegativeLeastSquares::most_pulling(Long no_pull) const {
  Long best = no_pull;
  for (Index j = 0; j < columns_; ++j) best += kLeastPull * std::abs(b_[j]);
  Index found = -1;
  for (Index i = 0; i < size_; ++i) {
    if (state_[i] != State::Out) continue;
    const Long* c = direction(i);
    Long pull = 0.0L;
    for (Index j = 0; j < columns_; ++j) pull -= c[j] * rest_[j];
    if (pull <= best) continue;
    best = pull;
    found = i;
  }
  return found;
}

bool NonnegativeLeastSquares::enter(Index i) {
  state_[i] = State::In;
  return basis_.add(direction(i), i, kDependent);
}

void NonnegativeLeastSquares::build_basis() {
  basis_.start(columns_);
  for (Index i = 0; i < size_; ++i) {
    if (state_[i] != State::In || basis_.add(direction(i), i, kDependent)) continue;
    state_[i] = State::Barred;
    weight_[i] = 0.0L;
  }
}

// L'y = -Q b over the directions of the basis
void NonnegativeLeastSquares::find_wanted() {
  for (Index j = 0; j < basis_.size(); ++j) wanted_[j] = -basis_.dot(j, b_);
  basis_.solve_transposed(basis_.size(), wanted_.data());
}

bool NonnegativeLeastSquares::settle(Index entered) {
  for (bool first = true;; first = false) {
    find_wanted();
    Long way = 1.0L;
    for (Index j = 0; j < basis_.size(); ++j) {
      if (wanted_[j] > 0.0L) continue;
      if (first && basis_.mark(j) == entered) return false;
      way = std::min(way, way_to_nothing(weight_[basis_.mark(j)], wanted_[j]));
    }
    bool left = false;
    for (Index j = 0; j < basis_.size(); ++j) {
      Long& y = weight_[basis_.mark(j)];
      const bool vanishes = wanted_[j] <= 0.0L && way_to_nothing(y, wanted_[j]) <= way;
      y += way * (wanted_[j] - y);
      if (!vanishes && y > 0.0L) continue;
      y = 0.0L;
      state_[basis_.mark(j)] = State::Out;
      left = true;
    }
    if (!left) return true;
    build_basis();
  }
}

// What is left at the best weights of those that are in, as what of b is outside them: their sum
// would round by the weights, which in a cone of 1e-8 rad are 1e8 times b, and hide the pulls.
void NonnegativeLeastSquares::find_rest() {
  left_ = basis_.remove(b_, rest_.data(), wanted_.data());
}

void NonnegativeLeastSquares::add_up() {
  std::copy_n(b_, columns_, rest_.begin());
  for (Index i = 0; i < size_; ++i) {
    const Long* c = direction(i);
    for (Index j = 0; j < columns_; ++j) rest_[j] += weight_[i] * c[j];
  }
  left_ = 0.0L;
  for (Index j = 0; j < columns_; ++j) left_ += rest_[j] * rest_[j];
  left_ = std::sqrt(left_);
}

}  // namespace hurcules

// The answer of the held rows of a careful level, and its multipliers.
#include <algorithm>
#include <cmath>

#include "hurcules/solver/careful_level.hpp"
#include "hurcules/solver/tolerances.hpp"
#include "hurcules/solver/triangularize.hpp"

namespace hurcules {

namespace {

// forces below this part of |a|^2 |x| are not told from rounding
constexpr double kLeastForce = 1e-3;
// what is left of a row that counts is rounding of its numbers: a tenth of what the quicker ways
// take for it (tolerance::kOwnRank), whose factors are in double, too
constexpr double kOwnRank = 1e-14;

using std::abs;

}  // namespace

template <class Scalar>
void CarefulLevel<Scalar>::add_state(State state) {
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    if (lines_[i].state == state) basis_.add(coordinates(i), i, Tolerances::kImplied);
  }
}

template <class Scalar>
void CarefulLevel<Scalar>::build_basis(State first) {
  basis_.start(free_);
  add_state(first);
  first_ = basis_.size();
  weakest_ = 1.0;
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    if (!counts(lines_[i])) continue;
    // a row that the levels below lose a direction to counts with all that limits leave of it
    const Scalar rounding = lines_[i].gave ? Scalar(Tolerances::kPivot) : Scalar(kOwnRank);
    const Scalar before = basis_.weakest();
    basis_.add(coordinates(i), i, std::min<Scalar>(tolerance::kRank, rounding / before));
    if (lines_[i].gave && basis_.weakest() < before) weakest_ = basis_.weakest();
  }
  if (first != State::Held) add_state(State::Held);
}

// least squares of the rows that count, in their directions
template <class Scalar>
void CarefulLevel<Scalar>::fill_block(Scalar rho) {
  const Index columns = basis_.size() - first_;
  Index count = 0;
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    if (!counts(lines_[i])) continue;
    for (Index j = 0; j < columns; ++j) {
      block_(count, j) = lines_[i].norm * basis_.dot(first_ + j, coordinates(i));
    }
    block_(count++, columns) = -lines_[i].norm * excess(i);
  }
  for (Index j = 0; rho > 0.0 && j < columns; ++j, ++count) {
    block_.row(count).head(columns + 1).setZero();
    block_(count, j) = rho;
    block_(count, columns) = -rho * basis_.dot(first_ + j, t_.data());
  }
  for (; count < columns; ++count) block_.row(count).head(columns + 1).setZero();
  triangularize(block_, count, columns);
}

template <class Scalar>
void CarefulLevel<Scalar>::step_to_violation(Scalar rho) {
  std::fill_n(p_.begin(), free_, 0.0);
  // regularised, what no row holds goes back to where it came from
  if (rho > 0.0) step_to_smallest();
  const Index columns = basis_.size() - first_;
  fill_block(rho);
  for (Index j = columns - 1; j >= 0; --j) {
    Scalar sum = block_(j, columns);
    for (Index l = j + 1; l < columns; ++l) sum -= block_(j, l) * z_[l];
    z_[j] = sum / block_(j, j);
    const Scalar* b = basis_.direction(first_ + j);
    for (Index c = 0; c < free_; ++c) p_[c] += z_[j] * b[c];
  }
}

template <class Scalar>
void CarefulLevel<Scalar>::move_back(Scalar rho) {
  for (Line& line : lines_) {
    line.lower += line.lower_moved;
    line.upper -= line.upper_moved;
    line.lower_moved = line.upper_moved = 0.0;
  }
  for (Index j = 0; j < first_; ++j) z_[j] = -excess(basis_.mark(j));
  basis_.solve(first_, z_.data());
  for (Index j = 0; j < first_; ++j) {
    const Scalar* b = basis_.direction(j);
    for (Index c = 0; c < free_; ++c) t_[c] += z_[j] * b[c];
  }
  step_to_violation(rho);
  for (Index c = 0; c < free_; ++c) t_[c] += p_[c];
}

template <class Scalar>
void CarefulLevel<Scalar>::step_to_smallest() {
  basis_.remove(t_.data(), p_.data(), z_.data());
  for (Index c = 0; c < free_; ++c) p_[c] = -p_[c];
}

template <class Scalar>
Scalar CarefulLevel<Scalar>::balance_violation(Scalar rho) {
  // what rounding in the violations makes
  const Scalar own = level_->own_norm();
  Scalar forces = kLeastForce * own * own * x_scale_;
  std::fill_n(force_.begin(), free_, 0.0);
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    lines_[i].multiplier = 0.0;
    if (!counts(lines_[i])) continue;
    const Scalar push = lines_[i].norm * lines_[i].norm * excess(i);
    forces += abs(push);
    for (Index c = 0; c < free_; ++c) force_[c] += push * coordinates(i)[c];
  }
  for (Index c = 0; c < free_; ++c) {
    force_[c] += rho * rho * t_[c];
    forces += rho * rho * abs(t_[c]);
  }
  for (Index j = 0; j < first_; ++j) z_[j] = -basis_.dot(j, force_.data());
  basis_.solve_transposed(first_, z_.data());
  for (Index j = 0; j < first_; ++j) lines_[basis_.mark(j)].multiplier = z_[j];
  return forces;
}

template <class Scalar>
void CarefulLevel<Scalar>::balance_step() {
  for (Line& line : lines_) line.pull = 0.0;
  for (Index j = 0; j < basis_.size(); ++j) z_[j] = -basis_.dot(j, t_.data());
  basis_.solve_transposed(basis_.size(), z_.data());
  for (Index j = 0; j < basis_.size(); ++j) lines_[basis_.mark(j)].pull = z_[j];
}

template <class Scalar>
void CarefulLevel<Scalar>::write(double* x) {
  std::copy_n(x_above_, rows_->stride(), x);
  for (Index j = 0; j < unknowns_; ++j) {
    Scalar sum = x_above_[j];
    for (Index c = 0; c < free_; ++c) {
      sum += t_[c] * direction(c)[j];
    }
    x[j] = static_cast<double>(sum);
  }
}

template <class Scalar>
void CarefulLevel<Scalar>::keep(bool settled, std::vector<HeldRow>& held, int& begin_norm) const {
  const auto push = [&](const Line& line, Scalar multiplier) {
    return static_cast<double>(static_cast<int>(line.side) * multiplier / line.norm);
  };
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    const Line& line = lines_[i];
    if (line.own && line.state == State::Violated) {
      const double violation = static_cast<double>(abs(excess(i)) * line.norm);
      held.push_back({line.row, line.side, violation, Role::Violation});
    } else if (!line.own && holds(line) && line.multiplier != 0.0) {
      held.push_back(
          {line.row, line.side, std::max(0.0, push(line, line.multiplier)), Role::Violation});
    }
  }
  begin_norm = static_cast<int>(held.size());
  for (Index j = 0; j < basis_.size(); ++j) {
    const Line& line = lines_[basis_.mark(j)];
    if (line.state == State::Equality) continue;
    const bool only = settled && line.state == State::Held;
    held.push_back(
        {line.row, line.side, push(line, line.pull), only ? Role::SmallestStep : Role::Idle});
  }
}

template class CarefulLevel<long double>;
template class CarefulLevel<Wide>;

}  // namespace hurcules

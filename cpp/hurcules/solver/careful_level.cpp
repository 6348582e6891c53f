#include "hurcules/solver/careful_level.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

// an own row counts where it did not so far when it is violated by as many times more, so that
// rounding does not swap
constexpr double kEnters = 10.0;

using std::abs;
using std::isinf;

double sign(Side side) {
  return static_cast<double>(static_cast<int>(side));
}

// places between 0 and 1, no two alike
double scattered(Index i) {
  const double golden = 0.6180339887498949 * static_cast<double>(i + 1);
  return golden - std::floor(golden);
}

}  // namespace

template <class Scalar>
void CarefulLevel<Scalar>::reserve(Index unknowns, Index rows) {
  const std::size_t n = static_cast<std::size_t>(unknowns);
  lines_.reserve(rows);
  if (coordinates_.size() < rows * n) coordinates_.resize(rows * n);
  basis_.reserve(unknowns, rows + unknowns);
  above_.reserve(unknowns, unknowns);
  directions_.resize(std::max(directions_.size(), n * n));
  for (std::vector<Scalar>* v : {&t_, &p_, &force_, &z_}) v->resize(std::max(v->size(), n + 1));
  if (block_.rows() < rows + unknowns || block_.cols() < unknowns + 1) {
    block_.resize(rows + unknowns, unknowns + 1);
  }
}

template <class Scalar>
void CarefulLevel<Scalar>::start(const RowTable& rows, const Chain& chain,
                                 const LevelProblem& level, const double* x_above, double x_scale) {
  rows_ = &rows;
  chain_ = &chain;
  level_ = &level;
  x_above_ = x_above;
  unknowns_ = rows.unknowns();
  free_ = level.free();
  x_scale_ = x_scale;
  lines_.clear();
  find_directions();
  for (int i = 0; i < rows.begin(level.level() + 1); ++i) add_line(i);
  std::fill(t_.begin(), t_.end(), 0.0);
  reach_ = 0.0;
}

// Those of the chain, cleaned of the rows above once more: in double they keep 1e-16 of them, which
// of a row that stands out by 1e-9 is 1e-7. Behind a hand-over they are what that made them.
template <class Scalar>
void CarefulLevel<Scalar>::find_directions() {
  const Index first = level_->first();
  const auto read = [&](const double* v, double length, Scalar* direction) {
    for (Index j = 0; j < unknowns_; ++j) direction[j] = Scalar(v[j]) / length;
  };
  for (Index c = 0; c < free_; ++c) {
    read(chain_->direction(first + c), 1.0, &directions_[c * unknowns_]);
  }
  if (!chain_->basis().whole()) return;
  above_.start(unknowns_);
  for (Index j = 0; j < first; ++j) {
    const int dense = static_cast<int>(chain_->pivot(j));
    read(rows_->dense_row(dense), rows_->dense_norms()[dense], p_.data());
    above_.add(p_.data(), j, 0.0);
  }
  for (Index c = 0; c < free_; ++c) {
    if (!above_.add(direction(c), first + c, 0.0)) continue;
    std::copy_n(above_.direction(above_.size() - 1), unknowns_, &directions_[c * unknowns_]);
  }
}

template <class Scalar>
bool CarefulLevel<Scalar>::gave_direction(const Row& row) const {
  const Index end = chain_->rank_before(level_->level() + 1);
  for (Index j = chain_->rank_before(level_->level()); j < end; ++j) {
    if (row.equality && chain_->pivot(j) == row.dense) return true;
  }
  return false;
}

template <class Scalar>
void CarefulLevel<Scalar>::add_line(int row) {
  const Row& r = (*rows_)[row];
  const bool own = r.level == level_->level();
  if (r.norm == 0.0 || (r.equality && !own)) return;
  const double* a = r.dense < 0 ? nullptr : rows_->dense_row(r.dense);
  const auto dot = [&](const auto* v) {
    if (!a) return Scalar(v[r.row]);
    Scalar sum = 0.0;
    for (Index j = 0; j < unknowns_; ++j) sum += Scalar(a[j]) * v[j];
    return sum;
  };
  Scalar* e = coordinates(static_cast<Index>(lines_.size()));
  Scalar size2 = 0.0;
  for (Index j = 0; j < free_; ++j) {
    e[j] = dot(direction(j)) / r.norm;
    size2 += e[j] * e[j];
  }
  if (!own && size2 <= tolerance::kLost * tolerance::kLost) return;
  const Scalar before = dot(x_above_);
  Line line = {.row = row,
               .own = own,
               .gave = own && gave_direction(r),
               .norm = r.norm,
               .lower = r.lower - before,
               .upper = r.upper - before,
               .lower_moved = 0.0,
               .upper_moved = 0.0,
               .state = State::Inside,
               .side = Side::Upper,
               .multiplier = 0.0,
               .pull = 0.0};
  line.lower /= line.norm;
  line.upper /= line.norm;
  const Scalar violated = Tolerances::kViolated * x_scale_;
  if (r.equality) {
    line.state = State::Equality;
  } else if (own && line.upper < -violated) {
    line.state = State::Violated;
  } else if (own && line.lower > violated) {
    line.state = State::Violated;
    line.side = Side::Lower;
  } else if (!own) {
    const Index place = static_cast<Index>(lines_.size());
    const Scalar apart = Tolerances::kApart * x_scale_;
    line.upper_moved = apart * (1.0 + scattered(2 * place));
    line.lower_moved = apart * (1.0 + scattered(2 * place + 1));
    line.upper = std::max<Scalar>(line.upper, 0.0) + line.upper_moved;
    line.lower = std::min<Scalar>(line.lower, 0.0) - line.lower_moved;
  }
  lines_.push_back(line);
}

template <class Scalar>
Scalar CarefulLevel<Scalar>::value(Index i) const {
  const Scalar* e = coordinates(i);
  Scalar sum = 0.0;
  for (Index j = 0; j < free_; ++j) sum += e[j] * t_[j];
  return sum;
}

template <class Scalar>
Scalar CarefulLevel<Scalar>::excess(Index i) const {
  return value(i) - (lines_[i].side == Side::Upper ? lines_[i].upper : lines_[i].lower);
}

template <class Scalar>
bool CarefulLevel<Scalar>::blocked(State own) {
  Scalar length = 0.0, way = 1.0, speed = 0.0;
  for (Index j = 0; j < free_; ++j) length = std::max(length, abs(p_[j]));
  if (length <= Tolerances::kNoStep * x_scale_) return false;
  Index found = -1;
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    const Line& line = lines_[i];
    if (line.state != State::Inside) continue;
    const Scalar* e = coordinates(i);
    Scalar moved = 0.0;
    for (Index j = 0; j < free_; ++j) moved += e[j] * p_[j];
    if (abs(moved) <= Tolerances::kBlocking * length) continue;
    const Scalar limit = moved > 0.0 ? line.upper : line.lower;
    if (isinf(limit)) continue;
    const Scalar part = std::max<Scalar>(0.0, (limit - value(i)) / moved);
    if (part > way || (part == way && abs(moved) <= speed) || part >= 1.0) continue;
    way = part;
    speed = abs(moved);
    found = i;
    lines_[i].side = moved > 0.0 ? Side::Upper : Side::Lower;
  }
  for (Index j = 0; j < free_; ++j) {
    t_[j] += way * p_[j];
    reach_ = std::max(reach_, abs(t_[j]));
  }
  x_scale_ = std::max(x_scale_, reach_);
  if (found < 0) return false;
  lines_[found].state = lines_[found].own ? own : State::Held;
  return true;
}

// own rows count where they are beyond a limit, on whichever side that is now
template <class Scalar>
bool CarefulLevel<Scalar>::revise_violated() {
  bool changed = false;
  const Scalar room = Tolerances::kViolated * reach_;
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    Line& line = lines_[i];
    if (!line.own || (line.state != State::Violated && line.state != State::Inside)) continue;
    const Scalar now = value(i);
    const bool counted = line.state == State::Violated;
    if (counted && sign(line.side) * excess(i) >= -room) continue;
    const bool over = now > line.upper + kEnters * room, under = now < line.lower - kEnters * room;
    if (!counted && !over && !under) continue;
    line.state = over || under ? State::Violated : State::Inside;
    line.side = under ? Side::Lower : Side::Upper;
    changed = true;
  }
  return changed;
}

template <class Scalar>
bool CarefulLevel<Scalar>::drop_worst(Scalar Line::* part, Scalar least) {
  Line* found = nullptr;
  for (Line& line : lines_) {
    if (line.state != State::Held || sign(line.side) * line.*part >= least) continue;
    least = sign(line.side) * line.*part;
    found = &line;
  }
  if (!found) return false;
  found->state = State::Inside;
  found->multiplier = found->pull = 0.0;
  return true;
}

// Grows tenfold when there were more rounds than rows and directions, so that rounding in a level
// on the edge of its digits cannot keep two rows swapping; the proof judges what comes of it.
template <class Scalar>
Scalar CarefulLevel<Scalar>::pull(Index round) const {
  return Tolerances::kPull * std::pow(10.0L, static_cast<long double>(round / rounds()));
}

template <class Scalar>
bool CarefulLevel<Scalar>::find_violation(Scalar rho, bool onto, Budget& budget) {
  for (Index round = 0; round < Tolerances::kLadder * rounds() && !budget.spent();
       ++round, ++budget.used) {
    build_basis(State::Held);
    step_to_violation(rho);
    if (blocked(State::Violated) || revise_violated()) continue;
    Scalar forces = balance_violation(rho);
    if (drop_worst(&Line::multiplier, -pull(round) * forces)) continue;
    if (onto) {
      move_back(rho);
      forces = balance_violation(rho);
    }
    if (rho == 0.0) settle(forces);
    return true;
  }
  return false;
}

template <class Scalar>
bool CarefulLevel<Scalar>::find_smallest(Budget& budget) {
  for (Index round = 0; round < Tolerances::kLadder * rounds() && !budget.spent();
       ++round, ++budget.used) {
    build_basis(State::Fixed);
    step_to_smallest();
    if (blocked(State::Held)) continue;
    balance_step();
    if (!drop_worst(&Line::pull, -pull(round) * x_scale_)) return true;
  }
  return false;
}

template <class Scalar>
void CarefulLevel<Scalar>::settle(Scalar forces) {
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    Line& line = lines_[i];
    if (line.state == State::Held &&
        sign(line.side) * line.multiplier > Tolerances::kFixed * forces) {
      line.state = State::Fixed;
    }
    // met to rounding: it may come inside, too
    if (line.state == State::Violated && abs(excess(i)) <= Tolerances::kMet * x_scale_) {
      line.state = State::Held;
    }
  }
}

template <class Scalar>
bool CarefulLevel<Scalar>::solve(double rho, bool onto, Budget& budget, double* x,
                                 std::vector<HeldRow>& held, int& begin_norm) {
  bool found = find_violation(rho, onto, budget);
  if (found && rho == 0.0) {
    found = find_smallest(budget);
  } else if (found) {
    balance_step();
  }
  write(x);
  if (found) keep(rho == 0.0, held, begin_norm);
  return found;
}

template class CarefulLevel<long double>;
template class CarefulLevel<Wide>;

}  // namespace hurcules

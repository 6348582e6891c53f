#include "hurcules/solver/extended_precision/extended_precision_active_set.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels/triangularize.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

using Long = long double;

// limits of rows above are moved outwards by this part of max(1, |x|), and up to twice as much
constexpr Long kApart = 1e-14L;
// an own row is violated beyond this part of the longest step so far: what rounds is its value, and
// in cones of 1e-8 rad violations of 1e-19 decide where x of 1e-3 goes
constexpr Long kViolated = 1e-17L;
// an own row counts where it did not so far when it is violated by as many times more, so that
// rounding does not swap
constexpr Long kEnters = 10.0L;
// a step that is rounding, relative to max(1, |x|)
constexpr Long kNoStep = 1e-17L;
// a multiplier pulls below this part of the forces, or of the step
constexpr Long kPull = 1e-16L;
// ... which grows so many times at most
constexpr Index kLadder = 16;
// a limit that pushes by more than this part of the forces stays where the violation is the
// smallest; the others may not move against it either, but that is found out
constexpr Long kFixed = 1e-8L;
// an own row is met to this part of max(1, |x|)
constexpr Long kMet = 1e-14L;
// a row that moves by less than this part of a step does not block it
constexpr Long kBlocking = 1e-13L;
// a held row that has less than this outside the rows before it is held by them
constexpr Long kImplied = 1e-12L;
// what is left of a row that counts is rounding of its numbers: a tenth of what the quicker
// strategies take for it (tolerance::kOwnRank), whose factors are in double, too
constexpr Long kOwnRank = 1e-14L;
// ... of an equality row that has a direction by the basis
constexpr Long kPivot = 1e-17L;

double sign(Side side) {
  return static_cast<double>(static_cast<int>(side));
}

// places between 0 and 1, no two alike
double scattered(Index i) {
  const double golden = 0.6180339887498949 * static_cast<double>(i + 1);
  return golden - std::floor(golden);
}

}  // namespace

void ExtendedPrecisionActiveSet::reserve(Index unknowns, Index rows) {
  const std::size_t n = static_cast<std::size_t>(unknowns);
  lines_.reserve(rows);
  if (coordinates_.size() < rows * n) coordinates_.resize(rows * n);
  basis_.reserve(unknowns, rows + unknowns);
  above_.reserve(unknowns, unknowns);
  directions_.resize(std::max(directions_.size(), n * n));
  for (std::vector<Long>* v : {&t_, &p_, &force_, &z_}) v->resize(std::max(v->size(), n + 1));
  if (block_.rows() < rows + unknowns || block_.cols() < unknowns + 1) {
    block_.resize(rows + unknowns, unknowns + 1);
  }
}

void ExtendedPrecisionActiveSet::start(const RowTable& rows, const NullspaceBasis& nullspace,
                                       const LevelProblem& level, const double* x_above,
                                       double x_scale) {
  rows_ = &rows;
  nullspace_ = &nullspace;
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

// Those of the basis, cleaned of the rows above once more: in double they keep 1e-16 of them, which
// of a row that stands out by 1e-9 is 1e-7. Behind a smooth transition they are what that made
// them.
void ExtendedPrecisionActiveSet::find_directions() {
  const Index first = level_->first();
  const auto read = [&](const double* v, double length, Long* direction) {
    for (Index j = 0; j < unknowns_; ++j) direction[j] = Long(v[j]) / length;
  };
  for (Index c = 0; c < free_; ++c) {
    read(nullspace_->direction(first + c), 1.0, &directions_[c * unknowns_]);
  }
  if (!nullspace_->weighted_basis().whole()) return;
  above_.start(unknowns_);
  for (Index j = 0; j < first; ++j) {
    const int dense = static_cast<int>(nullspace_->pivot(j));
    read(rows_->dense_row(dense), rows_->dense_norms()[dense], p_.data());
    above_.add(p_.data(), j, 0.0);
  }
  for (Index c = 0; c < free_; ++c) {
    if (!above_.add(direction(c), first + c, 0.0)) continue;
    std::copy_n(above_.direction(above_.size() - 1), unknowns_, &directions_[c * unknowns_]);
  }
}

bool ExtendedPrecisionActiveSet::gave_direction(const Row& row) const {
  const Index end = nullspace_->rank_before(level_->level() + 1);
  for (Index j = nullspace_->rank_before(level_->level()); j < end; ++j) {
    if (row.equality && nullspace_->pivot(j) == row.dense) return true;
  }
  return false;
}

void ExtendedPrecisionActiveSet::add_line(int row) {
  const Row& r = (*rows_)[row];
  const bool own = r.level == level_->level();
  if (r.norm == 0.0 || (r.equality && !own)) return;
  const double* a = r.dense < 0 ? nullptr : rows_->dense_row(r.dense);
  const auto dot = [&](const auto* v) {
    if (!a) return Long(v[r.row]);
    Long sum = 0.0;
    for (Index j = 0; j < unknowns_; ++j) sum += Long(a[j]) * v[j];
    return sum;
  };
  Long* e = coordinates(static_cast<Index>(lines_.size()));
  Long size2 = 0.0;
  for (Index j = 0; j < free_; ++j) {
    e[j] = dot(direction(j)) / r.norm;
    size2 += e[j] * e[j];
  }
  if (!own && size2 <= tolerance::kLost * tolerance::kLost) return;
  const Long before = dot(x_above_);
  Line line = {.row = row,
               .own = own,
               .gave = own && gave_direction(r),
               .norm = r.norm,
               .lower = r.lower - before,
               .upper = r.upper - before,
               .state = State::Inside,
               .side = Side::Upper,
               .multiplier = 0.0,
               .pull = 0.0};
  line.lower /= line.norm;
  line.upper /= line.norm;
  const Long violated = kViolated * x_scale_;
  if (r.equality) {
    line.state = State::Equality;
  } else if (own && line.upper < -violated) {
    line.state = State::Violated;
  } else if (own && line.lower > violated) {
    line.state = State::Violated;
    line.side = Side::Lower;
  } else if (!own) {
    const Index place = static_cast<Index>(lines_.size());
    const Long apart = kApart * x_scale_;
    line.upper = std::max<Long>(line.upper, 0.0) + apart * (1.0 + scattered(2 * place));
    line.lower = std::min<Long>(line.lower, 0.0) - apart * (1.0 + scattered(2 * place + 1));
  }
  lines_.push_back(line);
}

Long ExtendedPrecisionActiveSet::value(Index i) const {
  const Long* e = coordinates(i);
  Long sum = 0.0;
  for (Index j = 0; j < free_; ++j) sum += e[j] * t_[j];
  return sum;
}

Long ExtendedPrecisionActiveSet::excess(Index i) const {
  return value(i) - (lines_[i].side == Side::Upper ? lines_[i].upper : lines_[i].lower);
}

void ExtendedPrecisionActiveSet::add_state(State state) {
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    if (lines_[i].state == state) basis_.add(coordinates(i), i, kImplied);
  }
}

void ExtendedPrecisionActiveSet::build_basis(State first) {
  basis_.start(free_);
  add_state(first);
  first_ = basis_.size();
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    if (!counts(lines_[i])) continue;
    // a row that the levels below lose a direction to counts with all that limits leave of it
    const Long rounding = lines_[i].gave ? kPivot : kOwnRank;
    const Long before = basis_.weakest();
    basis_.add(coordinates(i), i, std::min<Long>(tolerance::kRank, rounding / before));
  }
  if (first != State::Held) add_state(State::Held);
}

// least squares of the rows that count, in their directions
void ExtendedPrecisionActiveSet::fill_block(Long rho) {
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

void ExtendedPrecisionActiveSet::step_to_violation(Long rho) {
  std::fill_n(p_.begin(), free_, 0.0);
  // regularised, what no row holds goes back to where it came from
  if (rho > 0.0) step_to_smallest();
  const Index columns = basis_.size() - first_;
  fill_block(rho);
  for (Index j = columns - 1; j >= 0; --j) {
    Long sum = block_(j, columns);
    for (Index l = j + 1; l < columns; ++l) sum -= block_(j, l) * z_[l];
    z_[j] = sum / block_(j, j);
    const Long* b = basis_.direction(first_ + j);
    for (Index c = 0; c < free_; ++c) p_[c] += z_[j] * b[c];
  }
}

void ExtendedPrecisionActiveSet::step_to_smallest() {
  basis_.remove(t_.data(), p_.data(), z_.data());
  for (Index c = 0; c < free_; ++c) p_[c] = -p_[c];
}

Long ExtendedPrecisionActiveSet::balance_violation(Long rho) {
  // what rounding in the violations makes
  const Long own = level_->own_norm();
  Long forces = tolerance::kLeastForce * own * own * x_scale_;
  std::fill_n(force_.begin(), free_, 0.0);
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    lines_[i].multiplier = 0.0;
    if (!counts(lines_[i])) continue;
    const Long push = lines_[i].norm * lines_[i].norm * excess(i);
    forces += std::abs(push);
    for (Index c = 0; c < free_; ++c) force_[c] += push * coordinates(i)[c];
  }
  for (Index c = 0; c < free_; ++c) {
    force_[c] += rho * rho * t_[c];
    forces += rho * rho * std::abs(t_[c]);
  }
  for (Index j = 0; j < first_; ++j) z_[j] = -basis_.dot(j, force_.data());
  basis_.solve_transposed(first_, z_.data());
  for (Index j = 0; j < first_; ++j) lines_[basis_.mark(j)].multiplier = z_[j];
  return forces;
}

void ExtendedPrecisionActiveSet::balance_step() {
  for (Line& line : lines_) line.pull = 0.0;
  for (Index j = 0; j < basis_.size(); ++j) z_[j] = -basis_.dot(j, t_.data());
  basis_.solve_transposed(basis_.size(), z_.data());
  for (Index j = 0; j < basis_.size(); ++j) lines_[basis_.mark(j)].pull = z_[j];
}

bool ExtendedPrecisionActiveSet::blocked(State own) {
  Long length = 0.0, way = 1.0, speed = 0.0;
  for (Index j = 0; j < free_; ++j) length = std::max(length, std::abs(p_[j]));
  if (length <= kNoStep * x_scale_) return false;
  Index found = -1;
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    const Line& line = lines_[i];
    if (line.state != State::Inside) continue;
    const Long* e = coordinates(i);
    Long moved = 0.0;
    for (Index j = 0; j < free_; ++j) moved += e[j] * p_[j];
    if (std::abs(moved) <= kBlocking * length) continue;
    const Long limit = moved > 0.0 ? line.upper : line.lower;
    if (std::isinf(limit)) continue;
    const Long part = std::max<Long>(0.0, (limit - value(i)) / moved);
    if (part > way || (part == way && std::abs(moved) <= speed) || part >= 1.0) continue;
    way = part;
    speed = std::abs(moved);
    found = i;
    lines_[i].side = moved > 0.0 ? Side::Upper : Side::Lower;
  }
  for (Index j = 0; j < free_; ++j) {
    t_[j] += way * p_[j];
    reach_ = std::max(reach_, std::abs(t_[j]));
  }
  x_scale_ = std::max(x_scale_, reach_);
  if (found < 0) return false;
  lines_[found].state = lines_[found].own ? own : State::Held;
  return true;
}

// own rows count where they are beyond a limit, on whichever side that is now
bool ExtendedPrecisionActiveSet::revise_violated() {
  bool changed = false;
  const Long room = kViolated * reach_;
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    Line& line = lines_[i];
    if (!line.own || (line.state != State::Violated && line.state != State::Inside)) continue;
    const Long now = value(i);
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

bool ExtendedPrecisionActiveSet::drop_worst(Long Line::*part, Long least) {
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
Long ExtendedPrecisionActiveSet::pull(Index round) const {
  return kPull * std::pow(10.0L, static_cast<long double>(round / rounds()));
}

bool ExtendedPrecisionActiveSet::find_violation(Long rho, Budget& budget) {
  for (Index round = 0; round < kLadder * rounds() && !budget.spent(); ++round, ++budget.used) {
    build_basis(State::Held);
    step_to_violation(rho);
    if (blocked(State::Violated) || revise_violated()) continue;
    const Long forces = balance_violation(rho);
    if (drop_worst(&Line::multiplier, -pull(round) * forces)) continue;
    if (rho == 0.0) settle(forces);
    return true;
  }
  return false;
}

bool ExtendedPrecisionActiveSet::find_smallest(Budget& budget) {
  for (Index round = 0; round < kLadder * rounds() && !budget.spent(); ++round, ++budget.used) {
    build_basis(State::Fixed);
    step_to_smallest();
    if (blocked(State::Held)) continue;
    balance_step();
    if (!drop_worst(&Line::pull, -pull(round) * x_scale_)) return true;
  }
  return false;
}

void ExtendedPrecisionActiveSet::settle(Long forces) {
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    Line& line = lines_[i];
    if (line.state == State::Held && sign(line.side) * line.multiplier > kFixed * forces) {
      line.state = State::Fixed;
    }
    // met to rounding: it may come inside, too
    if (line.state == State::Violated && std::abs(excess(i)) <= kMet * x_scale_) {
      line.state = State::Held;
    }
  }
}

void ExtendedPrecisionActiveSet::write(double* x) {
  std::copy_n(x_above_, rows_->stride(), x);
  for (Index j = 0; j < unknowns_; ++j) {
    Long sum = x_above_[j];
    for (Index c = 0; c < free_; ++c) {
      sum += t_[c] * direction(c)[j];
    }
    x[j] = static_cast<double>(sum);
  }
}

void ExtendedPrecisionActiveSet::keep(bool settled, std::vector<HeldRow>& held,
                                      int& begin_norm) const {
  const auto push = [&](const Line& line, Long multiplier) {
    return static_cast<double>(static_cast<int>(line.side) * multiplier / line.norm);
  };
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    const Line& line = lines_[i];
    if (line.own && line.state == State::Violated) {
      const double violation = static_cast<double>(std::abs(excess(i)) * line.norm);
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

bool ExtendedPrecisionActiveSet::solve(double rho, Budget& budget, double* x,
                                       std::vector<HeldRow>& held, int& begin_norm) {
  bool found = find_violation(rho, budget);
  if (found && rho == 0.0) {
    found = find_smallest(budget);
  } else if (found) {
    balance_step();
  }
  write(x);
  if (found) keep(rho == 0.0, held, begin_norm);
  return found;
}

}  // namespace hurcules

#include "hurcules/solver/careful_level.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

using Long = long double;

// limits of rows above are moved outwards by this part of max(1, |x|), and up to twice as much
constexpr Long kApart = 1e-14L;
// an own row is violated beyond this part of the longest step so far: what rounds is its value,
// and in cones of 1e-8 rad violations of 1e-19 decide where x of 1e-3 goes
constexpr Long kViolated = 1e-17L;
// ... and where it did not count so far beyond as many times more, so that rounding does not swap
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
// an own row is met to this part of max(1, abs x)
constexpr Long kMet = 1e-14L;
// a row that moves by less than this part of a step does not block it
constexpr Long kBlocking = 1e-13L;

Long sign(Side side) {
  return static_cast<Long>(static_cast<int>(side));
}

// places between 0 and 1, no two alike
Long scattered(Index i) {
  const double golden = 0.6180339887498949 * static_cast<double>(i + 1);
  return static_cast<Long>(golden - std::floor(golden));
}

}  // namespace

void CarefulLevel::reserve(Index unknowns, Index rows) {
  const std::size_t n = static_cast<std::size_t>(unknowns);
  lines_.reserve(rows);
  if (coordinates_.size() < rows * n) coordinates_.resize(rows * n);
  basis_.reserve(unknowns, rows + unknowns);
  for (std::vector<Long>* v : {&t_, &p_, &force_, &z_}) v->resize(std::max(v->size(), n + 1));
  if (block_.rows() < rows + unknowns || block_.cols() < unknowns + 1) {
    block_.resize(rows + unknowns, unknowns + 1);
  }
}

void CarefulLevel::start(const RowTable& rows, const Chain& chain, const LevelProblem& level,
                         const double* x_above, double x_scale) {
  rows_ = &rows;
  chain_ = &chain;
  level_ = &level;
  x_above_ = x_above;
  free_ = level.free();
  x_scale_ = x_scale;
  lines_.clear();
  for (int i = 0; i < rows.begin(level.level() + 1); ++i) add_line(i);
  std::fill(t_.begin(), t_.end(), 0.0L);
  reach_ = 0.0L;
}

void CarefulLevel::add_line(int row) {
  const Row& r = (*rows_)[row];
  const bool own = r.level == level_->level();
  if (r.norm == 0.0 || (r.equality && !own)) return;
  const double* a = r.dense < 0 ? nullptr : rows_->dense_row(r.dense);
  const auto dot = [&](const double* v) {
    if (!a) return static_cast<Long>(v[r.row]);
    Long sum = 0.0L;
    for (Index j = 0; j < rows_->unknowns(); ++j) sum += static_cast<Long>(a[j]) * v[j];
    return sum;
  };
  Long* e = coordinates(static_cast<Index>(lines_.size()));
  Long size2 = 0.0L;
  for (Index j = 0; j < free_; ++j) {
    e[j] = dot(chain_->direction(level_->first() + j)) / r.norm;
    size2 += e[j] * e[j];
  }
  if (!own && size2 <= tolerance::kLost * tolerance::kLost) return;
  const Long before = dot(x_above_);
  Line line = {.row = row,
               .own = own,
               .norm = r.norm,
               .lower = r.lower - before,
               .upper = r.upper - before,
               .lower_moved = 0.0L,
               .upper_moved = 0.0L,
               .state = State::Inside,
               .side = Side::Upper,
               .multiplier = 0.0L,
               .pull = 0.0L};
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
    line.upper_moved = apart * (1.0L + scattered(2 * place));
    line.lower_moved = apart * (1.0L + scattered(2 * place + 1));
    line.upper = std::max(line.upper, 0.0L) + line.upper_moved;
    line.lower = std::min(line.lower, 0.0L) - line.lower_moved;
  }
  lines_.push_back(line);
}

Long CarefulLevel::value(Index i) const {
  const Long* e = coordinates(i);
  Long sum = 0.0L;
  for (Index j = 0; j < free_; ++j) sum += e[j] * t_[j];
  return sum;
}

Long CarefulLevel::excess(Index i) const {
  return value(i) - (lines_[i].side == Side::Upper ? lines_[i].upper : lines_[i].lower);
}

bool CarefulLevel::blocked(State own) {
  Long length = 0.0L, way = 1.0L, speed = 0.0L;
  for (Index j = 0; j < free_; ++j) length = std::max(length, std::abs(p_[j]));
  if (length <= kNoStep * x_scale_) return false;
  Index found = -1;
  for (Index i = 0; i < static_cast<Index>(lines_.size()); ++i) {
    const Line& line = lines_[i];
    if (line.state != State::Inside) continue;
    const Long* e = coordinates(i);
    Long moved = 0.0L;
    for (Index j = 0; j < free_; ++j) moved += e[j] * p_[j];
    if (std::abs(moved) <= kBlocking * length) continue;
    const Long limit = moved > 0.0L ? line.upper : line.lower;
    if (std::isinf(limit)) continue;
    const Long part = std::max(0.0L, (limit - value(i)) / moved);
    if (part > way || (part == way && std::abs(moved) <= speed) || part >= 1.0L) continue;
    way = part;
    speed = std::abs(moved);
    found = i;
    lines_[i].side = moved > 0.0L ? Side::Upper : Side::Lower;
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
bool CarefulLevel::revise_violated() {
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

bool CarefulLevel::drop_worst(Long Line::* part, Long least) {
  Line* found = nullptr;
  for (Line& line : lines_) {
    if (line.state != State::Held || sign(line.side) * line.*part >= least) continue;
    least = sign(line.side) * line.*part;
    found = &line;
  }
  if (!found) return false;
  found->state = State::Inside;
  found->multiplier = found->pull = 0.0L;
  return true;
}

// Grows tenfold when there were more rounds than rows and directions, so that rounding in a level
// on the edge of its digits cannot keep two rows swapping; the proof judges what comes of it.
Long CarefulLevel::pull(Index round) const {
  return kPull * std::pow(10.0L, static_cast<Long>(round / rounds()));
}

bool CarefulLevel::find_violation(Long rho, bool onto, Budget& budget) {
  for (Index round = 0; round < kLadder * rounds() && !budget.spent(); ++round, ++budget.used) {
    build_basis(State::Held);
    step_to_violation(rho);
    if (blocked(State::Violated) || revise_violated()) continue;
    Long forces = balance_violation(rho);
    if (drop_worst(&Line::multiplier, -pull(round) * forces)) continue;
    if (onto) {
      move_back(rho);
      forces = balance_violation(rho);
    }
    if (rho == 0.0L) settle(forces);
    return true;
  }
  return false;
}

bool CarefulLevel::find_smallest(Budget& budget) {
  for (Index round = 0; round < kLadder * rounds() && !budget.spent(); ++round, ++budget.used) {
    build_basis(State::Fixed);
    step_to_smallest();
    if (blocked(State::Held)) continue;
    balance_step();
    if (!drop_worst(&Line::pull, -pull(round) * x_scale_)) return true;
  }
  return false;
}

void CarefulLevel::settle(Long forces) {
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

bool CarefulLevel::solve(double rho, bool onto, Budget& budget, double* x,
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

}  // namespace hurcules

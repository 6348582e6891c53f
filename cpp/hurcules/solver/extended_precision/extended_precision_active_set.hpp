// A level solved with care instead of haste: the last strategy, when a quicker one does not prove
// itself.
//
// In long double (19 digits on x86-64), from where the levels above ended, which every limit of
// theirs allows exactly: first the smallest violation, then, without regularisation, the smallest
// step with that violation. Each is a primal active set that is feasible and falls all along. The
// limits of rows above are moved outwards by different amounts of about 1e-14, so that no more of
// them meet in a point than there are directions: then every step has a length, the objective falls
// with each, and no set of held limits returns.
#pragma once

#include <vector>

#include "hurcules/solver/extended_precision/extended_precision_basis.hpp"
#include "hurcules/solver/level/budget.hpp"
#include "hurcules/solver/level/level_problem.hpp"
#include "hurcules/solver/optimality/optimality.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"

namespace hurcules {

class ExtendedPrecisionActiveSet {
 public:
  void reserve(Index unknowns, Index rows);
  // a level from x_above, of size x_scale
  void start(const RowTable& rows, const NullspaceBasis& nullspace, const LevelProblem& level,
             const double* x_above, double x_scale);
  // To the answer x; then `held` has its rows (those of the smallest step from begin_norm on).
  // False when it does not get there; x is the best point so far.
  bool solve(double rho, Budget& budget, double* x, std::vector<HeldRow>& held, int& begin_norm);

 private:
  using Long = long double;
  using Block = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
  enum class State : char {
    Equality,  // own, always part of the violation
    Inside,
    Violated,  // own inequality row that takes part in the violation
    Held,      // stands at its limit
    Fixed,     // the same, for good
  };
  struct Line {
    int row;    // in the table
    bool own;   // its violation counts
    bool gave;  // an equality that gave the basis a direction
    Long norm;  // |a|; coordinates and limits of rows are divided by it
    Long lower, upper;
    State state;
    Side side;
    Long multiplier;  // against the violations
    Long pull;        // against the step
  };

  void find_directions();
  // a free direction, as a step of x
  [[nodiscard]] const Long* direction(Index c) const { return &directions_[c * unknowns_]; }
  // an own equality row that the levels below lose a direction to
  [[nodiscard]] bool gave_direction(const Row& row) const;
  void add_line(int row);
  [[nodiscard]] Long* coordinates(Index i) { return &coordinates_[i * free_]; }
  [[nodiscard]] const Long* coordinates(Index i) const { return &coordinates_[i * free_]; }
  [[nodiscard]] Long value(Index i) const;   // of a line at t_
  [[nodiscard]] Long excess(Index i) const;  // of a row that counts, beyond its limit, signed
  [[nodiscard]] bool holds(const Line& line) const {
    return line.state == State::Held || line.state == State::Fixed;
  }
  [[nodiscard]] bool counts(const Line& line) const {
    return line.state == State::Equality || line.state == State::Violated;
  }

  bool find_violation(Long rho, Budget& budget);
  bool find_smallest(Budget& budget);
  // directions of `first` rows, of the rows that count, and of held rows unless they came first
  void build_basis(State first);
  void add_state(State state);
  void step_to_violation(Long rho);
  void fill_block(Long rho);
  void step_to_smallest();
  // moves along p_ until a row is in the way, which becomes `own` or Held then
  bool blocked(State own);
  bool revise_violated();
  // multipliers of the held rows against the violations; returns the size of the forces
  Long balance_violation(Long rho);
  // of all rows of the basis against the step
  void balance_step();
  [[nodiscard]] Long pull(Index round) const;
  [[nodiscard]] Index rounds() const { return 2 * (free_ + static_cast<Index>(lines_.size()) + 1); }
  // lets the held row go that pulls most, by what `part` says
  bool drop_worst(Long Line::*part, Long least);
  // what may not change any more once the violation is the smallest
  void settle(Long forces);
  void write(double* x);
  void keep(bool settled, std::vector<HeldRow>& held, int& begin_norm) const;

  const RowTable* rows_ = nullptr;
  const NullspaceBasis* nullspace_ = nullptr;
  const LevelProblem* level_ = nullptr;
  const double* x_above_ = nullptr;
  Index unknowns_ = 0, free_ = 0;
  Long x_scale_ = 1.0;  // what rounding in x is relative to: the largest x so far
  Long reach_ = 0.0;    // the largest |t| so far
  std::vector<Line> lines_;
  std::vector<Long> coordinates_;  // (lines, free)
  ExtendedPrecisionBasis above_;   // of equality rows above, then of directions that are free
  std::vector<Long> directions_;   // (free, unknowns)
  ExtendedPrecisionBasis basis_;
  Index first_ = 0;  // directions of the basis before those of rows that count
  std::vector<Long> t_, p_, force_, z_;
  Block block_;
};

}  // namespace hurcules

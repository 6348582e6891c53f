// Where a level that cannot arrive stops pulling.
//
// An unreachable level ends where its equality rows A lose rank on the joints that are free: the
// strict rule hands the direction that they lose to the levels below, which turn there the faster
// the nearer it is: no acceleration limit and no period is small enough, and the robot swings. So a
// level stops a little before, where going on would win next to nothing:
//
//   p = P A'y                         P: projection on what the equality rows above leave, and
//                                     away from joints that p would press against their limits:
//                                     in full at a limit, not at all from 0.02 rad before it on;
//                                     and away from inequality rows above, likewise: in full where
//                                     they let it come no nearer, not at all from 0.3 rad/s on
//   slope = |p| / (|y| S)             S: largest column of A; what a rad wins, as a share of the
//                                     most that a joint of this level could win; 0 to about 1.
//                                     A point along some axes alone: the largest of all three, for
//                                     where such rows end they vanish, and so would S
//   y <- y max(0, 1 - eps z / slope)  z: 0 at the target, 1 from 10 mm or 0.02 rad on (w = 0.1)
// At a saddle (saddle_probe.hpp) there is no zone: with
//   d = (y'(dA/dh u + A b) - k |A u|^2) / (|y| S)    growth of the pull along u, which p moves weakly
//       [1/rad]; dA/dh u: drift of the rows at qdot = u; b: what keeps the rows above as they are,
//       A_above b = -dA_above/dh u, and joints that are held (without it the way leaves their curve,
//       and ends look like saddles)
// it fades from d = 0.025 on and is gone at 0.075, but not below a level that is not met. Exactly at
// one p is nothing: then the level is sent off, along what its rows leave of a coordinate whose d is
// large enough.
//
// The rows stay: y = 0 still keeps the levels below from driving them. Where a row moves what is free
// by less than eps S, those below are slowed by that share: the strict rule turns them there by
// v_low c / sigma per rad, and they never rest. A level below one that is not met wants a larger
// zone (its own place moves with theirs): eps goes from `kZone` to `kZoneBelow` with the largest w
// above. Both were fitted: to robots and conflicts of docs/control.md. A first level whose rows
// stand apart loses no rank, and has no zone.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "hurcules/control/orthonormal_rows.hpp"
#include "hurcules/control/saddle_probe.hpp"
#include "hurcules/control/stack.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules {

class DeadZone {
 public:
  static constexpr double kZone = 0.02, kZoneBelow = 0.1;

  // n coordinates; makes the memory
  void set_stack(const Stack& stack, Index n);
  // shortens what the equality rows of each level ask for (lower = upper), as rates [unit/s];
  // weights: w a level (task_speed.hpp), gains: K / max(1, F) [1/s]; limits: of the coordinates,
  // measured, null for none; probe: looks at
  // where the robot stands, null for saddles like any other place
  void apply(std::span<const double> weights, std::span<const double> gains,
             const JointLimits* limits, SaddleProbe* probe, Hierarchy& hierarchy);
  // [rad/s] (n), on top of what the hierarchy asks for: off a saddle, else 0
  [[nodiscard]] const Vector& nudge() const { return nudge_; }
  // what a level was left at the last apply, 0 to 1
  [[nodiscard]] double share(std::size_t level) const { return shares_[level]; }
  // -1, 0, 1: a level that was shortened stands at the lower, no, the upper limit of a coordinate
  [[nodiscard]] int pressed(std::size_t level, Index coordinate) const {
    return pressed_(static_cast<Index>(level), coordinate);
  }

  // rows of levels above, by level and row, that keep a level from where it pulls
  [[nodiscard]] const std::vector<OrthonormalRows::Source>& pressed_rows(std::size_t level) const {
    return pressed_rows_[level];
  }

  // adds the coordinates that levels are held at: -1, 0, 1 each (n), where there is none yet
  void add_held(Eigen::VectorXi& held) const;

 private:
  // the level of a direction that a joint at its limit takes, instead of a row
  static constexpr std::size_t kJoint = std::numeric_limits<std::size_t>::max();

  // the slope of a level; leaves its pull
  [[nodiscard]] double slope_of(std::size_t k, const Hierarchy& hierarchy,
                                const JointLimits* limits);
  // 1 where the level whose pull is known stands at a saddle, 0 where not; nudges it off one
  [[nodiscard]] double saddle_at(std::size_t k, const Hierarchy& hierarchy, double gain,
                                 SaddleProbe& probe);
  // the same along off_; kept: how many of the known directions stay as they are
  [[nodiscard]] double saddle_along(std::size_t k, const Hierarchy& hierarchy, Index kept,
                                    double gain, SaddleProbe& probe);
  void keep_held();
  double add_rows(const Level& level, double least);
  void find_pull(const Level& level, const std::vector<const Task*>& tasks);
  void hold_pressed_joints(std::size_t k, const JointLimits& limits);
  // those of level `above` that keep level k
  void hold_pressed_rows(std::size_t k, std::size_t above, const Level& level);
  void hold_direction(double share, OrthonormalRows::Source from);

  OrthonormalRows known_;  // what the equality rows above move in
  Matrix held_;            // (n, n): orthonormal rows that limits hold, the first held_count_ count
  Vector held_shares_;     // (n): how much of each, 0 to 1
  std::vector<OrthonormalRows::Source> held_sources_;  // of each
  Index held_count_ = 0;
  Vector pull_;                       // p (n)
  Vector direction_;                  // scratch (n)
  Vector nudge_, off_;                // (n); off_: scratch
  Matrix left_;                       // scratch (rows, n)
  double asked_ = 0.0, lever_ = 0.0;  // |y|, S
  std::vector<double> shares_;
  std::vector<std::vector<const Task*>> tasks_;  // of each level
  std::vector<bool> apart_;                      // levels whose rows stand apart
  // rows of a level whose limits say how near something is, not how fast velocities may change
  std::vector<std::vector<bool>> nearness_;
  Eigen::MatrixXi pressed_;  // (levels, n)
  std::vector<std::vector<OrthonormalRows::Source>> pressed_rows_;
};

}  // namespace hurcules

// One set of problems, solved in every way that the benchmark tells apart:
//
//   cold    working sets forgotten before each solve
//   warm    the same problem again
//   jump    warm, but the targets are those of 0.3 s later: the working sets no longer fit
//   tick    the next millisecond of a motion, 4 motions; the levels and their targets move
//
// The time of a problem or tick is the least of several rounds; medians and p99 are over the
// problems or ticks. Allocations are counted over all solves but the first of the solver.
#pragma once

#include <string>
#include <vector>

#include "allocations.hpp"
#include "bare_chain.hpp"
#include "hurcules/solver/solver.hpp"
#include "measure.hpp"
#include "robot_problems.hpp"

namespace hurcules_benchmark {

struct Effort {
  int problems = 200, ticks = 500, rounds = 5;
  bool json = false;
};

struct Figures {
  std::string set;
  Shape shape;
  double rho = 0.0;
  Quantiles chain, floor, cold, warm, jump, tick;
  double changes = 0.0, changed_ticks = 0.0;  // mean of a cold solve; share of ticks
  int unsolved = 0;                           // solves that ended with another status than Solved
  std::size_t allocations = 0;
};

class SolverCase {
 public:
  SolverCase(const Shape& shape, Conflict conflict, double rho, const Effort& effort)
      : conflict_(conflict), effort_(effort), solver_(shape.unknowns) {
    figures_.set = name(conflict);
    figures_.shape = shape;
    figures_.rho = rho;
    const auto count = static_cast<std::size_t>(effort.problems);
    for (std::size_t i = 0; i < count; ++i) problems_.push_back(motion(1 + i).at(0.0));
  }

  Figures measure() {
    solver_.reserve(problems_.front());
    (void)solver_.solve(problems_.front());
    figures_.chain = measure_yardstick<BareChain>();
    figures_.floor = measure_yardstick<Floor>();
    measure_cold();
    measure_warm();
    if (effort_.ticks > 1) measure_jump();
    std::vector<double> ticks;
    for (std::size_t i = 0; i < 4 && effort_.ticks > 1; ++i) measure_motion(1001 + i, ticks);
    figures_.tick = quantiles(ticks);
    if (!ticks.empty()) figures_.changed_ticks /= static_cast<double>(ticks.size());
    return figures_;
  }

 private:
  [[nodiscard]] Motion motion(std::uint64_t seed) const {
    return {figures_.shape, conflict_, figures_.rho, seed};
  }

  // time of the bare chain or of the floor
  template <typename Yardstick>
  Quantiles measure_yardstick() {
    Rounds rounds(problems_.size());
    Yardstick yardstick;
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      yardstick.read(problems_[i], figures_.shape.unknowns);
      for (int round = 0; round < effort_.rounds; ++round)
        rounds.time(i, [&] { yardstick.compute(); });
    }
    return quantiles(rounds.seconds());
  }

  const Solution& solve(const Hierarchy& levels) {
    const std::size_t before = allocations();
    const Solution& solution = solver_.solve(levels);
    figures_.allocations += allocations() - before;
    figures_.unsolved += solution.status != SolverStatus::Solved;
    return solution;
  }

  // a round goes over all problems, so that no problem finds its own traces in the processor
  void measure_cold() {
    Rounds rounds(problems_.size());
    for (int round = 0; round < effort_.rounds; ++round) {
      for (std::size_t i = 0; i < problems_.size(); ++i) {
        solver_.reset();
        rounds.time(i, [&] { (void)solver_.solve(problems_[i]); });
      }
    }
    for (const Hierarchy& levels : problems_) {
      solver_.reset();
      figures_.changes += static_cast<double>(solve(levels).changes);
    }
    figures_.cold = quantiles(rounds.seconds());
    figures_.changes /= static_cast<double>(problems_.size());
  }

  void measure_warm() {
    Rounds rounds(problems_.size());
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      solver_.reset();
      (void)solve(problems_[i]);
      (void)solve(problems_[i]);
      for (int round = 0; round < effort_.rounds; ++round)
        rounds.time(i, [&] { (void)solver_.solve(problems_[i]); });
    }
    figures_.warm = quantiles(rounds.seconds());
  }

  void measure_jump() {
    Rounds rounds(problems_.size());
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      const Hierarchy later = with_targets_of(motion(1 + i), kJump, problems_[i]);
      for (int round = 0; round < effort_.rounds; ++round) {
        (void)solve(problems_[i]);
        rounds.time(i, [&] { (void)solver_.solve(later); });
      }
    }
    figures_.jump = quantiles(rounds.seconds());
  }

  void measure_motion(std::uint64_t seed, std::vector<double>& seconds) {
    std::vector<Hierarchy> ticks;
    const Motion moving = motion(seed);
    for (int k = 0; k < effort_.ticks; ++k) ticks.push_back(moving.at(1e-3 * k));
    Rounds rounds(ticks.size());
    for (int round = 0; round < effort_.rounds; ++round) {
      solver_.reset();
      for (std::size_t k = 0; k < ticks.size(); ++k)
        rounds.time(k, [&] { (void)solver_.solve(ticks[k]); });
    }
    solver_.reset();
    for (std::size_t k = 0; k < ticks.size(); ++k)
      figures_.changed_ticks += solve(ticks[k]).changes > 0 && k > 0;
    // the first one is cold
    seconds.insert(seconds.end(), rounds.seconds().begin() + 1, rounds.seconds().end());
  }

  Conflict conflict_;
  Effort effort_;
  Solver solver_;
  std::vector<Hierarchy> problems_;
  Figures figures_;
};

}  // namespace hurcules_benchmark

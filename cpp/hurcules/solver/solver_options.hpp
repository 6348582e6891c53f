// How a hierarchy is to be solved.
#pragma once

#include <string>

#include "hurcules/base/types.hpp"

namespace hurcules {

// What becomes of a direction that a level's rows hardly see (problem/nullspace_bases.hpp).
enum class Handover {
  Strict,  // it is the level's down to its rank tolerance: x jumps where a rank changes
  Smooth,  // it goes back to the levels below gradually, from sigma = rho of the level on
};
[[nodiscard]] std::string to_string(Handover handover);
// "strict" or "smooth"; throws Error on another name
[[nodiscard]] Handover handover_named(const std::string& name);

// The regularisation that a level with equality rows is solved with [T §3.3.3, §4.3.3].
enum class Regularization {
  Constant,  // its rho
  // rho sqrt(1 - (sigma_min / singular_threshold)^2), 0 above the threshold: no error away from
  // singularity; sigma_min of its equality rows on the directions left to it
  Adaptive,
};
[[nodiscard]] std::string to_string(Regularization regularization);
// "constant" or "adaptive"; throws Error on another name
[[nodiscard]] Regularization regularization_named(const std::string& name);

struct SolverOptions {
  std::string method = "lexicographic";  // solver.md §4
  // evaluate Solution::optimality at every solve; without, quick strategies are believed and it is
  // NaN: about a fifth of the time of an easy solve
  bool proof = true;
  // working-set changes a solve, after which it ends with IterationLimit: the budget of a tick
  int max_changes = 10000;
  // of Algorithm 1 (rhqp_thesis, hqp, dls_hqp), which may cycle; thesis: 12 for dls_hqp
  int max_iterations = 100;
  // of "lexicographic", what it does near singularities:
  Handover handover = Handover::Strict;
  Regularization regularization = Regularization::Constant;
  double singular_threshold = 0.1;  // > 0, unit of A; below it Adaptive regularises
};

// throws Error naming the option on a value that no solver takes
void check(const SolverOptions& options);

}  // namespace hurcules

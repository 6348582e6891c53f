// The doc texts of bind_solver.cpp.
#pragma once

namespace hurcules_bindings {

inline constexpr const char* kLevelDoc = R"(A level of bounded rows: lower <= A x <= upper.

Args:
  A: (m, n) float64.
  lower, upper: (m,) float64. +-inf or a magnitude >= 1e20 means no side; lower == upper is an equality.
  rho: regularisation coefficient >= 0 (thesis: 0.1). A level of limits wants 0.

Arrays of float64 in C order are held, not copied: what is written into them is seen by the next
solve. Anything else is copied once.

Raises:
  Error: wrong shapes, NaN, lower > upper, rho < 0.
)";
inline constexpr const char* kBoundsDoc =
    R"(Simple bounds lower <= x <= upper as a level of its own, never regularised.

Args:
  lower, upper: (n,) float64. +-inf or a magnitude >= 1e20 means no side. Held as Level holds them.
)";
inline constexpr const char* kStackDoc =
    R"(One level of many hierarchies of a batch, see solve_batch.

Args:
  A: (B, m, n) float64, or (m, n) when all have the same.
  lower, upper: (B, m), or (m,) when all have the same.
  rho: regularisation coefficient >= 0 of all.

Arrays are held and read as those of Level.

Raises:
  Error: as Level; numbers behind the first slice are looked at by solve_batch.
)";
inline constexpr const char* kBoundsStackDoc =
    R"(Simple bounds of many hierarchies of a batch.

Args:
  lower, upper: (B, n) float64, or (n,) when all have the same.
)";
inline constexpr const char* kSolverDoc =
    R"(Solves hierarchies over n unknowns; keeps its working sets between solves.

Args:
  n: number of unknowns.
  options: SolverOptions.
)";
inline constexpr const char* kSolveDoc =
    R"(Solves the levels in decreasing priority.

The interpreter lock is released meanwhile: let no other thread write into the arrays. A solver that
two threads share takes one after the other.

Args:
  levels: sequence of Level (and Bounds).

Returns:
  Solution. A hard problem is no error: look at status and optimality.

Raises:
  Error: shapes that do not fit n unknowns or each other; NaN, infinite A, lower > upper.
)";
inline constexpr const char* kBatchDoc =
    R"(Solves many independent hierarchies on threads, without the interpreter lock.

Args:
  problems: sequence of sequences of Level (and Bounds), each with its own number of unknowns; or
    one sequence of LevelStack (and BoundsStack): hierarchies of one shape, without an object each.
  threads: how many; None: one a processor.
  options: SolverOptions of all.

Returns:
  list of Solution, bit for bit those of a new Solver a problem.

Raises:
  Error: as Solver.solve, with the number of the problem.
)";

inline constexpr const char* kMethodNamesDoc = R"(The names that SolverOptions(method=...) takes.

'lexicographic': the default, exact, always ends.
'rhqp_thesis': Algorithm 1 of the thesis, literally; can end off the optimum or at its iteration limit.
'hqp': the same active set with every rho = 0.
'dls_hqp': the same with a damped inverse and multipliers that leave out the regularisation error.
'cascade': one general QP a level; the same answers as 'lexicographic', slow, for comparison.
)";

inline constexpr const char* kOptionsDoc = "How a hierarchy is solved; see its properties.";
inline constexpr const char* kHandoverDoc =
    R"('strict': a direction that a level's equality rows see is lost to the levels below, however
weak its singular value; x jumps where a rank changes. 'smooth': it goes back to them gradually as
its singular value falls below rho of the level; x is continuous there, the level loses at most
0.033 of each lower level's residual (unit rows, rho 0.1, no limit in the way). Strict all the same
where the level or a level below has rho = 0. Of the method 'lexicographic'.)";
inline constexpr const char* kRegularizationDoc =
    R"('constant': rho of each level. 'adaptive': rho sqrt(1 - (sigma / singular_threshold)^2) with the
smallest singular value sigma of the level's equality rows on the directions left to it, and 0 where
sigma >= singular_threshold. Of the method 'lexicographic'.)";

}  // namespace hurcules_bindings

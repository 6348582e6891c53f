// Solves one set of problems under callgrind: only the solves inside measured_solve() are counted
// (valgrind --tool=callgrind --toggle-collect=measured_solve), see count_instructions.py.
//
// solver_instructions UNKNOWNS SET RHO WARM PROBLEMS   UNKNOWNS 19, 38 or 88, SET 0 to 3, WARM 0:
// cold, 1: the same problem again, 2: its targets jumped
#include <cstdlib>

#include "hurcules/solver/solver.hpp"
#include "robot_problems.hpp"

extern "C" __attribute__((noinline)) void measured_solve(hurcules::Solver& solver,
                                                         const hurcules::Hierarchy& levels) {
  (void)solver.solve(levels);
}

int main(int argc, char** argv) {
  using namespace hurcules_benchmark;
  if (argc != 6) return 1;
  const int unknowns = std::atoi(argv[1]);
  const Shape& shape = unknowns == 19 ? kRobot : unknowns == 38 ? kTwoRobots : kHumanoid;
  const Conflict conflict = kConflicts[std::atoi(argv[2])];
  const double rho = std::atof(argv[3]);
  const int warm = std::atoi(argv[4]);
  Solver solver(shape.unknowns);
  for (int seed = 1; seed <= std::atoi(argv[5]); ++seed) {
    const Motion motion(shape, conflict, rho, static_cast<std::uint64_t>(seed));
    const Hierarchy levels = motion.at(0.0);
    (void)solver.solve(levels);
    if (warm == 0) solver.reset();
    measured_solve(solver, warm == 2 ? with_targets_of(motion, kJump, levels) : levels);
  }
  return 0;
}

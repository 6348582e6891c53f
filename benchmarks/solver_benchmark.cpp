// How long a solve takes, cold, warm and along a motion, and how that grows with the size. Beside
// it two yardsticks on the same rows in the same process: the bare chain (Householder QR with Q, by
// Eigen) and the floor (the solver's own chain alone).
//
// solver_benchmark [--problems N] [--ticks N] [--rounds N] [--json]   numbers of one machine
// compare only within one run, so read the ratios
#include <cstring>
#include <string>

#include "solver_case.hpp"

namespace {

using namespace hurcules_benchmark;

void print_header() {
  std::printf(
      "%35s |      median [us]        | cold, warm, jump, tick / chain   | warm/ | p99 / median "
      "|\n",
      "");
  std::printf(
      "%4s %6s %4s %-18s | %7s %7s %7s | %7s %8s %7s %7s | %5s | %5s %6s | %7s %7s %8s %5s\n", "n",
      "levels", "rho", "set", "chain", "floor", "warm", "cold", "warm", "jump", "tick", "floor",
      "warm", "tick", "changes", "changed", "unsolved", "alloc");
}

void print_row(const Figures& f) {
  const double chain = f.chain.median;
  std::printf("%4ld %6zu %4.2g %-18s | ", static_cast<long>(f.shape.unknowns), f.shape.rows.size(),
              f.rho, f.set.c_str());
  std::printf("%7.2f %7.2f %7.2f | ", chain, f.floor.median, f.warm.median);
  std::printf("%7.2f %8.2f %7.2f %7.2f | ", f.cold.median / chain, f.warm.median / chain,
              f.jump.median / chain, f.tick.median / chain);
  std::printf("%5.1f | %5.2f ", f.warm.median / f.floor.median, f.warm.p99 / f.warm.median);
  std::printf("%6.2f | ", f.tick.median > 0 ? f.tick.p99 / f.tick.median : 0.0);
  std::printf("%7.1f %6.0f%% %8d %5zu\n", f.changes, 100.0 * f.changed_ticks, f.unsolved,
              f.allocations);
  std::fflush(stdout);
}

void print_json(const Figures& f) {
  const auto part = [](const char* what, const Quantiles& q) {
    std::printf("\"%s_us\": {\"median\": %.3f, \"p99\": %.3f, \"max\": %.3f}, ", what, q.median,
                q.p99, q.max);
  };
  static const std::string where =
      "\"machine\": \"" + processor() + "\", \"commit\": \"" + commit() + "\"";
  std::printf("{%s, \"set\": \"%s\", \"unknowns\": %ld, ", where.c_str(), f.set.c_str(),
              static_cast<long>(f.shape.unknowns));
  std::printf("\"rho\": %g, \"rows\": ", f.rho);
  for (std::size_t k = 0; k < f.shape.rows.size(); ++k)
    std::printf("%s%ld", k ? ", " : "[", static_cast<long>(f.shape.rows[k]));
  std::printf("], ");
  part("chain", f.chain);
  part("floor", f.floor);
  part("cold", f.cold);
  part("warm", f.warm);
  part("jump", f.jump);
  part("tick", f.tick);
  std::printf("\"changes\": %.2f, \"changed_ticks\": %.4f, ", f.changes, f.changed_ticks);
  std::printf("\"unsolved\": %d, \"allocations\": %zu}\n", f.unsolved, f.allocations);
  std::fflush(stdout);
}

void report(const Shape& shape, Conflict conflict, double rho, const Effort& effort) {
  const Figures figures = SolverCase(shape, conflict, rho, effort).measure();
  effort.json ? print_json(figures) : print_row(figures);
}

// levels of three rows that take all unknowns
Shape filled(Index unknowns) {
  Shape shape{unknowns, {}};
  for (Index left = unknowns; left > 0; left -= 3) shape.rows.push_back(std::min<Index>(left, 3));
  return shape;
}

Effort read_arguments(int argc, char** argv) {
  Effort effort;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--json")) effort.json = true;
    if (i + 1 == argc) break;
    if (!std::strcmp(argv[i], "--problems")) effort.problems = std::stoi(argv[i + 1]);
    if (!std::strcmp(argv[i], "--ticks")) effort.ticks = std::stoi(argv[i + 1]);
    if (!std::strcmp(argv[i], "--rounds")) effort.rounds = std::stoi(argv[i + 1]);
  }
  return effort;
}

}  // namespace

int main(int argc, char** argv) {
  Effort effort = read_arguments(argc, argv);
  if (!effort.json) print_header();
  for (const Shape& shape : {kRobot, kTwoRobots})
    for (const double rho : {0.1, 0.0})
      for (const Conflict conflict : kConflicts) report(shape, conflict, rho, effort);

  // growth: fewer problems, no motion
  effort.problems = std::max(1, effort.problems / 10);
  effort.ticks = 0;
  if (!effort.json) std::printf("growth with n, levels of three rows\n");
  for (const Conflict conflict : {Conflict::None, Conflict::Levels})
    for (const Index unknowns : {7, 14, 19, 28, 38, 57, 88, 120})
      report(filled(unknowns), conflict, 0.1, effort);
  if (!effort.json) std::printf("growth with the number of levels, 36 rows in all\n");
  for (const Conflict conflict : {Conflict::None, Conflict::Levels})
    for (const std::size_t levels : {1, 2, 3, 4, 6, 9, 12})
      report({36, std::vector<Index>(levels, 36 / static_cast<Index>(levels))}, conflict, 0.1,
             effort);
  return 0;
}

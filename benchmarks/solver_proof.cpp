// Solves seeded hierarchies of every class at every regularisation and counts what is not proven.
//
//   solver_proof [--problems N] [--seed S] [--judge E] [--class NAME] [--rho R] [--once [--json]]
//
// An answer counts as proven when its status is Solved, its numbers are finite, and its optimality
// residual is at most 1e-9. Every E-th problem, and every one that is not proven, is judged once
// more from the definition alone: "right" or "wrong". What is not proven or wrong prints class, rho
// and seed; --once with --class, --rho and --seed solves that one again and prints it, with --json
// for exact_referee.py. Ends with 1 when an answer is wrong or unfinished (not of all levels).
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <map>
#include <string>

#include "hurcules/solver/solver.hpp"
#include "support/answers_by_level.hpp"
#include "support/hierarchy_classes.hpp"
#include "support/hierarchy_text.hpp"
#include "support/optimality_judge.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

constexpr double kProven = 1e-9;
constexpr int kMostPrinted = 5;  // failures of one kind in one class at one rho

struct Request {
  long problems = 100'000;
  unsigned long long seed = 0;
  long judge = 50;
  std::string only_class;
  double only_rho = -1.0;
  bool once = false, json = false;
};

struct Tally {
  long solved = 0, unproven = 0, unfinished = 0, judged = 0, wrong = 0;
  long right = 0;  // of those that are not proven
  double worst = 0.0, worst_judged = 0.0;
  double worst_right = 0.0;  // judged, of those that are not proven but right
  unsigned long long worst_seed = 0;
  std::map<std::string, long> failures;  // by kind

  void add(const Tally& other) {
    solved += other.solved;
    unproven += other.unproven;
    right += other.right;
    unfinished += other.unfinished;
    judged += other.judged;
    wrong += other.wrong;
    worst = std::max(worst, other.worst);
    worst_judged = std::max(worst_judged, other.worst_judged);
    worst_right = std::max(worst_right, other.worst_right);
  }
};

// same problem for the same seed, whatever else is run
Hierarchy make(const HierarchyClass& kind, unsigned long long seed, double rho) {
  Draw draw(seed);
  return kind.make(draw, rho);
}

// "" when proven, else the kind of failure
std::string failure(const Solution& solution) {
  if (!solution.x.allFinite() || !std::isfinite(solution.optimality)) return "not finite";
  if (solution.status != SolverStatus::Solved) return to_string(solution.status);
  return solution.optimality > kProven ? "residual" : "";
}

Verdict judge(const Hierarchy& levels) {
  return OptimalityJudge(levels).judge(answers_by_level(levels, unknowns_of(levels)));
}

void note(Tally& tally, const HierarchyClass& kind, double rho, unsigned long long seed,
          const std::string& what, double value) {
  if (tally.failures[what]++ >= kMostPrinted) return;
  std::printf("--class %s --rho %g --seed %llu: %s %.1e\n", kind.name, rho, seed, what.c_str(),
              value);
}

bool finished(const Solution& solution, const Hierarchy& levels) {
  return solution.x.allFinite() && solution.final_levels == static_cast<int>(levels.size());
}

void judge(Tally& tally, const HierarchyClass& kind, double rho, unsigned long long seed,
           const Hierarchy& levels, bool proven) {
  const double judged = judge(levels).worst();
  ++tally.judged;
  if (!(judged <= kProven)) {
    ++tally.wrong;
    note(tally, kind, rho, seed, "judged wrong", judged);
  } else if (!proven) {
    ++tally.right;
    tally.worst_right = std::max(tally.worst_right, judged);
  }
  tally.worst_judged = std::max(tally.worst_judged, judged);
}

Tally run(const HierarchyClass& kind, double rho, long problems, const Request& request) {
  Tally tally;
  for (long i = 0; i < problems; ++i) {
    const unsigned long long seed = request.seed + i;
    const Hierarchy levels = make(kind, seed, rho);
    Solver solver(unknowns_of(levels));
    const Solution& solution = solver.solve(levels);
    ++tally.solved;
    if (solution.optimality > tally.worst) {
      tally.worst = solution.optimality;
      tally.worst_seed = seed;
    }
    const std::string what = failure(solution);
    if (!what.empty()) {
      ++tally.unproven;
      note(tally, kind, rho, seed, what, solution.optimality);
    }
    tally.unfinished += !finished(solution, levels);
    if (!what.empty() || (request.judge > 0 && i % request.judge == 0)) {
      judge(tally, kind, rho, seed, levels, what.empty());
    }
  }
  return tally;
}

void print(const char* name, double rho, const Tally& tally) {
  std::printf("%-16s %7.0e %9ld %8ld %9.1e %20llu %9ld %9.1e %6ld", name, rho, tally.solved,
              tally.unproven, tally.worst, tally.worst_seed, tally.judged, tally.worst_judged,
              tally.wrong);
  for (const auto& [what, number] : tally.failures) std::printf("  %s %ld", what.c_str(), number);
  std::printf("\n");
  std::fflush(stdout);
}

void print_summary(const Tally& total, double seconds) {
  std::printf(
      "%ld problems, %.0f s: %ld unfinished, %ld not proven, of which %ld right by the judge "
      "(worst %.1e); %ld judged, %ld wrong, worst %.1e\n",
      total.solved, seconds, total.unfinished, total.unproven, total.right, total.worst_right,
      total.judged, total.wrong, total.worst_judged);
}

// as hexadecimal numbers, which lose nothing
void print_numbers(const char* name, const double* v, Index count) {
  std::printf("\"%s\": [", name);
  for (Index i = 0; i < count; ++i) std::printf("%s\"%a\"", i ? ", " : "", v[i]);
  std::printf("]");
}

// the levels with our answers after each of them
void print_json(const Hierarchy& levels) {
  const Index n = unknowns_of(levels);
  const std::vector<Vector> x = answers_by_level(levels, n);
  std::printf("{\"n\": %ld, \"levels\": [", static_cast<long>(n));
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const Level& level = levels[k];
    std::printf("%s{\"bounds\": %d, \"rho\": \"%a\", ", k ? ", " : "", level.bounds, level.rho);
    print_numbers("A", level.A.data(), level.A.size());
    std::printf(", ");
    print_numbers("lower", level.lower.data(), level.rows());
    std::printf(", ");
    print_numbers("upper", level.upper.data(), level.rows());
    std::printf(", ");
    print_numbers("x", x[k].data(), n);
    std::printf("}");
  }
  std::printf("]}\n");
}

int solve_once(const Request& request) {
  for (const HierarchyClass& kind : kHierarchyClasses) {
    if (kind.name != request.only_class) continue;
    const Hierarchy levels = make(kind, request.seed, request.only_rho);
    if (request.json) {
      print_json(levels);
      return 0;
    }
    Solver solver(unknowns_of(levels));
    const Solution& solution = solver.solve(levels);
    std::printf("%s// x: %s\n", as_text(levels).c_str(), vector_text(solution.x).c_str());
    const Verdict verdict = judge(levels);
    std::printf("// %s, optimality %.2e, changes %d, final levels %d\n",
                to_string(solution.status).c_str(), solution.optimality, solution.changes,
                solution.final_levels);
    std::printf("// judged: feasibility %.1e, stationarity %.1e, smallest step %.1e\n",
                verdict.feasibility, verdict.stationarity, verdict.smallest);
    return finished(solution, levels) && verdict.worst() <= kProven ? 0 : 1;
  }
  std::fprintf(stderr, "--once wants --class, --rho and --seed\n");
  return 2;
}

Request read(int argc, char** argv) {
  Request request;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--once" || name == "--json") {
      (name == "--once" ? request.once : request.json) = true;
      continue;
    }
    const char* value = i + 1 < argc ? argv[++i] : "";
    if (name == "--problems")
      request.problems = std::atol(value);
    else if (name == "--seed")
      request.seed = std::strtoull(value, nullptr, 10);
    else if (name == "--judge")
      request.judge = std::atol(value);
    else if (name == "--class")
      request.only_class = value;
    else if (name == "--rho")
      request.only_rho = std::atof(value);
    else {
      std::fprintf(stderr, "unknown option %s\n", name.c_str());
      std::exit(2);
    }
  }
  return request;
}

}  // namespace

int main(int argc, char** argv) {
  const Request request = read(argc, argv);
  if (request.once) return solve_once(request);
  double shares = 0.0;
  for (const HierarchyClass& kind : kHierarchyClasses) {
    if (request.only_class.empty() || request.only_class == kind.name) shares += 1.0 / kind.rarity;
  }
  if (request.only_rho < 0.0) shares *= static_cast<double>(kRegularisations.size());
  std::printf("%-16s %7s %9s %8s %9s %20s %9s %9s %6s\n", "class", "rho", "problems", "unproven",
              "worst", "its seed", "judged", "worst", "wrong");
  const std::clock_t begin = std::clock();
  Tally total;
  for (const HierarchyClass& kind : kHierarchyClasses) {
    if (!request.only_class.empty() && request.only_class != kind.name) continue;
    const double share = static_cast<double>(request.problems) / shares / kind.rarity;
    for (const double rho : kRegularisations) {
      if (request.only_rho >= 0.0 && request.only_rho != rho) continue;
      const Tally tally = run(kind, rho, static_cast<long>(std::ceil(share)), request);
      print(kind.name, rho, tally);
      total.add(tally);
    }
  }
  print_summary(total, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  return total.wrong || total.unfinished ? 1 : 0;
}

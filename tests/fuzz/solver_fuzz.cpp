// Fuzzing of the whole solve: any bytes, decoded to a hierarchy, must be solved or refused as
// promised.
//
//   always    no throw, finite x; InvalidInput exactly where check() refuses; violations are those
//             of x; Solved means a residual of at most 1e-9
//   not wild  the status is Solved, cold and warm; the answer is optimal by the definition alone;
//   an
//             interrupted solve breaks no simple bound
//   tame      warm equals cold
//
// libFuzzer calls LLVMFuzzerTestOneInput (make fuzz); driver.cpp calls it with seeded bytes where
// there is no clang. A broken promise prints the hierarchy and aborts; with HURCULES_FUZZ_COLLECT
// set to a folder it is kept there, a few of each kind, and the run goes on.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "decode.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/solver/solver.hpp"
#include "support/answers_by_level.hpp"
#include "support/hierarchy_text.hpp"
#include "support/optimality_judge.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_fuzz;

constexpr double kProven = 1e-9;
constexpr int kMostKept = 10;  // inputs of one kind

class Fuzzed {
 public:
  Fuzzed(const std::uint8_t* data, std::size_t size)
      : data_(data), size_(size), problem_(Decoder(data, size).problem()) {}

  void check_promises() {
    if (problem_.levels.empty()) return;
    Solver solver(problem_.unknowns);
    const Solution cold = solver.solve(problem_.levels);
    check_always(cold);
    if (problem_.wildness == Wildness::Wild || cold.status == SolverStatus::InvalidInput) return;
    promise(cold.status == SolverStatus::Solved || excused(cold), "status", cold.optimality);
    const Solution warm = solver.solve(problem_.levels);
    check_always(warm);
    promise(warm.status == SolverStatus::Solved || excused(warm), "warm status", warm.optimality);
    const double size = std::max(1.0, cold.x.lpNorm<Eigen::Infinity>());
    const double moved = (warm.x - cold.x).lpNorm<Eigen::Infinity>() / size;
    promise(problem_.wildness != Wildness::Tame || moved < 1e-7, "warm differs", moved);
    // where rows stand out by what may be rounding, which of them count is a matter of tolerance
    if (cold.status == SolverStatus::Solved && !problem_.delicate) check_definition();
    check_interrupted();
  }

 private:
  void check_always(const Solution& solution) {
    const bool refused = solution.status == SolverStatus::InvalidInput;
    promise(refused == refused_by_check(), "refusal");
    promise(solution.x.allFinite(), "not finite");
    if (refused) return;
    promise(std::isfinite(solution.optimality) || solution.status != SolverStatus::Solved,
            "residual not finite");
    const bool solved = solution.status == SolverStatus::Solved;
    promise(!solved || solution.optimality <= kProven, "residual", solution.optimality);
    promise(!solved || solution.final_levels == static_cast<int>(problem_.levels.size()),
            "final levels", solution.final_levels);
    check_violations(solution);
  }

  [[nodiscard]] bool refused_by_check() const {
    try {
      check(problem_.levels, problem_.unknowns);
    } catch (const Error&) {
      return true;
    }
    return false;
  }

  void check_violations(const Solution& solution) {
    for (std::size_t k = 0; k < problem_.levels.size(); ++k) {
      const Level& level = problem_.levels[k];
      const Vector value = level.bounds ? solution.x : Vector(level.A * solution.x);
      for (Index i = 0; i < level.rows(); ++i) {
        const double norm = level.bounds ? 1.0 : level.A.row(i).norm();
        const double size = std::max({1.0, std::abs(value[i]), norm * solution.x.norm()});
        const double wanted = value[i] - std::clamp(value[i], level.lower[i], level.upper[i]);
        const double off = std::abs(solution.violations[k][i] - wanted);
        promise(!std::isfinite(size) || off <= 1e-12 * size, "violations", off);
      }
    }
  }

  [[nodiscard]] bool excused(const Solution& solution) const {
    // it may come to no end there, but says so
    return problem_.delicate && (solution.status == SolverStatus::ReducedAccuracy ||
                                 solution.status == SolverStatus::IterationLimit);
  }

  void check_definition() {
    const auto x = hurcules_test::answers_by_level(problem_.levels, problem_.unknowns);
    const auto verdict = hurcules_test::OptimalityJudge(problem_.levels).judge(x);
    promise(verdict.feasibility <= kProven, "judged feasibility", verdict.feasibility);
    promise(verdict.stationarity <= kProven, "judged stationarity", verdict.stationarity);
    promise(verdict.smallest <= kProven, "judged smallest step", verdict.smallest);
  }

  void check_interrupted() {
    const int limit = 1 + static_cast<int>(size_ % 5);
    Solver solver(problem_.unknowns, {.max_changes = limit});
    const Solution& solution = solver.solve(problem_.levels);
    promise(solution.x.allFinite(), "interrupted, not finite");
    promise(solution.status == SolverStatus::Solved ||
                solution.status == SolverStatus::IterationLimit || excused(solution),
            "interrupted status");
    if (!problem_.levels[0].bounds) return;
    const double size = std::max(1.0, solution.x.lpNorm<Eigen::Infinity>());
    const double broken = solution.violations[0].lpNorm<Eigen::Infinity>() / size;
    promise(broken <= 1e-11, "interrupted, bounds broken", broken);
  }

  void promise(bool kept, const std::string& kind, double value = 0.0) {
    if (kept) return;
    static std::map<std::string, int> seen;
    const char* folder = std::getenv("HURCULES_FUZZ_COLLECT");
    if (folder && seen[kind] >= kMostKept) return;
    std::printf("// BROKEN PROMISE: %s %.2e, %td unknowns\n%s", kind.c_str(), value,
                problem_.unknowns, hurcules_test::as_text(problem_.levels).c_str());
    std::fflush(stdout);
    if (!folder) std::abort();
    std::string name = kind + "_" + std::to_string(seen[kind]++);
    for (char& c : name) c = c == ' ' || c == ',' ? '_' : c;
    std::ofstream(std::string(folder) + "/" + name, std::ios::binary)
        .write(reinterpret_cast<const char*>(data_), static_cast<std::streamsize>(size_));
  }

  const std::uint8_t* data_;
  std::size_t size_;
  Problem problem_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Fuzzed(data, size).check_promises();
  return 0;
}

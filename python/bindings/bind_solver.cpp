// solver: levels, solver, batches; what a solve answers is in bind_solver_answer.cpp.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <deque>
#include <mutex>

#include "hurcules/base/error.hpp"
#include "hurcules/solver/batch.hpp"
#include "hurcules/solver/method.hpp"
#include "solver_answer.hpp"
#include "solver_levels.hpp"

namespace py = pybind11;
using namespace pybind11::literals;

void bind_solver(py::module_& module);
void bind_solver_answer(py::module_& module);

using namespace hurcules;
using hurcules_bindings::Answer;
using hurcules_bindings::ArrayLevel;
using hurcules_bindings::HeldLevels;

namespace {

constexpr const char* kLevelDoc = R"(A level of bounded rows: lower <= A x <= upper.

Args:
  A: (m, n) float64.
  lower, upper: (m,) float64. +-inf or a magnitude >= 1e20 means no side; lower == upper is an equality.
  rho: regularisation coefficient >= 0 (thesis: 0.1). A level of limits wants 0.

Arrays of float64 in C order are held, not copied: what is written into them is seen by the next
solve. Anything else is copied once.

Raises:
  Error: wrong shapes, NaN, lower > upper, rho < 0.
)";
constexpr const char* kBoundsDoc =
    R"(Simple bounds lower <= x <= upper as a level of its own, never regularised.

Args:
  lower, upper: (n,) float64. +-inf or a magnitude >= 1e20 means no side. Held as Level holds them.
)";
constexpr const char* kSolverDoc =
    R"(Solves hierarchies over n unknowns; keeps its working sets between solves.

Args:
  n: number of unknowns.
  options: SolverOptions.
)";
constexpr const char* kSolveDoc =
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
constexpr const char* kBatchDoc =
    R"(Solves many independent hierarchies on threads, without the interpreter lock.

Args:
  problems: sequence of sequences of Level (and Bounds); each may have its own number of unknowns.
  threads: how many; None: one a processor.
  options: SolverOptions of all.

Returns:
  list of Solution, bit for bit those of a new Solver a problem.

Raises:
  Error: as Solver.solve, with the number of the problem.
)";

constexpr const char* kMethodNamesDoc = R"(The names that SolverOptions(method=...) takes.

'lexicographic': the default, exact, always ends.
'rhqp_thesis': Algorithm 1 of the thesis, literally; can end off the optimum or at its iteration limit.
'hqp': the same active set with every rho = 0.
'dls_hqp': the same with a damped inverse and multipliers that leave out the regularisation error.
'cascade': one general QP a level; the same answers as 'lexicographic', slow, for comparison.
)";

constexpr const char* kHandoverDoc =
    R"('strict': a direction that a level's equality rows see is lost to the levels below, however
weak its singular value; x jumps where a rank changes. 'smooth': it goes back to them gradually as
its singular value falls below rho of the level; x is continuous there, the level loses at most
0.033 of each lower level's residual (unit rows, rho 0.1, no limit in the way). Strict all the same
where the level or a level below has rho = 0. Of the method 'lexicographic'.)";
constexpr const char* kRegularizationDoc =
    R"('constant': rho of each level. 'adaptive': rho sqrt(1 - (sigma / singular_threshold)^2) with the
smallest singular value sigma of the level's equality rows on the directions left to it, and 0 where
sigma >= singular_threshold. Of the method 'lexicographic'.)";

// a solver that two Python threads may share
struct SharedSolver {
  SharedSolver(Index n, SolverOptions options) : solver(n, std::move(options)) {}

  Solver solver;
  std::mutex mutex;
};

Answer solve(SharedSolver& self, const py::object& levels) {
  const HeldLevels held(levels);
  Answer answer;
  {
    const py::gil_scoped_release release;
    const std::lock_guard lock(self.mutex);
    static_cast<void>(self.solver.solve_views(held.views()));
    answer = Answer(self.solver);
  }
  if (answer.solution().status == SolverStatus::InvalidInput) held.refuse(self.solver.unknowns());
  return answer;
}

void reset(SharedSolver& self) {
  const py::gil_scoped_release release;
  const std::lock_guard lock(self.mutex);
  self.solver.reset();
}

int count_of(const py::object& threads) {
  if (threads.is_none()) return 0;
  const bool whole = py::isinstance<py::int_>(threads) && !py::isinstance<py::bool_>(threads);
  require(whole && py::int_(0) < threads && threads < py::int_(10000),
          "threads wants a whole number from 1 or None, got " + std::string(py::repr(threads)));
  return threads.cast<int>();
}

std::vector<Answer> solve_problems(const py::object& problems, const py::object& threads,
                                   const SolverOptions& options) {
  const BatchOptions batch{.solver = options, .threads = count_of(threads)};
  require(py::isinstance<py::sequence>(problems),
          "solve_batch wants a list of lists of Level, got " + std::string(py::repr(problems)));
  std::deque<HeldLevels> held;
  std::vector<BatchProblem> tasks;
  for (const py::handle problem : py::tuple(problems)) {
    const std::string name = "problem " + std::to_string(held.size()) + ", ";
    held.emplace_back(py::reinterpret_borrow<py::object>(problem), name);
    tasks.push_back({held.back().unknowns(), held.back().views()});
  }
  std::vector<Answer> answers(tasks.size());
  {
    const py::gil_scoped_release release;
    solve_batch(tasks, batch,
                [&answers](std::size_t i, const Solver& solver) { answers[i] = Answer(solver); });
  }
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (answers[i].solution().status == SolverStatus::InvalidInput)
      held[i].refuse(tasks[i].unknowns);
  }
  return answers;
}

void bind_level(py::module_& module) {
  py::class_<ArrayLevel>(module, "Level", kLevelDoc)
      .def(py::init(&hurcules_bindings::make_level), "A"_a, "lower"_a, "upper"_a, "rho"_a = 0.0)
      .def_property_readonly(
          "A", [](const ArrayLevel& self) { return self.A; },
          "(m, n), the array that is solved; empty for bounds")
      .def_property_readonly(
          "lower", [](const ArrayLevel& self) { return self.lower; },
          "(m,), the array that is solved")
      .def_property_readonly(
          "upper", [](const ArrayLevel& self) { return self.upper; },
          "(m,), the array that is solved")
      .def_readonly("rho", &ArrayLevel::rho)
      .def_property_readonly("rows", [](const ArrayLevel& self) { return self.lower.size(); })
      .def("__repr__", [](const ArrayLevel& self) {
        return (self.bounds ? "Bounds(n=" : "Level(m=") + std::to_string(self.lower.size()) +
               (self.bounds ? ")" : ", rho=" + std::to_string(self.rho) + ")");
      });
  module.def("Bounds", &hurcules_bindings::make_bounds_level, "lower"_a, "upper"_a, kBoundsDoc);
}

}  // namespace

void bind_solver(py::module_& module) {
  bind_level(module);
  bind_solver_answer(module);
  py::class_<SolverOptions>(module, "SolverOptions")
      .def(py::init([](std::string method, bool proof, int max_changes, int max_iterations,
                       const std::string& handover, const std::string& regularization,
                       double singular_threshold) {
             return SolverOptions{.method = std::move(method),
                                  .proof = proof,
                                  .max_changes = max_changes,
                                  .max_iterations = max_iterations,
                                  .handover = handover_named(handover),
                                  .regularization = regularization_named(regularization),
                                  .singular_threshold = singular_threshold};
           }),
           py::kw_only(), "method"_a = SolverOptions{}.method, "proof"_a = SolverOptions{}.proof,
           "max_changes"_a = SolverOptions{}.max_changes,
           "max_iterations"_a = SolverOptions{}.max_iterations,
           "handover"_a = to_string(SolverOptions{}.handover),
           "regularization"_a = to_string(SolverOptions{}.regularization),
           "singular_threshold"_a = SolverOptions{}.singular_threshold)
      .def_readwrite("method", &SolverOptions::method, "one of method_names()")
      .def_readwrite("proof", &SolverOptions::proof,
                     "evaluate Solution.optimality at every solve; without, it is NaN")
      .def_readwrite("max_changes", &SolverOptions::max_changes,
                     "working-set changes a solve, after which it ends with IterationLimit")
      .def_readwrite("max_iterations", &SolverOptions::max_iterations,
                     "of Algorithm 1 (rhqp_thesis, hqp, dls_hqp); thesis: 12 for dls_hqp")
      .def_property(
          "handover", [](const SolverOptions& self) { return to_string(self.handover); },
          [](SolverOptions& self, const std::string& name) {
            self.handover = handover_named(name);
          },
          kHandoverDoc)
      .def_property(
          "regularization",
          [](const SolverOptions& self) { return to_string(self.regularization); },
          [](SolverOptions& self, const std::string& name) {
            self.regularization = regularization_named(name);
          },
          kRegularizationDoc)
      .def_readwrite("singular_threshold", &SolverOptions::singular_threshold,
                     "> 0, unit of A; below it 'adaptive' regularises");
  module.def("method_names", &method_names, kMethodNamesDoc);
  py::class_<SharedSolver>(module, "Solver", kSolverDoc)
      .def(py::init<Index, SolverOptions>(), "n"_a, "options"_a = SolverOptions{})
      .def("solve", &solve, "levels"_a, kSolveDoc)
      .def("reset", &reset, "Forgets the working sets: the next solve is cold.")
      .def_property_readonly(
          "n", [](const SharedSolver& self) { return self.solver.unknowns(); },
          "number of unknowns");
  module.def("solve_batch", &solve_problems, "problems"_a, "threads"_a = py::none(),
             "options"_a = SolverOptions{}, kBatchDoc);
}

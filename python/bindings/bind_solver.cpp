// solver: levels, solver, batches; what a solve answers is in bind_solver_answer.cpp.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <deque>
#include <mutex>

#include "bind_solver_docs.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/solver/batch.hpp"
#include "hurcules/solver/method.hpp"
#include "options.hpp"
#include "solver_answer.hpp"
#include "solver_levels.hpp"
#include "solver_stacks.hpp"

namespace py = pybind11;
using namespace pybind11::literals;

void bind_solver(py::module_& module);
void bind_solver_answer(py::module_& module);

using namespace hurcules;
using namespace hurcules_bindings;

namespace {

// a solver that two Python threads may share
struct SharedSolver {
  SharedSolver(Index n, SolverOptions options) : solver(n, std::move(options)) {}

  Solver solver;
  std::mutex mutex;
};

Answer solve(SharedSolver& self,
             const As<"collections.abc.Sequence[hurcules._core.Level]">& levels) {
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

std::vector<Answer> answers_to(const std::vector<BatchProblem>& problems,
                               const BatchOptions& options) {
  std::vector<Answer> answers(problems.size());
  const py::gil_scoped_release release;
  solve_batch(problems, options,
              [&answers](std::size_t i, const Solver& solver) { answers[i] = Answer(solver); });
  return answers;
}

// refuse(i): the Error of problem i
template <typename Refuse>
void refuse_invalid(const std::vector<Answer>& answers, Refuse&& refuse) {
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i].solution().status == SolverStatus::InvalidInput) refuse(i);
  }
}

// what solve_batch takes
using Problems =
    As<"collections.abc.Sequence[collections.abc.Sequence[hurcules._core.Level]] | "
       "collections.abc.Sequence[hurcules._core.LevelStack]">;

std::vector<Answer> solve_problems(const Problems& problems, const As<"int | None">& threads,
                                   const SolverOptions& options) {
  const BatchOptions batch{.solver = options, .threads = count_of(threads)};
  // a text only when it is needed: that of a thousand problems costs more than their solves
  if (!py::isinstance<py::sequence>(problems)) {
    throw Error("solve_batch wants a list of lists of Level, or of LevelStack, got " +
                std::string(py::repr(problems)));
  }
  const py::tuple items(problems);
  if (!items.empty() && is_stack(items[0])) {
    const HeldStacks held(items);
    std::vector<Answer> answers = answers_to(held.problems(), batch);
    refuse_invalid(answers, [&held](std::size_t i) { held.refuse(i); });
    return answers;
  }
  std::deque<HeldLevels> held;
  std::vector<BatchProblem> tasks;
  for (const py::handle problem : items) {
    const std::string name = "problem " + std::to_string(held.size()) + ", ";
    held.emplace_back(py::reinterpret_borrow<py::object>(problem), name);
    tasks.push_back({held.back().unknowns(), held.back().views()});
  }
  std::vector<Answer> answers = answers_to(tasks, batch);
  refuse_invalid(answers, [&](std::size_t i) { held[i].refuse(tasks[i].unknowns); });
  return answers;
}

void bind_level(py::module_& module) {
  py::class_<ArrayLevel>(module, "Level", kLevelDoc)
      .def(py::init(&make_level), "A"_a, "lower"_a, "upper"_a, "rho"_a = 0.0)
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
               (self.bounds ? ")"
                            : ", rho=" + py::repr(py::float_(self.rho)).cast<std::string>() + ")");
      });
  module.def("Bounds", &make_bounds_level, "lower"_a, "upper"_a, kBoundsDoc);
}

void bind_stack(py::module_& module) {
  py::class_<ArrayStack>(module, "LevelStack", kStackDoc)
      .def(py::init(&make_stack), "A"_a, "lower"_a, "upper"_a, "rho"_a = 0.0)
      .def_property_readonly(
          "A", [](const ArrayStack& self) { return self.A; },
          "the array that is solved; empty for bounds")
      .def_property_readonly(
          "lower", [](const ArrayStack& self) { return self.lower; }, "the array that is solved")
      .def_property_readonly(
          "upper", [](const ArrayStack& self) { return self.upper; }, "the array that is solved")
      .def_readonly("rho", &ArrayStack::rho);
  module.def("BoundsStack", &make_bounds_stack, "lower"_a, "upper"_a, kBoundsStackDoc);
}

}  // namespace

void bind_solver(py::module_& module) {
  bind_level(module);
  bind_stack(module);
  bind_solver_answer(module);
  bind_options<SolverOptions>(
      module, "SolverOptions", kOptionsDoc,
      {field("method", &SolverOptions::method, "one of method_names()"),
       field("proof", &SolverOptions::proof,
             "evaluate Solution.optimality at every solve; without, it is NaN"),
       field("max_changes", &SolverOptions::max_changes,
             "working-set changes a solve, after which it ends with IterationLimit"),
       field("max_iterations", &SolverOptions::max_iterations,
             "of Algorithm 1 (rhqp_thesis, hqp, dls_hqp); thesis: 12 for dls_hqp"),
       text_field<SolverOptions>(
           "handover", [](const SolverOptions& self) { return to_string(self.handover); },
           [](SolverOptions& self, const std::string& name) {
             self.handover = handover_named(name);
           },
           kHandoverDoc),
       text_field<SolverOptions>(
           "regularization",
           [](const SolverOptions& self) { return to_string(self.regularization); },
           [](SolverOptions& self, const std::string& name) {
             self.regularization = regularization_named(name);
           },
           kRegularizationDoc),
       field("singular_threshold", &SolverOptions::singular_threshold,
             "> 0, unit of A; below it 'adaptive' regularises")});
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

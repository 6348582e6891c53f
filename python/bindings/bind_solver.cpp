#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/solver/method.hpp"
#include "hurcules/solver/solver.hpp"

namespace py = pybind11;
using namespace pybind11::literals;

void bind_solver(py::module_& module);

using namespace hurcules;
using hurcules_bindings::matrix_of;
using hurcules_bindings::vector_of;

namespace {

constexpr const char* kLevelDoc = R"(A level of bounded rows: lower <= A x <= upper.

Args:
  A: (m, n) float64.
  lower, upper: (m,) float64. +-inf or a magnitude >= 1e20 means no side; lower == upper is an equality.
  rho: regularisation coefficient >= 0 (thesis: 0.1). A level of limits wants 0.

Raises:
  Error: wrong shapes, NaN, lower > upper, rho < 0.
)";
constexpr const char* kBoundsDoc =
    R"(Simple bounds lower <= x <= upper as a level of its own, never regularised.

Args:
  lower, upper: (n,) float64. +-inf or a magnitude >= 1e20 means no side.
)";
constexpr const char* kSolverDoc =
    R"(Solves hierarchies over n unknowns; keeps its working sets between solves.

Args:
  n: number of unknowns.
  options: SolverOptions.
)";
constexpr const char* kSolveDoc =
    R"(Solves the levels in decreasing priority. Releases the interpreter lock.

Args:
  levels: sequence of Level (and Bounds).

Returns:
  Solution. A hard problem is no error: look at status and optimality.

Raises:
  Error: shapes that do not fit n unknowns or each other.
)";
constexpr const char* kMultipliersDoc =
    R"(multipliers[k][j] (m_j): multipliers of level j's rows in the optimality of level k, j <= k.

multipliers[k][k] are the violations of level k. [T 3.4.116])";

constexpr const char* kMethodNamesDoc = R"(The names that SolverOptions(method=...) takes.

'lexicographic': the default, exact, always ends.
'rhqp_thesis': Algorithm 1 of the thesis, literally; can end off the optimum or at its iteration limit.
'hqp': the same active set with every rho = 0.
'dls_hqp': the same with a damped inverse and multipliers that leave out the regularisation error.
'cascade': one general QP a level; the same answers as 'lexicographic', slow, for comparison.
)";

// what Python gets: an answer that does not change with the next solve
struct Answer : Solution {
  std::vector<std::vector<Vector>> multipliers;
};

Level make_level(const py::object& A, const py::object& lower, const py::object& upper,
                 const py::object& rho) {
  require(py::isinstance<py::float_>(rho) || py::isinstance<py::int_>(rho) ||
              py::hasattr(rho, "__float__"),
          "rho wants a number >= 0, got " + std::string(py::repr(rho)));
  Level level{.A = matrix_of(A, "A", "(m, n)"),
              .lower = vector_of(lower, "lower", "(m,)"),
              .upper = vector_of(upper, "upper", "(m,)"),
              .rho = py::float_(rho)};
  check(level, level.A.cols(), "level");
  return level;
}

Level make_checked_bounds(const py::object& lower, const py::object& upper) {
  Level level = make_bounds(vector_of(lower, "lower", "(n,)"), vector_of(upper, "upper", "(n,)"));
  check(level, level.rows(), "bounds");
  return level;
}

Hierarchy hierarchy_of(const py::object& levels) {
  require(py::isinstance<py::sequence>(levels),
          "solve wants a list of Level and Bounds, got " + std::string(py::repr(levels)));
  Hierarchy hierarchy;
  for (const py::handle item : levels) {
    require(py::isinstance<Level>(item), "level " + std::to_string(hierarchy.size()) +
                                             " wants to be a Level or Bounds, got " +
                                             std::string(py::repr(item)));
    hierarchy.push_back(item.cast<const Level&>());
  }
  return hierarchy;
}

Answer solve(Solver& solver, const py::object& levels) {
  const Hierarchy hierarchy = hierarchy_of(levels);
  check(hierarchy, solver.unknowns());
  py::gil_scoped_release release;
  return {solver.solve(hierarchy), solver.multipliers()};
}

void bind_level(py::module_& module) {
  py::class_<Level> level(module, "Level", kLevelDoc);
  level.def(py::init(&make_level), "A"_a, "lower"_a, "upper"_a, "rho"_a = 0.0)
      .def_readonly("A", &Level::A, "(m, n); empty for bounds")
      .def_readonly("lower", &Level::lower, "(m,)")
      .def_readonly("upper", &Level::upper, "(m,)")
      .def_readonly("rho", &Level::rho)
      .def_property_readonly("rows", &Level::rows)
      .def("__repr__", [](const Level& self) {
        return (self.bounds ? "Bounds(n=" : "Level(m=") + std::to_string(self.rows()) +
               (self.bounds ? ")" : ", rho=" + std::to_string(self.rho) + ")");
      });
  module.def("Bounds", &make_checked_bounds, "lower"_a, "upper"_a, kBoundsDoc);
}

void bind_solution(py::module_& module) {
  py::enum_<SolverStatus>(module, "Status", "How a solve ended.")
      .value("Solved", SolverStatus::Solved)
      .value("ReducedAccuracy", SolverStatus::ReducedAccuracy)
      .value("IterationLimit", SolverStatus::IterationLimit)
      .value("LostPrecision", SolverStatus::LostPrecision)
      .value("InvalidInput", SolverStatus::InvalidInput);
  py::enum_<Side>(module, "Side", "The side at which a row is held.")
      .value("Lower", Side::Lower)
      .value("Upper", Side::Upper);
  py::class_<ActiveRow>(module, "ActiveRow", "A row that holds x back.")
      .def_readonly("level", &ActiveRow::level, "level that the row belongs to")
      .def_readonly("row", &ActiveRow::row, "its row there")
      .def_readonly("side", &ActiveRow::side)
      .def_readonly("held_by", &ActiveRow::held_by, "level that pushes against it")
      .def_readonly("multiplier", &ActiveRow::multiplier, ">= 0, of that level's problem")
      .def("__repr__", [](const ActiveRow& self) {
        return "ActiveRow(level=" + std::to_string(self.level) +
               ", row=" + std::to_string(self.row) +
               (self.side == Side::Upper ? ", Upper" : ", Lower") +
               ", held_by=" + std::to_string(self.held_by) + ")";
      });
  py::class_<Answer>(module, "Solution", "The answer of one solve.")
      .def_readonly("x", &Answer::x, "(n,)")
      .def_readonly("status", &Answer::status)
      .def_readonly("violations", &Answer::violations,
                    "per level (m,): A x - clip(A x, lower, upper)")
      .def_readonly("working_set", &Answer::working_set)
      .def_readonly("factorizations", &Answer::factorizations,
                    "level factorisations done, at least one a non-empty level")
      .def_readonly("changes", &Answer::changes, "working-set changes")
      .def_readonly("final_levels", &Answer::final_levels, "levels known to be optimal")
      .def_readonly("optimality", &Answer::optimality,
                    "worst relative residual of the optimality conditions of all levels")
      .def_readonly("multipliers", &Answer::multipliers, kMultipliersDoc);
}

}  // namespace

void bind_solver(py::module_& module) {
  bind_level(module);
  bind_solution(module);
  py::class_<SolverOptions>(module, "SolverOptions")
      .def(py::init([](std::string method, int max_changes, int max_iterations) {
             return SolverOptions{.method = std::move(method),
                                  .max_changes = max_changes,
                                  .max_iterations = max_iterations};
           }),
           py::kw_only(), "method"_a = SolverOptions{}.method,
           "max_changes"_a = SolverOptions{}.max_changes,
           "max_iterations"_a = SolverOptions{}.max_iterations)
      .def_readwrite("method", &SolverOptions::method, "one of method_names()")
      .def_readwrite("max_changes", &SolverOptions::max_changes,
                     "working-set changes a solve, after which it ends with IterationLimit")
      .def_readwrite("max_iterations", &SolverOptions::max_iterations,
                     "of Algorithm 1 (rhqp_thesis, hqp, dls_hqp); thesis: 12 for dls_hqp");
  module.def("method_names", &method_names, kMethodNamesDoc);
  py::class_<Solver>(module, "Solver", kSolverDoc)
      .def(py::init<Index, SolverOptions>(), "n"_a, "options"_a = SolverOptions{})
      .def("solve", &solve, "levels"_a, kSolveDoc)
      .def("reset", &Solver::reset, "Forgets the working sets: the next solve is cold.")
      .def_property_readonly("n", &Solver::unknowns, "number of unknowns");
}

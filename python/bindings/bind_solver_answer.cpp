// solver, second half: what a solve answers.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <type_traits>

#include "annotated.hpp"
#include "arrays.hpp"
#include "hurcules/base/error.hpp"
#include "solver_answer.hpp"

namespace py = pybind11;
using namespace pybind11::literals;

void bind_solver_answer(py::module_& module);

using namespace hurcules;
using hurcules_bindings::Answer;
using hurcules_bindings::ArrayLike;
using hurcules_bindings::As;
using hurcules_bindings::matrix_of;
using hurcules_bindings::OptionalArrayLike;
using hurcules_bindings::vector_of;

namespace {

constexpr const char* kSolutionDoc =
    R"(The answer of one solve. No later solve and no later change of an array moves it.

multipliers, levels, jvp and vjp are computed when they are asked for.)";
constexpr const char* kMultipliersDoc =
    R"(multipliers[k][j] (m_j,): multipliers of level j's rows in the optimality of level k, j <= k.

multipliers[k][k] are the violations of level k. [T 3.4.116])";
constexpr const char* kLevelsDoc = "a LevelReport a final level";
constexpr const char* kJvpDoc =
    R"(How x moves with the numbers of the hierarchy: exact, with the working set held.

Args:
  changes: a LevelChange, or None for no change, a level; levels left out do not change.

Returns:
  dx (n,).

Raises:
  Error: shapes that do not fit; a solve that did not end Solved; a method without sensitivities.
)";
constexpr const char* kVjpDoc =
    R"(jvp transposed: the gradient of f(x) in all numbers of the hierarchy, from its gradient in x.

Args:
  x_bar: (n,) df/dx.

Returns:
  a LevelChange a level, with df/dA (m, n) (None for Bounds), df/dlower (m,), df/dupper (m,), df/drho.
  Where lower == upper is one number, its gradient is the sum of both.

Raises:
  Error: as jvp.
)";
constexpr const char* kChangeDoc =
    R"(A change of the numbers of one level, or a gradient in them. None: no change.

Args:
  A: (m, n). Bounds have none.
  lower, upper: (m,). An equality row moves with the mean of both.
  rho: of the regularisation.
)";

LevelChange make_change(const OptionalArrayLike& A, const OptionalArrayLike& lower,
                        const OptionalArrayLike& upper, double rho) {
  LevelChange change;
  if (!A.is_none()) change.A = matrix_of(A, "A", "(m, n)");
  if (!lower.is_none()) change.lower = vector_of(lower, "lower", "(m,)");
  if (!upper.is_none()) change.upper = vector_of(upper, "upper", "(m,)");
  change.rho = rho;
  return change;
}

Vector jvp(Answer& self,
           const As<"collections.abc.Sequence[hurcules._core.LevelChange | None]">& changes) {
  require(py::isinstance<py::sequence>(changes),
          "jvp wants a list of LevelChange or None, got " + std::string(py::repr(changes)));
  std::vector<LevelChange> list;
  for (const py::handle item : changes) {
    require(item.is_none() || py::isinstance<LevelChange>(item),
            "jvp wants a list of LevelChange or None, one is " + std::string(py::repr(item)));
    list.push_back(item.is_none() ? LevelChange() : item.cast<LevelChange>());
  }
  return self.sensitivity().forward(list);
}

std::vector<LevelChange> vjp(Answer& self, const ArrayLike& x_bar) {
  return self.sensitivity().transposed(vector_of(x_bar, "x_bar", "(n,)"));
}

void bind_enumerations(py::module_& module) {
  py::enum_<SolverStatus>(module, "Status", "How a solve ended.")
      .value("Solved", SolverStatus::Solved)
      .value("ReducedAccuracy", SolverStatus::ReducedAccuracy)
      .value("IterationLimit", SolverStatus::IterationLimit)
      .value("LostPrecision", SolverStatus::LostPrecision)
      .value("InvalidInput", SolverStatus::InvalidInput);
  py::enum_<Side>(module, "Side", "The side at which a row is held.")
      .value("Lower", Side::Lower)
      .value("Upper", Side::Upper);
}

void bind_active_row(py::module_& module) {
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
}

void bind_level_report(py::module_& module) {
  py::class_<LevelReport>(module, "LevelReport", "What a level could do, and what it cost.")
      .def_readonly("rho", &LevelReport::rho, "the regularisation that was used")
      .def_readonly("rank", &LevelReport::rank,
                    "directions that its equality rows take from the levels below")
      .def_readonly("singular_values", &LevelReport::singular_values,
                    "of its equality rows in the directions left by the equality rows above, "
                    "largest first")
      .def_readonly("handed_over", &LevelReport::handed_over,
                    "of each of these directions the weight with which the levels below get it: 0 "
                    "where the level keeps it, 1 where it sees nothing, between them by smooth "
                    "hand-over only")
      .def_readonly("infeasible", &LevelReport::infeasible,
                    "(m,) v_k: the part of the violation that no x allowed by the rows above and "
                    "the limits it meets removes [T 3.3.78]")
      .def_readonly("regularized", &LevelReport::regularized,
                    "(m,) u_k: the part that the regularisation costs, 0 for rho = 0 [T 3.3.80]");
}

void bind_level_change(py::module_& module) {
  const auto none = py::none();
  const auto array = [](const auto& values) {
    using Values = std::decay_t<decltype(values)>;
    return values.size() > 0 ? std::optional<Values>(values) : std::nullopt;
  };
  py::class_<LevelChange>(module, "LevelChange", kChangeDoc)
      .def(py::init(&make_change), "A"_a = none, "lower"_a = none, "upper"_a = none, "rho"_a = 0.0)
      .def_property_readonly(
          "A", [array](const LevelChange& self) { return array(self.A); }, "(m, n) or None")
      .def_property_readonly(
          "lower", [array](const LevelChange& self) { return array(self.lower); }, "(m,) or None")
      .def_property_readonly(
          "upper", [array](const LevelChange& self) { return array(self.upper); }, "(m,) or None")
      .def_readonly("rho", &LevelChange::rho);
}

// a property of the solution inside an answer
template <typename Value>
auto of(Value Solution::* member) {
  return [member](const Answer& self) -> const Value& { return self.solution().*member; };
}

}  // namespace

void bind_solver_answer(py::module_& module) {
  bind_enumerations(module);
  bind_active_row(module);
  bind_level_report(module);
  bind_level_change(module);
  py::class_<Answer>(module, "Solution", kSolutionDoc)
      .def_property_readonly("x", of(&Solution::x), "(n,)")
      .def_property_readonly("status", of(&Solution::status))
      .def_property_readonly("violations", of(&Solution::violations),
                             "per level (m,): A x - clip(A x, lower, upper)")
      .def_property_readonly("working_set", of(&Solution::working_set))
      .def_property_readonly("factorizations", of(&Solution::factorizations),
                             "level factorisations done, at least one a non-empty level")
      .def_property_readonly("changes", of(&Solution::changes), "working-set changes")
      .def_property_readonly("final_levels", of(&Solution::final_levels),
                             "levels known to be optimal")
      .def_property_readonly("optimality", of(&Solution::optimality),
                             "worst relative residual of the optimality conditions of all levels")
      .def_property_readonly("multipliers", &Answer::multipliers, kMultipliersDoc)
      .def_property_readonly("levels", &Answer::reports, kLevelsDoc)
      .def("jvp", &jvp, "changes"_a, kJvpDoc)
      .def("vjp", &vjp, "x_bar"_a, kVjpDoc);
}

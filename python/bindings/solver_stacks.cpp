#include "solver_stacks.hpp"

#include <algorithm>

#include "hurcules/base/error.hpp"

namespace py = pybind11;
using hurcules::BatchProblem;
using hurcules::Error;
using hurcules::Index;
using hurcules::LevelView;
using hurcules::require;

namespace hurcules_bindings {

namespace {

// with one axis more than a level has, when it comes so
SharedArray stacked(const py::object& value, py::ssize_t dimensions, const std::string& name,
                    const std::string& shape) {
  const py::array any = py::array::ensure(value);
  if (!any) PyErr_Clear();
  const bool has_slices = any && any.ndim() == dimensions + 1;
  return shared_array(value, has_slices ? dimensions + 1 : dimensions, name,
                      shape + " or (B, " + shape.substr(1));
}

py::ssize_t slices(const SharedArray& array, py::ssize_t dimensions) {
  return array.ndim() > dimensions ? array.shape(0) : 1;
}

// the numbers of slice i, or those that serve all
const double* slice(const SharedArray& array, py::ssize_t dimensions, py::ssize_t i) {
  if (array.ndim() == dimensions) return array.data();
  return array.data() + i * (array.size() / std::max<py::ssize_t>(1, array.shape(0)));
}

bool is_stackable(const SharedArray& array, py::ssize_t dimensions) {
  return is_readable(array, dimensions) || is_readable(array, dimensions + 1);
}

std::string shape_of(const SharedArray& array) {
  return py::str(array.attr("shape"));
}

// shapes; the numbers of the first slice stand for those of all until they are solved
void check_stack(const ArrayStack& stack) {
  require(stack.is_readable(), "stack: A, lower and upper want as many slices, got shapes " +
                                   (stack.bounds ? "" : shape_of(stack.A) + ", ") +
                                   shape_of(stack.lower) + ", " + shape_of(stack.upper));
  if (stack.count() > 0) check(stack.view(0), stack.unknowns(), "slice 0");
}

const ArrayStack& stack_of(py::handle item, std::size_t level) {
  if (!is_stack(item)) {
    throw Error("level " + std::to_string(level) +
                " wants to be a LevelStack or BoundsStack like the others, got " +
                std::string(py::repr(item)));
  }
  return item.cast<const ArrayStack&>();
}

}  // namespace

py::ssize_t ArrayStack::count() const {
  const py::ssize_t limits = std::max(slices(lower, 1), slices(upper, 1));
  const bool none = (lower.ndim() == 2 && lower.shape(0) == 0) ||
                    (upper.ndim() == 2 && upper.shape(0) == 0) ||
                    (!bounds && A.ndim() == 3 && A.shape(0) == 0);
  if (none) return 0;
  return bounds ? limits : std::max(limits, slices(A, 2));
}

Index ArrayStack::unknowns() const {
  return bounds ? lower.shape(lower.ndim() - 1) : A.shape(A.ndim() - 1);
}

LevelView ArrayStack::view(py::ssize_t i) const {
  const auto limits = [i](const SharedArray& array) {
    return Eigen::Map<const hurcules::Vector>(slice(array, 1, i), array.shape(array.ndim() - 1));
  };
  const Index rows = bounds ? 0 : A.shape(A.ndim() - 2), columns = bounds ? 0 : unknowns();
  return {.A = {slice(A, 2, i), rows, columns},
          .lower = limits(lower),
          .upper = limits(upper),
          .rho = rho,
          .bounds = bounds};
}

bool ArrayStack::is_readable() const {
  if (!is_stackable(A, 2) || !is_stackable(lower, 1) || !is_stackable(upper, 1)) return false;
  // one slice for all, or as many as the others
  const auto fits = [this](py::ssize_t own) { return own == 1 || own == count(); };
  return (bounds || fits(slices(A, 2))) && fits(slices(lower, 1)) && fits(slices(upper, 1));
}

ArrayStack make_stack(const ArrayLike& A, const ArrayLike& lower, const ArrayLike& upper,
                      const As<"float">& rho) {
  ArrayStack stack{.A = stacked(A, 2, "A", "(m, n)"),
                   .lower = stacked(lower, 1, "lower", "(m,)"),
                   .upper = stacked(upper, 1, "upper", "(m,)"),
                   .rho = number_of(rho)};
  check_stack(stack);
  return stack;
}

ArrayStack make_bounds_stack(const ArrayLike& lower, const ArrayLike& upper) {
  ArrayStack stack{.A = SharedArray(py::array::ShapeContainer{0, 0}),
                   .lower = stacked(lower, 1, "lower", "(n,)"),
                   .upper = stacked(upper, 1, "upper", "(n,)"),
                   .bounds = true};
  check_stack(stack);
  return stack;
}

bool is_stack(py::handle object) {
  return py::isinstance<ArrayStack>(object);
}

HeldStacks::HeldStacks(const py::tuple& stacks) : kept_(stacks) {
  py::ssize_t count = 1;
  std::vector<const ArrayStack*> levels;
  for (const py::handle item : kept_) {
    const ArrayStack& stack = stack_of(item, levels.size());
    const std::string name = "level " + std::to_string(levels.size());
    require(stack.is_readable(),
            name + ": an array was given another shape or layout after it was handed over");
    require(count == 1 || stack.count() == 1 || stack.count() == count,
            name + " is of " + std::to_string(stack.count()) + " hierarchies, those above are of " +
                std::to_string(count));
    if (count == 1) count = stack.count();
    levels.push_back(&stack);
  }
  const Index unknowns = levels.front()->unknowns();
  require(unknowns > 0, "level 0 has no unknowns");
  views_.reserve(static_cast<std::size_t>(count) * levels.size());
  problems_.reserve(static_cast<std::size_t>(count));
  for (py::ssize_t i = 0; i < count; ++i) {
    const std::size_t first = views_.size();
    for (const ArrayStack* stack : levels) views_.push_back(stack->view(i));
    problems_.push_back({unknowns, {views_.data() + first, levels.size()}});
  }
}

void HeldStacks::refuse(std::size_t problem) const {
  const BatchProblem& refused = problems_[problem];
  hurcules_bindings::refuse(refused.levels, refused.unknowns,
                            "problem " + std::to_string(problem) + ", ");
}

}  // namespace hurcules_bindings

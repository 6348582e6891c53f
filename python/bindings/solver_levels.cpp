#include "solver_levels.hpp"

#include <algorithm>
#include <utility>

#include "arrays.hpp"
#include "hurcules/base/error.hpp"

namespace py = pybind11;
using hurcules::Error;
using hurcules::Index;
using hurcules::LevelView;
using hurcules::require;

namespace hurcules_bindings {

namespace {

SharedArray copy_of(const hurcules::Vector& v) {
  return SharedArray(v.size(), v.data());
}

Eigen::Map<const hurcules::Vector> map_of(const SharedArray& array) {
  return {array.data(), array.shape(0)};
}

std::string text_of(const py::object& value) {
  return std::string(py::repr(value));
}

}  // namespace

SharedArray shared_array(const py::object& value, py::ssize_t dimensions, const std::string& name,
                         const std::string& shape) {
  // as it stands, when it can; else one Error or one copy
  if (SharedArray::check_(value)) {
    const auto array = py::reinterpret_borrow<SharedArray>(value);
    const bool aligned = (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
    if (aligned && array.ndim() == dimensions) return array;
  }
  return SharedArray::ensure(array_of(value, dimensions, name, shape));
}

bool is_readable(const SharedArray& array, py::ssize_t dimensions) {
  return array.ndim() == dimensions && (array.flags() & py::array::c_style) != 0;
}

double number_of(const py::object& rho) {
  if (py::isinstance<py::float_>(rho)) return rho.cast<double>();
  require(py::isinstance<py::int_>(rho) || py::hasattr(rho, "__float__"),
          "rho wants a number >= 0, got " + text_of(rho));
  return py::float_(rho);
}

bool ArrayLevel::is_readable() const {
  using hurcules_bindings::is_readable;
  return is_readable(A, 2) && is_readable(lower, 1) && is_readable(upper, 1);
}

LevelView ArrayLevel::view() const {
  return {.A = {A.data(), A.shape(0), A.shape(1)},
          .lower = map_of(lower),
          .upper = map_of(upper),
          .rho = rho,
          .bounds = bounds};
}

ArrayLevel make_level(const ArrayLike& A, const ArrayLike& lower, const ArrayLike& upper,
                      const As<"float">& rho) {
  ArrayLevel level{.A = shared_array(A, 2, "A", "(m, n)"),
                   .lower = shared_array(lower, 1, "lower", "(m,)"),
                   .upper = shared_array(upper, 1, "upper", "(m,)"),
                   .rho = number_of(rho)};
  check(level.view(), level.A.shape(1), "level");
  return level;
}

ArrayLevel make_bounds_level(const ArrayLike& lower, const ArrayLike& upper) {
  ArrayLevel level{.A = SharedArray(py::array::ShapeContainer{0, 0}),
                   .lower = shared_array(lower, 1, "lower", "(n,)"),
                   .upper = shared_array(upper, 1, "upper", "(n,)"),
                   .bounds = true};
  check(level.view(), level.lower.shape(0), "bounds");
  return level;
}

py::typing::List<ArrayLevel> copies_of(const hurcules::Hierarchy& hierarchy) {
  py::typing::List<ArrayLevel> levels;
  for (const hurcules::Level& level : hierarchy) {
    levels.append(ArrayLevel{
        .A = SharedArray(py::array::ShapeContainer{level.A.rows(), level.A.cols()}, level.A.data()),
        .lower = copy_of(level.lower),
        .upper = copy_of(level.upper),
        .rho = level.rho,
        .bounds = level.bounds});
  }
  return levels;
}

HeldLevels::HeldLevels(const py::object& levels, std::string name) : name_(std::move(name)) {
  // a text only when it is needed: it would cost more than the solve
  if (!py::isinstance<py::sequence>(levels)) {
    throw Error(name_ + "solve wants a list of Level and Bounds, got " + text_of(levels));
  }
  kept_ = py::tuple(levels);
  views_.reserve(kept_.size());
  for (const py::handle item : kept_) {
    py::detail::make_caster<ArrayLevel> caster;
    if (!caster.load(item, false) || item.is_none()) {
      throw Error(name_of(views_.size()) + " wants to be a Level or Bounds, got " +
                  std::string(py::repr(item)));
    }
    const ArrayLevel& level = caster;
    if (!level.is_readable()) {
      throw Error(name_of(views_.size()) +
                  ": an array was given another shape or layout after it was handed over");
    }
    views_.push_back(level.view());
  }
}

std::string HeldLevels::name_of(std::size_t level) const {
  return name_ + "level " + std::to_string(level);
}

Index HeldLevels::unknowns() const {
  require(!views_.empty(), name_ + "no level says how many unknowns there are");
  const LevelView& first = views_.front();
  const Index unknowns = first.bounds ? first.rows() : first.A.cols();
  require(unknowns > 0, name_of(0) + " has no unknowns");
  return unknowns;
}

void refuse(hurcules::HierarchyView levels, Index unknowns, const std::string& name) {
  for (std::size_t k = 0; k < levels.size(); ++k) {
    check(levels[k], unknowns, name + "level " + std::to_string(k));
  }
  throw Error(name + "a number changed to NaN, infinity or lower > upper during the solve");
}

}  // namespace hurcules_bindings

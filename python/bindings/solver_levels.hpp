// Levels as Python has them: references to numpy arrays, read anew by every solve.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <string>
#include <vector>

#include "annotated.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules_bindings {

// float64, C-contiguous and aligned: no copy; anything else is converted to that once
using SharedArray =
    pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast |
                                  pybind11::detail::npy_api::NPY_ARRAY_ALIGNED_>;

// `value` with this number of axes, as it stands when it can; `name` and `shape` for the text
[[nodiscard]] SharedArray shared_array(const pybind11::object& value, pybind11::ssize_t dimensions,
                                       const std::string& name, const std::string& shape);
// it still has this number of axes, in C order
[[nodiscard]] bool is_readable(const SharedArray& array, pybind11::ssize_t dimensions);
[[nodiscard]] double number_of(const pybind11::object& rho);
// throws the Error of what the solver refused; `name` comes before "level 2"
[[noreturn]] void refuse(hurcules::HierarchyView levels, hurcules::Index unknowns,
                         const std::string& name);

struct ArrayLevel {
  SharedArray A;             // (m, n); (0, 0) for simple bounds
  SharedArray lower, upper;  // (m)
  double rho = 0.0;
  bool bounds = false;

  // false when an array was given another number of axes or another layout in place
  [[nodiscard]] bool is_readable() const;
  [[nodiscard]] hurcules::LevelView view() const;
};

[[nodiscard]] ArrayLevel make_level(const ArrayLike& A, const ArrayLike& lower,
                                    const ArrayLike& upper, const As<"float">& rho);
[[nodiscard]] ArrayLevel make_bounds_level(const ArrayLike& lower, const ArrayLike& upper);
// levels of their own numbers
[[nodiscard]] pybind11::typing::List<ArrayLevel> copies_of(const hurcules::Hierarchy& hierarchy);

// A sequence of levels for the time of a solve: whatever another thread does to the sequence, the
// arrays stay.
class HeldLevels {
 public:
  // `name` comes before "level 2" in an Error
  explicit HeldLevels(const pybind11::object& levels, std::string name = "");

  [[nodiscard]] hurcules::HierarchyView views() const { return views_; }
  // of the first level: the others must fit
  [[nodiscard]] hurcules::Index unknowns() const;
  // throws the Error of what the solver refused
  [[noreturn]] void refuse(hurcules::Index unknowns) const {
    hurcules_bindings::refuse(views_, unknowns, name_);
  }

 private:
  [[nodiscard]] std::string name_of(std::size_t level) const;

  std::string name_;
  pybind11::tuple kept_;
  std::vector<hurcules::LevelView> views_;
};

}  // namespace hurcules_bindings

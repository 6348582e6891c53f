// Levels and stacks that keep the Python objects of their tasks alive.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "hurcules/control/stack.hpp"

namespace hurcules_bindings {

struct HeldLevel {
  hurcules::StackLevel level;
  std::vector<pybind11::object> kept;
};
struct HeldStack {
  hurcules::Stack stack;
  std::vector<pybind11::object> kept;
};

// levels as Stack takes them: a HeldStack, or a sequence of tasks, levels, lists of tasks
[[nodiscard]] HeldStack stack_of(const pybind11::object& levels);

}  // namespace hurcules_bindings

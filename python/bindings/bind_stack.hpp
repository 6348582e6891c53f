// Levels and stacks that keep the Python objects of their tasks alive.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

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

// what Stack takes: tasks, levels, lists of tasks
using Levels = pybind11::typing::Iterable<
    pybind11::typing::Union<hurcules::Task, hurcules::JointLimits, HeldLevel,
                            pybind11::typing::Iterable<pybind11::typing::Union<
                                hurcules::Task, hurcules::JointLimits, HeldLevel>>>>;
using StackLike = pybind11::typing::Union<HeldStack, Levels>;

[[nodiscard]] HeldStack stack_of(const pybind11::object& levels);

}  // namespace hurcules_bindings

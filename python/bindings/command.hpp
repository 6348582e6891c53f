// A command as Python gives it, as one array.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "arrays.hpp"
#include "hurcules/control/whole_body_controller.hpp"

namespace hurcules_bindings {

// (k) SI, or (rows, k): an array as it came, or values by the name of their channel; a channel that
// is not named holds (NaN). None for None. Throws Error for an unknown channel, another shape,
// numbers that are not finite.
std::optional<hurcules::Vector> command_of(const hurcules::WholeBodyController& controller,
                                           const pybind11::object& command);
std::optional<hurcules::Matrix> commands_of(const hurcules::WholeBodyController& controller,
                                            const pybind11::object& commands, hurcules::Index rows);

}  // namespace hurcules_bindings

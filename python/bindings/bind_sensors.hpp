// What bind_sim.cpp calls of bind_sensors.cpp.
#pragma once

#include <pybind11/pybind11.h>

#include "hurcules/sim/simulation.hpp"

namespace hurcules_bindings {

// before SimulationOptions, whose fields these types are
void bind_sensors(pybind11::module_& module);
void bind_sensor_results(pybind11::class_<hurcules::Simulation>& simulation);

}  // namespace hurcules_bindings

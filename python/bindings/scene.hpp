// The C structs behind objects of the package mujoco.
#pragma once

#include <pybind11/pybind11.h>

struct mjModel_;
struct mjData_;

namespace hurcules_bindings {

struct Scene {
  const mjModel_* model;
  mjData_* data;
};

// throws Error for objects of other classes, and for data of another model
Scene scene_of(const pybind11::object& model, const pybind11::object& data);

}  // namespace hurcules_bindings

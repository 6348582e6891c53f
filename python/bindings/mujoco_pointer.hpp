// The C structs behind the objects of the package mujoco.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules_bindings {

// `wanted`: "mujoco.NAME"; throws Error for anything else
template <typename Struct>
Struct* pointer(const pybind11::object& object, const char* wanted) {
  const auto type = pybind11::module_::import("mujoco").attr(wanted + sizeof("mujoco.") - 1);
  if (!pybind11::isinstance(object, type)) {
    throw hurcules::Error(
        std::string("a ") + wanted + " is wanted, a " +
        pybind11::str(pybind11::type::of(object).attr("__name__")).cast<std::string>() + " came");
  }
  return reinterpret_cast<Struct*>(object.attr("_address").cast<std::uintptr_t>());
}

// A model of Python's, which lives as long as anybody in C++ has it.
inline hurcules::ModelPtr held_model(const pybind11::object& object) {
  const auto* const model = pointer<const mjModel_>(object, "mujoco.MjModel");
  PyObject* const owner = pybind11::object(object).release().ptr();
  return {model, [owner](const mjModel_*) {
            if (!Py_IsInitialized()) return;
            const pybind11::gil_scoped_acquire lock;
            Py_DECREF(owner);
          }};
}

struct Scene {
  const mjModel_* model;
  mjData_* data;
};

// throws Error when they do not belong together
inline Scene scene_of(const pybind11::object& model, const pybind11::object& data) {
  const Scene scene{pointer<const mjModel_>(model, "mujoco.MjModel"),
                    pointer<mjData_>(data, "mujoco.MjData")};
  hurcules::require(pointer<const mjModel_>(data.attr("model"), "mujoco.MjModel") == scene.model,
                    "data wants to be of the model that came with it; it is of another one");
  return scene;
}

}  // namespace hurcules_bindings

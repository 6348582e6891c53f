#include "scene.hpp"

#include <cstdint>
#include <string>

#include "hurcules/base/error.hpp"

namespace py = pybind11;
using hurcules::Error;

namespace hurcules_bindings {

namespace {

template <typename Struct>
Struct* pointer(const py::object& object, const char* wanted) {
  if (!py::hasattr(object, "_address")) {
    throw Error(std::string("a ") + wanted + " is wanted, a " +
                py::str(py::type::of(object).attr("__name__")).cast<std::string>() + " came");
  }
  return reinterpret_cast<Struct*>(object.attr("_address").cast<std::uintptr_t>());
}

}  // namespace

Scene scene_of(const py::object& model, const py::object& data) {
  const Scene scene{pointer<const mjModel_>(model, "mujoco.MjModel"),
                    pointer<mjData_>(data, "mujoco.MjData")};
  hurcules::require(pointer<const mjModel_>(data.attr("model"), "mujoco.MjModel") == scene.model,
                    "data wants to be of the model that came with it; it is of another one");
  return scene;
}

}  // namespace hurcules_bindings

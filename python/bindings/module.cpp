// hurcules._core: the C++ library as a Python module. One bind_ROOM.cpp a room; this file calls
// them from the ground up.
#include <mujoco/mujoco.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"

namespace py = pybind11;

void bind_base(py::module_& module);
void bind_solver(py::module_& module);
void bind_robot(py::module_& module);
void bind_spring_force(py::module_& module);
void bind_tasks(py::module_& module);
void bind_limit_tasks(py::module_& module);
void bind_force(py::module_& module);
void bind_stack(py::module_& module);
void bind_control(py::module_& module);
void bind_acceleration(py::module_& module);
void bind_detour(py::module_& module);
void bind_joint_pid(py::module_& module);
void bind_drive(py::module_& module);
void bind_whole_body(py::module_& module);
void bind_plant(py::module_& module);
void bind_sim(py::module_& module);
void bind_batch(py::module_& module);
void bind_judge(py::module_& module);
void bind_power(py::module_& module);
void bind_mission(py::module_& module);

namespace {

constexpr const char* kDoc = "Compiled part of hurcules; use it through the package hurcules.";

// the loader picks libmujoco by its full version, so this fails only where somebody replaced the
// file
void check_mujoco() {
  if (mj_version() == mjVERSION_HEADER) return;
  throw py::import_error("hurcules was built with MuJoCo " + std::to_string(mjVERSION_HEADER) +
                         ", but the library that was loaded is " + std::to_string(mj_version()));
}

py::dict build() {
  py::dict facts;
  facts["version"] = HURCULES_VERSION;
  facts["mujoco"] = mj_versionString();
  facts["eigen"] = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                   "." + std::to_string(EIGEN_MINOR_VERSION);
  facts["simd"] = Eigen::SimdInstructionSetsInUse();
  facts["compiler"] = HURCULES_COMPILER;
  facts["build_type"] = HURCULES_BUILD_TYPE;
  facts["flags"] = HURCULES_FLAGS;
#ifdef NDEBUG
  facts["asserts"] = false;
#else
  facts["asserts"] = true;
#endif
  return facts;
}

// "self: hurcules._core.Park, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None" in short
std::string wanted_by(const std::string& setter) {
  const std::size_t begin = setter.find(": ", setter.find(", arg")) + 2;
  std::string text = setter.substr(begin, setter.rfind(") -> None") - begin);
  for (const auto& [long_name, short_name] :
       std::initializer_list<std::pair<std::string, std::string>>{
           {"typing.SupportsFloat | typing.SupportsIndex", "float"},
           {"typing.SupportsInt | typing.SupportsIndex", "int"},
           {"typing.Annotated[numpy.typing.ArrayLike, numpy.float64, \"[m, 1]\"]", "numbers (m,)"},
           {"collections.abc.", ""},
           {"hurcules._core.", ""}}) {
    for (std::size_t at; (at = text.find(long_name)) != std::string::npos;) {
      text.replace(at, long_name.size(), short_name);
    }
  }
  return text;
}

// An attribute that is given what it does not take says what was wanted and what came, as the
// constructors of options do; pybind11 lists its overloads.
py::cpp_function telling(const py::object& setter, const std::string& where) {
  const std::string signature = py::str(setter.attr("__doc__"));
  py::options texts;
  texts.disable_function_signatures();  // that of what it calls is told on
  return py::cpp_function(
      [setter, where, wanted = wanted_by(signature)](const py::object& self,
                                                     const py::object& value) {
        try {
          setter(self, value);
        } catch (py::error_already_set& error) {
          if (!error.matches(PyExc_TypeError)) throw;
          throw hurcules::Error(where + " wants " + wanted + ", got " +
                                std::string(py::repr(value)));
        }
      },
      py::doc(signature.c_str()));
}

void tell_wrong_types(const py::module_& module) {
  for (const auto& [_, kind] : py::cast<py::dict>(module.attr("__dict__").attr("copy")())) {
    if (!py::isinstance<py::type>(kind)) continue;
    const std::string owner = py::str(kind.attr("__name__"));
    for (const auto& [name, member] : py::dict(kind.attr("__dict__"))) {
      const bool is_property = py::isinstance(member, py::handle((PyObject*)&PyProperty_Type));
      if (!is_property || member.attr("fset").is_none()) continue;
      const std::string where = owner + ": " + std::string(py::str(name));
      kind.attr(name) = member.attr("setter")(telling(member.attr("fset"), where));
    }
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = kDoc;
  check_mujoco();
  // str -> str or bool: version, mujoco, eigen, simd, compiler, build_type, flags, asserts
  module.attr("build") = build();
  bind_base(module);
  bind_solver(module);
  bind_robot(module);
  bind_spring_force(module);
  bind_tasks(module);
  bind_limit_tasks(module);
  bind_force(module);
  bind_stack(module);
  bind_control(module);
  bind_acceleration(module);
  bind_detour(module);
  bind_joint_pid(module);
  bind_drive(module);
  bind_whole_body(module);
  bind_plant(module);
  bind_mission(module);
  bind_sim(module);
  bind_batch(module);
  bind_judge(module);
  bind_power(module);
  tell_wrong_types(module);
}

// base: the one exception.
#include <pybind11/pybind11.h>

#include "hurcules/base/error.hpp"

namespace py = pybind11;

namespace {

constexpr const char* kError =
    "Wrong input: what was wanted, what came, and for a name the names that exist.";

}  // namespace

void bind_base(py::module_& module) {
  auto error = py::register_exception<hurcules::Error>(module, "Error", PyExc_ValueError);
  error.doc() = kError;
  error.attr("__module__") = "hurcules";
}

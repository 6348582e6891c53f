// Old names of what is bound; each works for one release, with a DeprecationWarning.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace hurcules_bindings {

inline void warn_renamed(const std::string& old_name, const std::string& name) {
  const std::string text =
      old_name + " is called " + name + "; the old name goes with the next release";
  if (PyErr_WarnEx(PyExc_DeprecationWarning, text.c_str(), 1) != 0) {
    throw pybind11::error_already_set();
  }
}

}  // namespace hurcules_bindings

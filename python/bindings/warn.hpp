// Warnings of Python out of C++.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace hurcules_bindings {

// a UserWarning at the caller's line; "" is none
inline void warn(const std::string& text) {
  if (!text.empty() && PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0)
    throw pybind11::error_already_set();
}

}  // namespace hurcules_bindings

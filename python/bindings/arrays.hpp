// numpy -> Eigen at the wall: one clear Error instead of a list of overloads.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Geometry>
#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/base/types.hpp"

namespace hurcules_bindings {

using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// real numbers in `dimensions` dimensions; `name` and `shape` as the text should call them
inline Array array_of(const pybind11::object& value, pybind11::ssize_t dimensions,
                      const std::string& name, const std::string& shape) {
  namespace py = pybind11;
  const std::string wanted = name + " wants real numbers of shape " + shape + ", ";
  py::array any = py::array::ensure(value);
  if (!any) {
    PyErr_Clear();
    throw hurcules::Error(wanted + "an unusable " +
                          std::string(py::str(py::type::handle_of(value).attr("__name__"))) +
                          " came");
  }
  const std::string came =
      std::string(py::str(any.attr("shape"))) + " of " + std::string(py::str(any.dtype()));
  if (any.ndim() != dimensions ||
      std::string("biuf").find(any.dtype().kind()) == std::string::npos) {
    throw hurcules::Error(wanted + came + " came");
  }
  return Array::ensure(any);
}

inline hurcules::Vector vector_of(const pybind11::object& value, const std::string& name,
                                  const std::string& shape) {
  const Array array = array_of(value, 1, name, shape);
  return Eigen::Map<const hurcules::Vector>(array.data(), array.shape(0));
}

inline hurcules::Matrix matrix_of(const pybind11::object& value, const std::string& name,
                                  const std::string& shape) {
  const Array array = array_of(value, 2, name, shape);
  return Eigen::Map<const hurcules::Matrix>(array.data(), array.shape(0), array.shape(1));
}

// a rotation as a matrix (3, 3), or as a quaternion (4,) in MuJoCo's order, of any length
inline hurcules::Matrix3 rotation_from(const pybind11::object& value, const std::string& name) {
  const std::string wanted = "(3, 3), or a quaternion (4,) w x y z";
  const pybind11::array any = pybind11::array::ensure(value);
  PyErr_Clear();
  if (any && any.ndim() == 1) {
    const hurcules::Vector q = vector_of(value, name, wanted);
    const std::string came = name + " wants " + wanted + ", ";
    hurcules::require(q.size() == 4, came + "(" + std::to_string(q.size()) + ",) came");
    hurcules::require(q.allFinite() && q.norm() > 1e-6,
                      name + " wants a quaternion that is finite and not 0");
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
  const hurcules::Matrix R = matrix_of(value, name, wanted);
  hurcules::require(R.rows() == 3 && R.cols() == 3, name + " wants " + wanted + ", (" +
                                                        std::to_string(R.rows()) + ", " +
                                                        std::to_string(R.cols()) + ") came");
  return R;
}

}  // namespace hurcules_bindings

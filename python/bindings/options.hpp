// An options class bound by its fields: keywords, properties, repr, comparison and copies at once.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <Eigen/Core>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hurcules/base/error.hpp"

namespace hurcules_bindings {

// one field of an options class T, as Python sees it
template <typename T>
struct Field {
  std::string name;
  std::string type;  // as pybind11 writes it into signatures
  std::function<pybind11::object(const T&)> get;
  std::function<void(T&, pybind11::handle)> set;  // throws cast_error
  std::function<bool(const T&, const T&)> equal;
  std::function<void(pybind11::class_<T>&)> bind;  // the property
  bool required = false;
};

// what pybind11 calls the type of an argument; numbers as people call them
template <typename Value>
std::string type_text() {
  namespace py = pybind11;
  if constexpr (std::is_floating_point_v<Value>) return "float";
  if constexpr (std::is_integral_v<Value>) return std::is_same_v<Value, bool> ? "bool" : "int";
  const py::cpp_function probe([](const Value&) {}, py::arg("x"));
  const std::string text = py::str(probe.attr("__doc__"));
  const std::size_t begin = text.find("x: ") + 3;
  return text.substr(begin, text.rfind(") -> None") - begin);
}

template <typename T, typename Value>
Field<T> field(const char* name, Value T::* member, const char* doc = "") {
  namespace py = pybind11;
  const auto get = [member](const T& self) { return py::cast(self.*member); };
  const auto equal = [member, get](const T& one, const T& other) {
    if constexpr (std::is_base_of_v<Eigen::DenseBase<Value>, Value>) {
      return (one.*member).size() == (other.*member).size() && one.*member == other.*member;
    } else {
      return get(one).equal(get(other));
    }
  };
  return {.name = name,
          .type = type_text<Value>(),
          .get = get,
          .set = [member](T& self, py::handle value) { self.*member = value.cast<Value>(); },
          .equal = equal,
          .bind = [name, member,
                   doc](py::class_<T>& bound) { bound.def_readwrite(name, member, doc); }};
}

// one that T inherits: field<T>(...)
template <typename T, typename Base, typename Value>
  requires(!std::is_same_v<T, Base>)
Field<T> field(const char* name, Value Base::* member, const char* doc = "") {
  return field(name, static_cast<Value T::*>(member), doc);
}

// a field that Python sees as a text, such as an enumeration by its names
template <typename T, typename Get, typename Set>
Field<T> text_field(const char* name, Get get, Set set, const char* doc = "") {
  namespace py = pybind11;
  return {.name = name,
          .type = "str",
          .get = [get](const T& self) { return py::cast(std::string(get(self))); },
          .set = [set](T& self, py::handle value) { set(self, value.cast<std::string>()); },
          .equal = [get](const T& one, const T& other) { return get(one) == get(other); },
          .bind = [=](py::class_<T>& bound) { bound.def_property(name, get, set, doc); }};
}

// one without a default
template <typename T, typename Value>
Field<T> required(const char* name, Value T::* member, const char* doc = "") {
  Field<T> result = field(name, member, doc);
  result.required = true;
  return result;
}

enum class Arguments { Named, Positional };

template <typename T>
class Fields {
 public:
  Fields(std::string owner, std::vector<Field<T>> fields, Arguments arguments)
      : owner_(std::move(owner)), fields_(std::move(fields)), arguments_(arguments) {}

  // T with the defaults, and what was given
  T make(const pybind11::args& unnamed, const pybind11::kwargs& named) const {
    const std::size_t count = unnamed.size();
    if (count > (arguments_ == Arguments::Named ? 0 : fields_.size())) {
      throw pybind11::type_error(owner_ + " takes " +
                                 (arguments_ == Arguments::Named
                                      ? "keyword arguments only"
                                      : "at most " + std::to_string(fields_.size()) + " values"));
    }
    T result;
    for (std::size_t i = 0; i < count; ++i) set(result, fields_[i], unnamed[i]);
    for (const auto& [key, value] : named)
      set(result, find(std::string(pybind11::str(key))), value);
    for (std::size_t i = count; i < fields_.size(); ++i) {
      hurcules::require(!fields_[i].required || named.contains(fields_[i].name.c_str()),
                        owner_ + " wants " + fields_[i].name);
    }
    return result;
  }

  // __init__(self, *, dt: float = 0.001, ...) -> None
  std::string signature() const {
    std::string text = "__init__(self: hurcules._core." + owner_;
    if (arguments_ == Arguments::Named) text += ", *";
    for (const Field<T>& one : fields_) {
      text += ", " + one.name + ": " + one.type;
      if (!one.required) text += " = " + shown(one, T{});
    }
    return text + ") -> None\n";
  }

  // Owner(dt=0.001, ...)
  std::string repr(const T& self) const {
    std::string text;
    for (const Field<T>& one : fields_) {
      text += (text.empty() ? "" : ", ") + one.name + "=" + shown(one, self);
    }
    return owner_ + "(" + text + ")";
  }

  bool equal(const T& one, const T& other) const {
    for (const Field<T>& each : fields_) {
      if (!each.equal(one, other)) return false;
    }
    return true;
  }

  void bind(pybind11::class_<T>& bound) const {
    for (const Field<T>& one : fields_) one.bind(bound);
  }

 private:
  static std::string shown(const Field<T>& one, const T& self) {
    return pybind11::str(pybind11::repr(one.get(self)));
  }

  const Field<T>& find(const std::string& name) const {
    std::string known;
    for (const Field<T>& one : fields_) {
      if (one.name == name) return one;
      known += (known.empty() ? "" : ", ") + one.name;
    }
    throw hurcules::Error(owner_ + " has no option '" + name + "'; there are: " + known);
  }

  void set(T& result, const Field<T>& one, pybind11::handle value) const {
    try {
      one.set(result, value);
    } catch (const pybind11::cast_error&) {
      throw hurcules::Error(owner_ + ": " + one.name + " wants " + one.type + ", got " +
                            std::string(pybind11::repr(value)));
    }
  }

  std::string owner_;
  std::vector<Field<T>> fields_;
  Arguments arguments_;
};

// Binds T: made from keywords, its fields as properties, with repr, == and copies.
template <typename T>
pybind11::class_<T> bind_options(pybind11::module_& module, const char* name, const char* doc,
                                 std::vector<Field<T>> list,
                                 Arguments arguments = Arguments::Named) {
  namespace py = pybind11;
  const Fields<T> fields(name, std::move(list), arguments);
  py::class_<T> bound(module, name, doc);
  {
    py::options texts;
    texts.disable_function_signatures();  // they would say *args, **kwargs
    bound.def(py::init([fields](const py::args& unnamed, const py::kwargs& given) {
                return fields.make(unnamed, given);
              }),
              fields.signature().c_str());
  }
  fields.bind(bound);
  bound.def("__repr__", [fields](const T& self) { return fields.repr(self); })
      .def(
          "__eq__", [fields](const T& self, const T& other) { return fields.equal(self, other); },
          py::is_operator(), py::arg("other"))
      .def("__copy__", [](const T& self) { return T(self); })
      .def("__deepcopy__", [](const T& self, const py::dict&) { return T(self); }, py::arg("memo"));
  return bound;
}

}  // namespace hurcules_bindings

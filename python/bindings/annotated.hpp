// A Python object whose type a signature tells, for type checkers; whoever uses it checks it.
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>

namespace hurcules_bindings {

template <std::size_t N>
struct TypeText {
  // NOLINTNEXTLINE(google-explicit-constructor): As<"mujoco.MjModel">
  constexpr TypeText(const char (&text)[N]) { std::copy_n(text, N, value); }
  char value[N] = {};
};

inline bool is_object(PyObject* object) {
  return object != nullptr;
}

template <TypeText kText>
class As : public pybind11::object {
 public:
  PYBIND11_OBJECT_DEFAULT(As, object, is_object)
};

using ArrayLike = As<"numpy.typing.ArrayLike">;
using OptionalArrayLike = As<"numpy.typing.ArrayLike | None">;
using TaskObject = As<"hurcules._core.Task">;
using ScaleObject = As<"float | numpy.typing.ArrayLike">;
using CommandObject =
    As<"collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None">;
using AnyObject = As<"object">;
using ModelObject = As<"mujoco.MjModel">;
using DataObject = As<"mujoco.MjData">;

}  // namespace hurcules_bindings

template <hurcules_bindings::TypeText kText>
struct pybind11::detail::handle_type_name<hurcules_bindings::As<kText>> {
  static constexpr auto name = const_name(kText.value);
};

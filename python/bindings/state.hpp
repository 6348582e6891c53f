// state() and restore() of everything that keeps something between ticks.
#pragma once

#include <vector>

#include "hurcules/base/state.hpp"

namespace hurcules_bindings {

inline constexpr const char* kState =
    "What must be kept between ticks, as a flat list; see restore.";
inline constexpr const char* kRestore =
    "Goes on from what state() gave. Raises Error for a list of another length.";

template <typename Object>
std::vector<double> state(const Object& object) {
  std::vector<double> values;
  hurcules::StateWriter writer(values);
  object.save(writer);
  if constexpr (requires { object.save_settings(writer); }) object.save_settings(writer);
  return values;
}

template <typename Object>
void restore(Object& object, const std::vector<double>& values) {
  hurcules::StateReader reader(values);
  object.restore(reader);
  if constexpr (requires { object.restore_settings(reader); }) object.restore_settings(reader);
  hurcules::require(reader.at_end(),
                    "restore: the state is too long: it belongs to something else");
}

}  // namespace hurcules_bindings

// The names of a model's objects.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

struct mjModel_;

namespace hurcules {

// those of these types (mjOBJ_BODY, ...), in their order; what has no name is left out
[[nodiscard]] std::vector<std::string> names_of(const mjModel_& model,
                                                std::initializer_list<int> types);
// id of the object with this name; throws Error with the names that exist
[[nodiscard]] int find_object(const mjModel_& model, int type, const std::string& name);

}  // namespace hurcules

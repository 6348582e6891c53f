// The names of a model's objects.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

struct mjModel_;

namespace hurcules {

// "" where it has none
[[nodiscard]] std::string name_of(const mjModel_& model, int type, int id);
// for messages: "number 3" where it has none
[[nodiscard]] std::string name_or_number(const mjModel_& model, int type, int id);
// for messages: "geom 3 of forearm" where it has none
[[nodiscard]] std::string geom_name(const mjModel_& model, int geom);
// those of these types (mjOBJ_BODY, ...), in their order; what has no name is left out
[[nodiscard]] std::vector<std::string> names_of(const mjModel_& model,
                                                std::initializer_list<int> types);
// id of the object with this name; throws Error with the names that exist
[[nodiscard]] int find_object(const mjModel_& model, int type, const std::string& name);

// for messages: the first eight, then "and 3 more"
[[nodiscard]] std::string listed(const std::vector<std::string>& names,
                                 const std::string& between = ", ");

}  // namespace hurcules

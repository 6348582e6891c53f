#include "hurcules/robot/object_names.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

int count(const mjModel& m, int type) {
  switch (type) {
    case mjOBJ_SITE:
      return static_cast<int>(m.nsite);
    case mjOBJ_BODY:
      return static_cast<int>(m.nbody);
    case mjOBJ_JOINT:
      return static_cast<int>(m.njnt);
    case mjOBJ_CAMERA:
      return static_cast<int>(m.ncam);
    case mjOBJ_GEOM:
      return static_cast<int>(m.ngeom);
    case mjOBJ_ACTUATOR:
      return static_cast<int>(m.nu);
    case mjOBJ_SENSOR:
      return static_cast<int>(m.nsensor);
    case mjOBJ_KEY:
      return static_cast<int>(m.nkey);
    default:
      throw Error("names_of wants another type of objects");
  }
}

}  // namespace

std::string name_of(const mjModel& m, int type, int id) {
  const char* const name = mj_id2name(&m, type, id);
  return name ? name : "";
}

std::string name_or_number(const mjModel& m, int type, int id) {
  std::string name = name_of(m, type, id);
  return name.empty() ? "number " + std::to_string(id) : name;
}

std::string geom_name(const mjModel& m, int geom) {
  std::string name = name_of(m, mjOBJ_GEOM, geom);
  if (!name.empty()) return name;
  const std::string body = name_of(m, mjOBJ_BODY, m.geom_bodyid[geom]);
  name.append("geom ").append(std::to_string(geom));
  return body.empty() ? name : name.append(" of ").append(body);
}

std::vector<std::string> names_of(const mjModel& m, std::initializer_list<int> types) {
  std::vector<std::string> found;
  for (const int type : types)
    for (int i = 0; i < count(m, type); ++i)
      if (std::string name = name_of(m, type, i); !name.empty()) found.push_back(std::move(name));
  return found;
}

int find_object(const mjModel& m, int type, const std::string& name) {
  const int found = mj_name2id(&m, type, name.c_str());
  if (found < 0) throw Error(unknown_name(mju_type2Str(type), name, names_of(m, {type})));
  return found;
}

std::string listed(const std::vector<std::string>& names, const std::string& between) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i)
    text += (i == 0 ? "" : between) + names[i];
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

}  // namespace hurcules

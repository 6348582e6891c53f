#include "hurcules/robot/object_names.hpp"

#include <mujoco/mujoco.h>

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

std::vector<std::string> names_of(const mjModel& m, std::initializer_list<int> types) {
  std::vector<std::string> found;
  for (const int type : types)
    for (int i = 0; i < count(m, type); ++i)
      if (const char* name = mj_id2name(&m, type, i); name && *name) found.emplace_back(name);
  return found;
}

int find_object(const mjModel& m, int type, const std::string& name) {
  const int found = mj_name2id(&m, type, name.c_str());
  if (found < 0) throw Error(unknown_name(mju_type2Str(type), name, names_of(m, {type})));
  return found;
}

}  // namespace hurcules

# mujoco::mujoco, of exactly the version asked for: under MuJoCo_ROOT, else out of the installed Python wheel.
set(MuJoCo_FILE libmujoco.so.${MuJoCo_FIND_VERSION})
hurcules_python_package(mujoco MuJoCo_WHEEL)

# searched anew each time: the wheel of a pip build lies in a folder that is gone afterwards
find_library(MuJoCo_LIBRARY NAMES ${MuJoCo_FILE} HINTS "${MuJoCo_WHEEL}" ${HURCULES_HINTS} NO_CACHE)
find_path(MuJoCo_INCLUDE_DIR mujoco/mujoco.h HINTS "${MuJoCo_WHEEL}/include" ${HURCULES_HINTS} PATH_SUFFIXES include NO_CACHE)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MuJoCo
  REQUIRED_VARS MuJoCo_LIBRARY MuJoCo_INCLUDE_DIR)

if(MuJoCo_FOUND AND NOT TARGET mujoco::mujoco)
  add_library(mujoco::mujoco SHARED IMPORTED)
  set_target_properties(mujoco::mujoco PROPERTIES
    IMPORTED_LOCATION "${MuJoCo_LIBRARY}"
    IMPORTED_SONAME "${MuJoCo_FILE}"
    INTERFACE_INCLUDE_DIRECTORIES "${MuJoCo_INCLUDE_DIR}")
endif()

# mujoco::mujoco out of the installed Python wheel, of exactly the version that pyproject.toml pins.
file(READ "${PROJECT_SOURCE_DIR}/pyproject.toml" _pyproject)
string(REGEX MATCH "mujoco==([0-9.]+)" _ "${_pyproject}")
set(MuJoCo_VERSION "${CMAKE_MATCH_1}")

find_package(Python 3.11 REQUIRED COMPONENTS Interpreter OPTIONAL_COMPONENTS Development.Module)
execute_process(COMMAND "${Python_EXECUTABLE}" -c
  "import importlib.util as u, os; s = u.find_spec('mujoco'); print(os.path.dirname(s.origin) if s else '')"
  OUTPUT_VARIABLE MuJoCo_DIR OUTPUT_STRIP_TRAILING_WHITESPACE)
set(MuJoCo_LIBRARY "${MuJoCo_DIR}/libmujoco.so.${MuJoCo_VERSION}")
if(NOT EXISTS "${MuJoCo_LIBRARY}")
  message(FATAL_ERROR "mujoco ${MuJoCo_VERSION} not found for ${Python_EXECUTABLE} (looked for "
    "'${MuJoCo_LIBRARY}'): pip install mujoco==${MuJoCo_VERSION}")
endif()

if(NOT TARGET mujoco::mujoco)
  add_library(mujoco::mujoco SHARED IMPORTED)
  set_target_properties(mujoco::mujoco PROPERTIES
    IMPORTED_LOCATION "${MuJoCo_LIBRARY}"
    IMPORTED_SONAME "libmujoco.so.${MuJoCo_VERSION}"
    INTERFACE_INCLUDE_DIRECTORIES "${MuJoCo_DIR}/include")
endif()

# Eigen's headers come as a wheel too (cmeel-eigen)
execute_process(COMMAND "${Python_EXECUTABLE}" -c
  "import importlib.util as u; s = u.find_spec('cmeel'); print(list(s.submodule_search_locations)[0] + '.prefix' if s else '')"
  OUTPUT_VARIABLE _cmeel OUTPUT_STRIP_TRAILING_WHITESPACE)
list(APPEND CMAKE_PREFIX_PATH "${_cmeel}")

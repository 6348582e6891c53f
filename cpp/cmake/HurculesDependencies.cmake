# Eigen, threads and MuJoCo, where pip puts them or where the usual hints point; used by the build and by the installed package.
# Wants HURCULES_MUJOCO_VERSION; looks in HURCULES_HINTS last.
find_package(Python 3.11 QUIET COMPONENTS Interpreter OPTIONAL_COMPONENTS Development.Module)

# folder of an installed Python package, or "": nothing is imported
function(hurcules_python_package name folder)
  set(found "")
  if(Python_Interpreter_FOUND)
    execute_process(COMMAND "${Python_EXECUTABLE}" -c
      "import importlib.util as u; s = u.find_spec('${name}'); print(s.submodule_search_locations[0] if s else '')"
      OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
  set(${folder} "${found}" PARENT_SCOPE)
endfunction()

hurcules_python_package(cmeel HURCULES_CMEEL)
list(APPEND CMAKE_PREFIX_PATH "${HURCULES_CMEEL}.prefix")
find_package(Eigen3 3.4 QUIET NO_MODULE HINTS ${HURCULES_HINTS})
find_package(Threads QUIET)
find_package(MuJoCo ${HURCULES_MUJOCO_VERSION} EXACT QUIET)
set(HURCULES_MISSING "")
if(NOT Eigen3_FOUND)
  string(APPEND HURCULES_MISSING "Eigen 3.4 is missing. Remedy: pip install cmeel-eigen, or apt-get install libeigen3-dev, "
    "or -DEigen3_DIR=<folder of Eigen3Config.cmake>\n")
endif()
if(NOT Threads_FOUND)
  string(APPEND HURCULES_MISSING "The threads of the C library are missing\n")
endif()
if(NOT MuJoCo_FOUND)
  string(APPEND HURCULES_MISSING "libmujoco.so.${HURCULES_MUJOCO_VERSION} and its headers are neither under MuJoCo_ROOT nor in a "
    "Python package. Remedy: pip install mujoco==${HURCULES_MUJOCO_VERSION}\n")
endif()

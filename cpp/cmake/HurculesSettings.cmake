# How everything of ours is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# same bits everywhere: no fused or reordered arithmetic
add_compile_options(-ffp-contract=off)

if(HURCULES_ASSERTS)
  add_compile_options(-UNDEBUG)
endif()
if(HURCULES_TESTS)
  # tests forbid allocation in a tick; this arms Eigen's guard in optimised builds too
  add_compile_definitions(EIGEN_RUNTIME_NO_MALLOC)
  set(HURCULES_GUARD "${PROJECT_SOURCE_DIR}/tests/cpp/support/malloc_guard.hpp")
  add_compile_options("$<$<NOT:$<BOOL:$<TARGET_PROPERTY:PRECOMPILE_HEADERS>>>:SHELL:-include ${HURCULES_GUARD}>")
endif()

# One library a module: its links are its dependencies, and nothing else may link.

function(hurcules_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
  if(HURCULES_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# hurcules_room(NAME [LINKS module or target ...]): every source in cpp/hurcules/NAME and its folders
function(hurcules_room name)
  cmake_parse_arguments(ROOM "" "" "LINKS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/hurcules/${name}/*.cpp")
  add_library(hurcules_${name} STATIC ${sources})
  add_library(hurcules::${name} ALIAS hurcules_${name})
  set_target_properties(hurcules_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(hurcules_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}> $<INSTALL_INTERFACE:include>)
  target_compile_features(hurcules_${name} PUBLIC cxx_std_20)
  # one layout of Eigen's memory for the library and whoever links it, with AVX or without (base/types.hpp)
  target_compile_definitions(hurcules_${name} PUBLIC EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=1)
  hurcules_warnings(hurcules_${name})
  # eight sources at a time, which share what they instantiate of Eigen: three quarters of the work; two
  # names that clash want another name
  set_target_properties(hurcules_${name} PROPERTIES UNITY_BUILD ${HURCULES_PRECOMPILE} UNITY_BUILD_BATCH_SIZE 8)
  target_link_libraries(hurcules_${name} PUBLIC ${ROOM_LINKS})
  if(HURCULES_PRECOMPILE AND name STREQUAL "base")
    target_precompile_headers(hurcules_base PRIVATE
      <Eigen/Core> <Eigen/Geometry> <algorithm> <cmath> <functional> <memory> <optional> <string> <vector>)
  elseif(HURCULES_PRECOMPILE)
    target_precompile_headers(hurcules_${name} REUSE_FROM hurcules_base)
  endif()
endfunction()

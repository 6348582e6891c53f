# For C++ users: find_package(hurcules) gives hurcules::hurcules and <hurcules/ROOM/NAME.hpp>.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/hurcules")
set(rooms hurcules_base hurcules_solver hurcules_robot hurcules_tasks hurcules_control hurcules_mission hurcules_sim)

install(TARGETS hurcules ${rooms} EXPORT hurculesTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT cpp)
# but the inner loops of the kernels, which only kernels/impl.hpp's two sources can read
install(DIRECTORY hurcules DESTINATION include COMPONENT cpp FILES_MATCHING PATTERN "*.hpp"
  REGEX "/kernels/(impl|limits|rotations|rows|vectors)\\.hpp$" EXCLUDE)
install(EXPORT hurculesTargets NAMESPACE hurcules:: DESTINATION "${package_dir}" COMPONENT cpp)

# the MuJoCo and Eigen that we were built with, for users whose Python has none
get_filename_component(mujoco_dir "${MuJoCo_LIBRARY}" DIRECTORY)
set(hints "${mujoco_dir}" "${Eigen3_DIR}/../../..")
configure_package_config_file(cmake/hurculesConfig.cmake.in hurculesConfig.cmake INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file(hurculesConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    "${CMAKE_CURRENT_BINARY_DIR}/hurculesConfig.cmake"
    "${CMAKE_CURRENT_BINARY_DIR}/hurculesConfigVersion.cmake"
    cmake/HurculesDependencies.cmake
    cmake/FindMuJoCo.cmake
  DESTINATION "${package_dir}" COMPONENT cpp)

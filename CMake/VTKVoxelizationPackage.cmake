# find_package(VTKVoxelization), from the build tree and from an installed one. VTK's module build
# has already written the targets and the properties of the module beside it.

include(CMakePackageConfigHelpers)

set(package_binary_dir "${module_binary_dir}/${cmake_destination}")
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/VTKVoxelizationConfig.cmake.in"
  "${package_binary_dir}/VTKVoxelizationConfig.cmake"
  INSTALL_DESTINATION "${cmake_destination}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(
  "${package_binary_dir}/VTKVoxelizationConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${package_binary_dir}/VTKVoxelizationConfig.cmake"
    "${package_binary_dir}/VTKVoxelizationConfigVersion.cmake"
  DESTINATION "${cmake_destination}"
  COMPONENT development)

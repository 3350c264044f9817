# The project on its own: VTK's packages, options, the module, its wrapping, installation, tests.

get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT CMAKE_BUILD_TYPE AND NOT is_multi_config)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Kind of build" FORCE)
  set_property(CACHE CMAKE_BUILD_TYPE PROPERTY STRINGS Debug Release MinSizeRel RelWithDebInfo)
endif()

include(GNUInstallDirs)
include(CMakeDependentOption)
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")

# VTK's modules, named once here. The program reads and writes files; the tests compare with
# VTK's own filters.
set(module_components
  CommonCore CommonDataModel CommonExecutionModel CommonMath CommonMisc CommonSystem
  FiltersCore ParallelCore RenderingCore RenderingOpenGL2 RenderingVolume)
set(program_components
  FiltersCore FiltersGeneral FiltersGeometry
  IOCore IOGeometry IOImage IOLegacy IOPLY IOXML ImagingCore jsoncpp)
set(test_components
  ${program_components}
  CommonTransforms FiltersModeling FiltersSources ImagingGeneral ImagingHybrid ImagingMath
  ImagingMorphological ImagingStencil RenderingOpenGL2 RenderingVolumeOpenGL2
  TestingCore TestingRendering)
set(wrapping_components
  Python WrappingPythonCore WrappingTools)

# VTK before 9.5 hands empty keywords on to cmake_parse_arguments, which newer CMakes warn about.
set(CMAKE_POLICY_DEFAULT_CMP0174 NEW)

find_package(VTK 9.1 REQUIRED
  COMPONENTS ${module_components}
  OPTIONAL_COMPONENTS glad glew opengl)

option(VTKVOXELIZATION_BUILD_PROGRAM "Build the program vtkvoxelize" ON)
cmake_dependent_option(VTKVOXELIZATION_WRAP_PYTHON
  "Build the Python package vtkvoxelization" ON VTK_WRAP_PYTHON OFF)
option(VTKVOXELIZATION_BUILD_TESTING "Build the tests" ON)
cmake_dependent_option(VTKVOXELIZATION_BUILD_EXAMPLES
  "Build and run the examples as tests" OFF VTKVOXELIZATION_BUILD_TESTING OFF)
option(VTKVOXELIZATION_BUILD_BENCHMARKS "Build the benchmarks (needs Google Benchmark)" OFF)
option(VTKVOXELIZATION_WARNINGS_AS_ERRORS "Treat warnings in the project's code as errors" OFF)
option(VTKVOXELIZATION_SANITIZE
  "Check the project's code for bad addresses, leaks and undefined behaviour as it runs" OFF)
set(VTKVOXELIZATION_TORCH_PYTHON "" CACHE FILEPATH
  "A Python that imports VTK, PyTorch and trimesh, for the tests that want them; the one in use if empty")
cmake_dependent_option(VTKVOXELIZATION_FUZZ
  "Fuzz what reads files for some minutes as tests (needs clang and its libFuzzer)" OFF
  VTKVOXELIZATION_BUILD_TESTING OFF)
set(VTKVOXELIZATION_LARGE_DATA_DIR "" CACHE PATH
  "Folder with the large meshes; the tests that need them are left out if empty")

get_target_property(vtk_library_type VTK::CommonCore TYPE)
if(vtk_library_type STREQUAL "STATIC_LIBRARY")
  set(vtk_is_shared OFF)
else()
  set(vtk_is_shared ON)
endif()
option(BUILD_SHARED_LIBS "Build a shared library" ${vtk_is_shared})

set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")

# An installed tree works wherever it lies.
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
if(APPLE)
  set(rpath_origin "@loader_path")
else()
  set(rpath_origin "$ORIGIN")
endif()
file(RELATIVE_PATH bin_to_lib "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH "${rpath_origin}" "${rpath_origin}/${bin_to_lib}")

if(VTKVOXELIZATION_WRAP_PYTHON)
  include(VTKVoxelizationFindPython)
  set(torch_python "${Python3_EXECUTABLE}")
  if(VTKVOXELIZATION_TORCH_PYTHON)
    set(torch_python "${VTKVOXELIZATION_TORCH_PYTHON}")
  endif()
  find_package(VTK "${VTK_VERSION}" EXACT REQUIRED COMPONENTS ${wrapping_components})
endif()
include(VTKVoxelizationInstrument)

set(cmake_destination "${CMAKE_INSTALL_LIBDIR}/cmake/VTKVoxelization")
set(module_binary_dir "${CMAKE_BINARY_DIR}/Module")

# vtk_module_build adds the module's directory, which here is the project's own, a second time. It
# must then have a build directory of its own, which VTK derives from CMAKE_BINARY_DIR.
function(vtkvoxelization_build_module)
  set(CMAKE_BINARY_DIR "${module_binary_dir}")
  set(VTKVoxelization_OPENED_AS_MODULE ON)
  vtk_module_scan(
    MODULE_FILES "${CMAKE_SOURCE_DIR}/module.vtk"
    REQUEST_MODULES VTKVoxelization::Voxelization
    PROVIDES_MODULES modules
    ENABLE_TESTS OFF)
  vtk_module_build(
    MODULES ${modules}
    PACKAGE VTKVoxelization
    VERSION "${PROJECT_VERSION}"
    SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}"
    INSTALL_EXPORT VTKVoxelization
    HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/VTKVoxelization"
    CMAKE_DESTINATION "${cmake_destination}"
    TEST_DIRECTORY_NAME NONE)
endfunction()
vtkvoxelization_build_module()
vtkvoxelization_instrument(Voxelization)

include(VTKVoxelizationPackage)

if(VTKVOXELIZATION_WRAP_PYTHON)
  add_subdirectory(Wrapping/Python)
endif()
if(VTKVOXELIZATION_BUILD_PROGRAM)
  find_package(VTK "${VTK_VERSION}" EXACT REQUIRED COMPONENTS ${program_components})
  add_subdirectory(Wrapping/CommandLine)
endif()
if(VTKVOXELIZATION_BUILD_TESTING OR VTKVOXELIZATION_BUILD_BENCHMARKS)
  find_package(VTK "${VTK_VERSION}" EXACT REQUIRED COMPONENTS ${test_components})
  enable_testing()
  add_subdirectory(Testing)
endif()
if(VTKVOXELIZATION_BUILD_EXAMPLES)
  add_subdirectory(Examples)
endif()

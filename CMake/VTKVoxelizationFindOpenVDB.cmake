# Whether the readers and writers of .vdb files are built: the option VTKVOXELIZATION_USE_OPENVDB, on
# where OpenVDB is found. Then VTKVOXELIZATION_OPENVDB_LIBRARIES are the libraries that it takes and
# VTKVOXELIZATION_OPENVDB_INCLUDE_DIR has its headers. OpenVDB's own find module is passed over: it
# insists on parts of Boost that only its own build needs, and stops the configuration without them.
# Only this module's sources see OpenVDB, so that nothing that links the module has to find it.
include_guard()
include(CheckCXXSourceCompiles)

find_path(VTKVOXELIZATION_OPENVDB_INCLUDE_DIR openvdb/openvdb.h
  DOC "Directory that holds openvdb/openvdb.h")
mark_as_advanced(VTKVOXELIZATION_OPENVDB_INCLUDE_DIR)
set(VTKVOXELIZATION_OPENVDB_LIBRARIES)
foreach(library IN ITEMS openvdb tbb Imath)
  find_library("VTKVOXELIZATION_${library}_LIBRARY" NAMES "${library}" "${library}-3_1")
  mark_as_advanced("VTKVOXELIZATION_${library}_LIBRARY")
  if(VTKVOXELIZATION_${library}_LIBRARY)
    list(APPEND VTKVOXELIZATION_OPENVDB_LIBRARIES "${VTKVOXELIZATION_${library}_LIBRARY}")
  endif()
endforeach()

# OpenVDB 10 and later; a library without what it takes does not link.
set(VTKVOXELIZATION_HAS_OPENVDB OFF)
if(VTKVOXELIZATION_OPENVDB_INCLUDE_DIR AND VTKVOXELIZATION_openvdb_LIBRARY)
  set(CMAKE_REQUIRED_INCLUDES "${VTKVOXELIZATION_OPENVDB_INCLUDE_DIR}")
  set(CMAKE_REQUIRED_LIBRARIES ${VTKVOXELIZATION_OPENVDB_LIBRARIES})
  set(CMAKE_REQUIRED_FLAGS "${CMAKE_CXX17_STANDARD_COMPILE_OPTION}")
  check_cxx_source_compiles(
    "#include <openvdb/io/Archive.h>
    #include <openvdb/openvdb.h>
    static_assert(OPENVDB_LIBRARY_MAJOR_VERSION_NUMBER >= 10, \"\");
    int main() { openvdb::initialize(); return 0; }"
    VTKVOXELIZATION_OPENVDB_COMPILES)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_LIBRARIES)
  unset(CMAKE_REQUIRED_FLAGS)
  set(VTKVOXELIZATION_HAS_OPENVDB "${VTKVOXELIZATION_OPENVDB_COMPILES}")
endif()

option(VTKVOXELIZATION_USE_OPENVDB
  "Build vtkVDBVoxelReader and vtkVDBVoxelWriter (needs OpenVDB 10 or later)"
  "${VTKVOXELIZATION_HAS_OPENVDB}")
if(VTKVOXELIZATION_USE_OPENVDB AND NOT VTKVOXELIZATION_HAS_OPENVDB)
  message(FATAL_ERROR
    "VTKVOXELIZATION_USE_OPENVDB is on, but no OpenVDB 10 or later that compiles and links was "
    "found: headers in \"${VTKVOXELIZATION_OPENVDB_INCLUDE_DIR}\", libraries "
    "\"${VTKVOXELIZATION_OPENVDB_LIBRARIES}\". Install it (libopenvdb-dev), tell where it is with "
    "-DCMAKE_PREFIX_PATH=DIR, or turn the option off.")
endif()

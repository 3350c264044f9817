# Finds the Python that VTK was built for, which need not be the first one on PATH: the one that
# imports the extension modules of the very VTK in use. Sets Python3_EXECUTABLE and what
# find_package(Python3) gives, and VTKVOXELIZATION_VTK_PYTHONPATH, the directory of VTK's Python
# package.

set(VTKVOXELIZATION_VTK_PYTHONPATH "${VTK_PREFIX_PATH}/${VTK_PYTHONPATH}")

# VTK's extension modules say which Python runs them, by their names: vtkX.cpython-311-*.so.
set(python_names python3)
file(GLOB vtk_extensions "${VTKVOXELIZATION_VTK_PYTHONPATH}/vtkmodules/vtkCommonCore.cpython-3*")
if(vtk_extensions MATCHES "cpython-3([0-9]+)")
  list(PREPEND python_names "python3.${CMAKE_MATCH_1}")
endif()

function(vtkvoxelization_runs_vtk result python)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${VTKVOXELIZATION_VTK_PYTHONPATH}"
      "${python}" -c
      "from vtkmodules.vtkCommonCore import vtkVersion; print(vtkVersion.GetVTKVersion())"
    OUTPUT_VARIABLE version
    OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET)
  if(version STREQUAL VTK_VERSION)
    set("${result}" TRUE PARENT_SCOPE)
  else()
    set("${result}" FALSE PARENT_SCOPE)
  endif()
endfunction()

if(NOT Python3_EXECUTABLE)
  find_program(VTKVOXELIZATION_PYTHON_EXECUTABLE
    NAMES ${python_names}
    NAMES_PER_DIR
    HINTS "${VTK_PREFIX_PATH}/bin" "${VTK_PREFIX_PATH}" /usr/bin
    VALIDATOR vtkvoxelization_runs_vtk
    DOC "The Python that VTK was built for")
  mark_as_advanced(VTKVOXELIZATION_PYTHON_EXECUTABLE)
  if(NOT VTKVOXELIZATION_PYTHON_EXECUTABLE)
    message(FATAL_ERROR
      "No Python was found that imports VTK ${VTK_VERSION} from "
      "${VTKVOXELIZATION_VTK_PYTHONPATH}. Install VTK's Python package, name the interpreter with "
      "-DPython3_EXECUTABLE=PATH, or leave the wrapping out with -DVTKVOXELIZATION_WRAP_PYTHON=OFF.")
  endif()
  set(Python3_EXECUTABLE "${VTKVOXELIZATION_PYTHON_EXECUTABLE}")
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
message(STATUS "Wrapping for Python ${Python3_VERSION}: ${Python3_EXECUTABLE}")

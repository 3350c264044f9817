# vtkvoxelization_instrument(<target>...) gives targets of this project, and nothing that links
# them, the warnings and sanitizers that were asked for.

set(VTKVOXELIZATION_COMPILE_OPTIONS)
set(VTKVOXELIZATION_LINK_OPTIONS)
set(VTKVOXELIZATION_SANITIZERS)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS -Wall -Wextra -Wshadow)
  if(VTKVOXELIZATION_WARNINGS_AS_ERRORS)
    list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS -Werror)
  endif()
  if(VTKVOXELIZATION_SANITIZE)
    set(VTKVOXELIZATION_SANITIZERS -fsanitize=address,undefined -fno-sanitize-recover=all)
    list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS
      ${VTKVOXELIZATION_SANITIZERS} -fno-omit-frame-pointer)
    list(APPEND VTKVOXELIZATION_LINK_OPTIONS ${VTKVOXELIZATION_SANITIZERS})
  endif()
elseif(MSVC)
  list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS /W4)
  if(VTKVOXELIZATION_WARNINGS_AS_ERRORS)
    list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS /WX)
  endif()
  if(VTKVOXELIZATION_SANITIZE)
    set(VTKVOXELIZATION_SANITIZERS /fsanitize=address)
    list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS ${VTKVOXELIZATION_SANITIZERS})
  endif()
endif()

function(vtkvoxelization_instrument)
  foreach(target IN LISTS ARGN)
    target_compile_options("${target}" PRIVATE ${VTKVOXELIZATION_COMPILE_OPTIONS})
    target_link_options("${target}" PRIVATE ${VTKVOXELIZATION_LINK_OPTIONS})
    get_target_property(type "${target}" TYPE)
    if(VTKVOXELIZATION_SANITIZE AND type STREQUAL "EXECUTABLE" AND UNIX)
      target_sources("${target}" PRIVATE
        "${PROJECT_SOURCE_DIR}/Testing/Sanitizers/KeepLibraries.cxx")
    endif()
  endforeach()
endfunction()

# Leaks that are known, and not this project's.
set(VTKVOXELIZATION_LEAKS_ENVIRONMENT
  "LSAN_OPTIONS=set:suppressions=${PROJECT_SOURCE_DIR}/Testing/Sanitizers/leaks.txt:print_suppressions=0")

# How tests run under the sanitizers. GCC 12's guess where a library keeps its thread-local variables
# can be wrong, and the leak check then crashes: it is not to guess.
set(VTKVOXELIZATION_SANITIZE_ENVIRONMENT)
if(VTKVOXELIZATION_SANITIZE)
  set(VTKVOXELIZATION_SANITIZE_ENVIRONMENT
    "ASAN_OPTIONS=set:intercept_tls_get_addr=0"
    "${VTKVOXELIZATION_LEAKS_ENVIRONMENT}"
    "UBSAN_OPTIONS=set:print_stacktrace=1")
endif()

# The Python interpreter knows nothing of the sanitizers and keeps memory of its own until the end. It
# alone reads the options in the file that bears its name; programs that it starts do not. Nor has it
# the C++ library at its start, when the sanitizer looks for the function that throws exceptions.
set(VTKVOXELIZATION_SANITIZE_PYTHON_ENVIRONMENT)
if(VTKVOXELIZATION_SANITIZE AND VTKVOXELIZATION_WRAP_PYTHON AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(preloaded)
  foreach(library IN ITEMS libasan.so libstdc++.so)
    execute_process(
      COMMAND "${CMAKE_CXX_COMPILER}" "-print-file-name=${library}"
      OUTPUT_VARIABLE path
      OUTPUT_STRIP_TRAILING_WHITESPACE
      COMMAND_ERROR_IS_FATAL ANY)
    list(APPEND preloaded "${path}")
  endforeach()
  list(JOIN preloaded ":" preloaded)
  set(options_by_program "${CMAKE_BINARY_DIR}/Sanitizers")
  file(REAL_PATH "${Python3_EXECUTABLE}" interpreter)
  get_filename_component(interpreter "${interpreter}" NAME)
  file(WRITE "${options_by_program}/${interpreter}" "detect_leaks=0\n")
  set(VTKVOXELIZATION_SANITIZE_PYTHON_ENVIRONMENT
    "LD_PRELOAD=set:${preloaded}"
    "ASAN_OPTIONS=path_list_append:include_if_exists=${options_by_program}/%b")
endif()

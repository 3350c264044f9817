# vtkvoxelization_instrument(<target>...) gives targets of this project, and nothing that links
# them, the warnings and sanitizers that were asked for.

set(VTKVOXELIZATION_COMPILE_OPTIONS)
set(VTKVOXELIZATION_LINK_OPTIONS)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS -Wall -Wextra -Wshadow)
  if(VTKVOXELIZATION_WARNINGS_AS_ERRORS)
    list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS -Werror)
  endif()
  if(VTKVOXELIZATION_SANITIZE)
    set(sanitizers -fsanitize=address,undefined -fno-sanitize-recover=all)
    list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS ${sanitizers} -fno-omit-frame-pointer)
    list(APPEND VTKVOXELIZATION_LINK_OPTIONS ${sanitizers})
  endif()
elseif(MSVC)
  list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS /W4)
  if(VTKVOXELIZATION_WARNINGS_AS_ERRORS)
    list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS /WX)
  endif()
  if(VTKVOXELIZATION_SANITIZE)
    list(APPEND VTKVOXELIZATION_COMPILE_OPTIONS /fsanitize=address)
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

# The interpreter knows nothing of the sanitizers and keeps memory of its own until the end.
set(VTKVOXELIZATION_SANITIZE_PYTHON_ENVIRONMENT)
if(VTKVOXELIZATION_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  execute_process(
    COMMAND "${CMAKE_CXX_COMPILER}" -print-file-name=libasan.so
    OUTPUT_VARIABLE address_sanitizer
    OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  set(VTKVOXELIZATION_SANITIZE_PYTHON_ENVIRONMENT
    "LD_PRELOAD=set:${address_sanitizer}" "ASAN_OPTIONS=set:detect_leaks=0")
endif()

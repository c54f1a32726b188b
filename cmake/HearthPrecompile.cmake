# Precompiled headers: the standard headers that most sources include are parsed once for each set of compiler
# flags. A source still includes all headers that it uses: ./dev test compiles each header alone, without
# precompiled headers, and a build with -DHEARTH_PRECOMPILE=OFF compiles the sources without them.
set(hearth_precompiled_headers
  <algorithm> <array> <bit> <cmath> <cstddef> <cstdint> <cstdio> <cstring> <functional> <limits> <map> <memory> <numbers>
  <optional> <span> <string> <string_view> <utility> <vector>)

# hearth_precompiled_library(NAME HEADERS ... LINKS ...): headers to precompile with the flags of LINKS.
function(hearth_precompiled_library name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINKS;OPTIONS" ${ARGN})
  if(NOT HEARTH_PRECOMPILE)
    return()
  endif()
  set(source ${PROJECT_BINARY_DIR}/${name}.cpp) # a precompiled header belongs to a target, and a target has a source
  file(CONFIGURE OUTPUT ${source} CONTENT "// Generated.\n")
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${name} PRIVATE hearth_settings hearth_warnings ${ARG_LINKS})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# hearth_precompile(TARGET PRECOMPILED): TARGET uses the precompiled headers of PRECOMPILED, and must share
# its compiler flags.
function(hearth_precompile target precompiled)
  if(HEARTH_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${precompiled})
  endif()
endfunction()

hearth_precompiled_library(hearth_precompiled HEADERS ${hearth_precompiled_headers})
hearth_precompiled_library(hearth_precompiled_without_exceptions
  HEADERS ${hearth_precompiled_headers}
  OPTIONS -fno-exceptions)
if(HEARTH_SANITIZE)
  hearth_precompiled_library(hearth_precompiled_optimised
    HEADERS ${hearth_precompiled_headers}
    OPTIONS ${hearth_sanitized_optimisation})
endif()

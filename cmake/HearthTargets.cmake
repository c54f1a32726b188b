# Functions that define targets. `cmake --build` without a target builds the product.
add_custom_target(hearth_product ALL COMMENT "hearth, the cookers, hearth-samples, hearth-render, hearth-compare, the libraries")
add_custom_target(hearth_demo COMMENT "The programs that ./dev demo runs")
add_custom_target(hearth_tests COMMENT "All test programs, and the programs that they run")
add_custom_target(hearth_unit_tests COMMENT "The tests that run under the address sanitizer, and the programs that they run")
add_custom_target(hearth_untrusted_tests COMMENT "Those of them that read bytes from outside")
add_custom_target(hearth_threads_tests COMMENT "The tests that run under the thread sanitizer")
add_custom_target(hearth_benches COMMENT "Benchmarks and measuring programs")
add_dependencies(hearth_tests hearth_product)

# hearth_library(NAME SOURCES ... LINKS ... PRIVATE_LINKS ... [NO_EXCEPTIONS] [COMPUTES]): a static library
# with the project's warnings. LINKS are the dependencies of the architecture; PRIVATE_LINKS are third-party
# libraries that only the .cpp files use. COMPUTES: the library is optimised in sanitizer builds too, because
# its tests compute much; the rest is not, since compiling would take longer than it saves.
function(hearth_library name)
  cmake_parse_arguments(ARG "NO_EXCEPTIONS;COMPUTES" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC hearth_settings ${ARG_LINKS} PRIVATE hearth_warnings ${ARG_PRIVATE_LINKS})
  set(precompiled hearth_precompiled)
  if(ARG_NO_EXCEPTIONS)
    target_compile_options(${name} PRIVATE -fno-exceptions)
    string(APPEND precompiled _without_exceptions)
  endif()
  if(ARG_COMPUTES AND HEARTH_SANITIZE)
    target_compile_options(${name} PRIVATE ${hearth_sanitized_optimisation})
    string(APPEND precompiled _optimised)
  endif()
  hearth_precompile(${name} ${precompiled})
endfunction()

configure_file(${CMAKE_CURRENT_LIST_DIR}/program_version.cpp.in ${PROJECT_BINARY_DIR}/program_version.cpp @ONLY)

# hearth_archive(NAME OBJECTS_OF ... EXPORTS_AS X INCLUDES DIRECTORY): a static library for users of Hearth,
# hearth::X, of all objects of the named libraries, without the project's own compiler settings. INCLUDES is
# the folder of its headers in the source tree.
function(hearth_archive name)
  cmake_parse_arguments(ARG "" "EXPORTS_AS;INCLUDES" "OBJECTS_OF" ${ARGN})
  list(TRANSFORM ARG_OBJECTS_OF REPLACE ".+" "$<TARGET_OBJECTS:\\0>")
  add_library(${name} STATIC ${ARG_OBJECTS_OF})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  # by linker names: a target would have to exist in the user's project
  target_link_libraries(${name} INTERFACE zstd xxhash)
  hearth_export(${name} ${ARG_EXPORTS_AS} ${ARG_INCLUDES})
endfunction()

# hearth_export(NAME X INCLUDES): export the library to users as hearth::X, both installed and as a
# subdirectory.
function(hearth_export name exports_as includes)
  add_library(hearth::${exports_as} ALIAS ${name})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${exports_as})
  target_include_directories(${name} INTERFACE $<BUILD_INTERFACE:${includes}>)
  set_property(GLOBAL APPEND PROPERTY HEARTH_EXPORTS ${name})
endfunction()

# hearth_executable(NAME SOURCES ... LINKS ... [ON_DEMAND]): a program in <build>/bin. Programs called
# hearth-... are installed, except those of tests/. ON_DEMAND: it is built only when named, not with the
# product.
function(hearth_executable name)
  cmake_parse_arguments(ARG "ON_DEMAND" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES} ${PROJECT_BINARY_DIR}/program_version.cpp)
  set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ${ARG_ON_DEMAND})
  target_link_libraries(${name} PRIVATE hearth_settings hearth_warnings ${ARG_LINKS})
  hearth_precompile(${name} hearth_precompiled)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(name MATCHES "^hearth(-[a-z0-9]+)*$" AND NOT folder MATCHES "^tests/")
    set_property(GLOBAL APPEND PROPERTY HEARTH_PROGRAMS ${name})
  endif()
endfunction()

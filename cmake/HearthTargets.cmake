# What one sanitizer runs can be built alone: the tests of a label, and for the unit tests all programs, which some of them start.
add_custom_target(hearth_unit_tests)
add_custom_target(hearth_threads_tests)

# hearth_library(NAME SOURCES ... LINKS ... PRIVATE_LINKS ...): a static library held to the house's warnings.
# LINKS are the arrows of DESIGN; PRIVATE_LINKS are third-party libraries that stay inside the .cpp files.
function(hearth_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC hearth_settings ${ARG_LINKS} PRIVATE hearth_warnings ${ARG_PRIVATE_LINKS})
endfunction()

configure_file(${CMAKE_CURRENT_LIST_DIR}/program_version.cpp.in ${PROJECT_BINARY_DIR}/program_version.cpp @ONLY)

# hearth_archive(NAME OBJECTS_OF ... EXPORTS_AS X INCLUDES DIRECTORY): a static library for those who use Hearth, hearth::X,
# of all that the named libraries are compiled to, without the settings that hold inside the house. INCLUDES is where
# its headers lie here.
function(hearth_archive name)
  cmake_parse_arguments(ARG "" "EXPORTS_AS;INCLUDES" "OBJECTS_OF" ${ARGN})
  list(TRANSFORM ARG_OBJECTS_OF REPLACE ".+" "$<TARGET_OBJECTS:\\0>")
  add_library(${name} STATIC ${ARG_OBJECTS_OF})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  # by the names of the linker: a target would be one of the caller's project, who need not have it
  target_link_libraries(${name} INTERFACE zstd xxhash)
  hearth_export(${name} ${ARG_EXPORTS_AS} ${ARG_INCLUDES})
endfunction()

# hearth_export(NAME X INCLUDES): those who use Hearth know the library as hearth::X, installed or as a folder of theirs.
function(hearth_export name exports_as includes)
  add_library(hearth::${exports_as} ALIAS ${name})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${exports_as})
  target_include_directories(${name} INTERFACE $<BUILD_INTERFACE:${includes}>)
  set_property(GLOBAL APPEND PROPERTY HEARTH_EXPORTS ${name})
endfunction()

# hearth_executable(NAME SOURCES ... LINKS ...): a program in <build>/bin. Users get those that are called hearth-...,
# unless they are of tests/.
function(hearth_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES} ${PROJECT_BINARY_DIR}/program_version.cpp)
  target_link_libraries(${name} PRIVATE hearth_settings hearth_warnings ${ARG_LINKS})
  add_dependencies(hearth_unit_tests ${name})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(name MATCHES "^hearth(-[a-z0-9]+)*$" AND NOT folder MATCHES "^tests/")
    set_property(GLOBAL APPEND PROPERTY HEARTH_PROGRAMS ${name})
  endif()
endfunction()

# hearth_test(NAME SOURCES ... LINKS ... LABELS ... LAUNCHER ...): a GoogleTest program, registered as one ctest per program.
# LAUNCHER is a command that runs it.
function(hearth_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINKS;LABELS;LAUNCHER" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE hearth_settings hearth_warnings ${ARG_LINKS} GTest::gtest GTest::gmock GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND ${ARG_LAUNCHER} $<TARGET_FILE:${name}>)
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  # a test cooks what it tests, and leaves the cache of whoever runs it alone
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "HEARTH_CACHE=off")
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
  foreach(label unit threads)
    if(label IN_LIST ARG_LABELS)
      add_dependencies(hearth_${label}_tests ${name})
    endif()
  endforeach()
endfunction()

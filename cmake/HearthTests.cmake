# Functions that define the tests: a few programs, and a ctest entry for each subject.
find_package(GTest 1.12 REQUIRED)

hearth_precompiled_library(hearth_precompiled_tests
  HEADERS ${hearth_precompiled_headers} <gtest/gtest.h>
  LINKS GTest::gtest
  OPTIONS ${hearth_test_options})

# hearth_test(NAME [COMPUTES] SOURCES ... LINKS ... [LABELS ...] [RUNS ...] [DEFINITIONS ...] [LAUNCHER ...]
# [TIMEOUT SECONDS] [COST SECONDS]): a ctest entry that runs the tests of SOURCES. All entries of a folder
# with the same labels are linked into one program, FOLDER_LABELS_tests in <build>/tests; each entry runs in
# its own process.
#   RUNS      programs of the project that the test starts, from the folder HEARTH_BIN
#   LAUNCHER  a command that runs the test program
#   COMPUTES  the test computes for minutes unless it is optimised: it is optimised in sanitizer builds too
#   COST      approximate duration of a long test: ctest starts the longest first
function(hearth_test name)
  cmake_parse_arguments(ARG "COMPUTES" "TIMEOUT;COST" "SOURCES;LINKS;LABELS;RUNS;DEFINITIONS;LAUNCHER" ${ARGN})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR}/tests ${CMAKE_CURRENT_SOURCE_DIR})
  set(words ${folder} ${ARG_LABELS})
  if(folder IN_LIST hearth_untrusted_folders AND "unit" IN_LIST ARG_LABELS)
    list(APPEND ARG_LABELS untrusted)
  endif()
  list(REMOVE_DUPLICATES words)
  string(REPLACE ";" "_" program "${words};tests")
  if(NOT TARGET ${program})
    hearth_test_program(${program})
    foreach(label unit threads untrusted)
      if(label IN_LIST ARG_LABELS)
        add_dependencies(hearth_${label}_tests ${program})
      endif()
    endforeach()
  endif()
  target_sources(${program} PRIVATE ${ARG_SOURCES})
  target_link_libraries(${program} PRIVATE ${ARG_LINKS})
  target_compile_definitions(${program} PRIVATE ${ARG_DEFINITIONS})
  if(ARG_COMPUTES AND HEARTH_SANITIZE)
    set_source_files_properties(${ARG_SOURCES} PROPERTIES COMPILE_OPTIONS "${hearth_sanitized_optimisation}" SKIP_PRECOMPILE_HEADERS ON)
  endif()
  if(ARG_RUNS)
    add_dependencies(${program} ${ARG_RUNS})
  endif()

  list(TRANSFORM ARG_SOURCES REPLACE ".*/" "" OUTPUT_VARIABLE files)
  list(JOIN files "," files)
  set(command ${ARG_LAUNCHER} $<TARGET_FILE:${program}> --sources=${files})
  add_test(NAME ${name} COMMAND ${command})
  set(hearth_command_of_${name} "${command}" PARENT_SCOPE)
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  # a test cooks its own inputs, and does not use the user's cache
  set_tests_properties(${name} PROPERTIES
    ENVIRONMENT "HEARTH_CACHE=off" LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT} COST "${ARG_COST}")
endfunction()

# hearth_test_variant(NAME OF TEST ENVIRONMENT VARIABLE=VALUE ... [SOURCES ...] [LABELS ...] [COST SECONDS]): a ctest
# entry that runs an entry of the same folder once more, in another environment.
#   SOURCES  files whose tests run, without their folders; otherwise those of the entry
function(hearth_test_variant name)
  cmake_parse_arguments(ARG "" "OF;COST" "ENVIRONMENT;SOURCES;LABELS" ${ARGN})
  set(command ${hearth_command_of_${ARG_OF}})
  if(ARG_SOURCES)
    list(FILTER command EXCLUDE REGEX "^--sources=")
    list(JOIN ARG_SOURCES "," files)
    list(APPEND command --sources=${files})
  endif()
  add_test(NAME ${name} COMMAND ${command})
  set_tests_properties(${name} PROPERTIES
    ENVIRONMENT "HEARTH_CACHE=off;${ARG_ENVIRONMENT}" LABELS "${ARG_LABELS}" TIMEOUT 600 COST "${ARG_COST}")
endfunction()

# hearth_precompile_for_tests(PROGRAM HEADERS ... LINKS ...): precompile further headers for a program of many tests, before
# its first test: headers of the project that most of its sources include and that take long to parse.
function(hearth_precompile_for_tests program)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINKS" ${ARGN})
  list(TRANSFORM ARG_HEADERS PREPEND ${PROJECT_SOURCE_DIR}/)
  hearth_precompiled_library(hearth_precompiled_${program}
    HEADERS ${hearth_precompiled_headers} <gtest/gtest.h> ${ARG_HEADERS}
    LINKS GTest::gtest ${ARG_LINKS}
    OPTIONS ${hearth_test_options})
  set(hearth_precompiled_for_${program} hearth_precompiled_${program} PARENT_SCOPE)
endfunction()

# hearth_test_program(NAME): a GoogleTest program without tests.
function(hearth_test_program name)
  add_executable(${name} ${PROJECT_SOURCE_DIR}/tests/support/test_main.cpp)
  target_link_libraries(${name} PRIVATE hearth_settings hearth_warnings GTest::gtest GTest::gmock)
  target_compile_definitions(${name} PRIVATE HEARTH_BIN="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  target_compile_options(${name} PRIVATE ${hearth_test_options})
  set(precompiled hearth_precompiled_tests)
  if(hearth_precompiled_for_${name})
    set(precompiled ${hearth_precompiled_for_${name}})
  endif()
  hearth_precompile(${name} ${precompiled})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  add_dependencies(hearth_tests ${name})
endfunction()

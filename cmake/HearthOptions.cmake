# Compiler settings of all targets of the project. A project that adds this one as a subdirectory gets the
# cookers and the libraries; the rest is opt-in.
option(HEARTH_BUILD_COOKERS "Build hearth and the cookers; off where games are built for other machines" ON)
option(HEARTH_BUILD_IMAGES "Build hearth-images, which reads TIFF, PSD, JPEG 2000 and parts of EXR, and needs OpenImageIO" ON)
set(HEARTH_BUILD_WRAP AUTO CACHE STRING "Build hearth-wrap, which needs CGAL and is under the GPL with it: ON, OFF, or AUTO: where CGAL is found")
set_property(CACHE HEARTH_BUILD_WRAP PROPERTY STRINGS AUTO ON OFF)
option(HEARTH_BUILD_TESTS "Build tests and benchmarks" ${PROJECT_IS_TOP_LEVEL})
option(HEARTH_BUILD_SAMPLES "Build hearth-samples, the generator of sample sources" ${PROJECT_IS_TOP_LEVEL})
option(HEARTH_BUILD_VIEWER "Build hearth-render" ${PROJECT_IS_TOP_LEVEL})
option(HEARTH_BUILD_WINDOW "Build hearth-view, which needs HEARTH_BUILD_VIEWER, SDL2 and Dear ImGui" ${PROJECT_IS_TOP_LEVEL})
option(HEARTH_INSTALL "Have rules to install and to package" ${PROJECT_IS_TOP_LEVEL})
option(HEARTH_PRECOMPILE "Precompile standard headers" ${PROJECT_IS_TOP_LEVEL})
option(HEARTH_JOIN_SOURCES "Compile several sources of a target together" ${PROJECT_IS_TOP_LEVEL})
option(HEARTH_HARDENED "Turn on the standard library's own checks" OFF)
option(HEARTH_FUZZ "Build the libFuzzer targets (clang only)" OFF)
set(HEARTH_SANITIZE "" CACHE STRING "Sanitizers to build with, as for -fsanitize")
if(HEARTH_BUILD_TESTS AND NOT (HEARTH_BUILD_COOKERS AND HEARTH_BUILD_SAMPLES AND HEARTH_BUILD_VIEWER))
  message(FATAL_ERROR "HEARTH_BUILD_TESTS needs HEARTH_BUILD_COOKERS, HEARTH_BUILD_SAMPLES and HEARTH_BUILD_VIEWER: "
    "the tests cook samples and draw them")
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Unity build: shared headers are parsed, and their templates compiled, once for eight sources. ./dev lint
# compiles each source alone.
set(CMAKE_UNITY_BUILD ${HEARTH_JOIN_SOURCES})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

find_program(HEARTH_CCACHE ccache)
if(HEARTH_CCACHE)
  # ccache also caches sources with precompiled headers: it compares the contents of these headers. They
  # contain the path of the build folder, so cached objects are never shared between build folders.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR= ${HEARTH_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${HEARTH_CCACHE})
  if(HEARTH_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>")
  elseif(HEARTH_PRECOMPILE)
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
endif()

add_library(hearth_warnings INTERFACE)
target_compile_options(hearth_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  -Wcast-align -Wformat=2 -Wundef)
# as a subproject, new warnings of a future compiler must not break the build
if(PROJECT_IS_TOP_LEVEL)
  target_compile_options(hearth_warnings INTERFACE -Werror)
endif()

if(HEARTH_JOIN_SOURCES AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # in a unity build GCC takes a joined source for a header, and warns about its anonymous namespaces
  target_compile_options(hearth_warnings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports faults inside inlined operator+ of std::string, and in std::optional, that are not there
  foreach(warning array-bounds maybe-uninitialized restrict stringop-overflow stringop-overread)
    target_compile_options(hearth_warnings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-${warning}>)
  endforeach()
endif()

add_library(hearth_settings INTERFACE)
# Same results on every machine: no contraction into fused multiply-adds, no reassociation.
# Position-independent code and threads everywhere, so that all targets can share precompiled headers.
target_compile_options(hearth_settings INTERFACE -ffp-contract=off -fvisibility=hidden -fPIC -pthread
  $<$<COMPILE_LANGUAGE:CXX>:-fvisibility-inlines-hidden>)
# GCC's SLP vectoriser drops the rounding of double{float(x)} (seen with 12.2), so a bound that is stored as
# float would be checked against a different value. tests/cook/clusters/bounds_test.cpp reproduces it.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(hearth_settings INTERFACE -fno-tree-slp-vectorize)
endif()
target_include_directories(hearth_settings INTERFACE ${PROJECT_SOURCE_DIR})
if(HEARTH_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "HEARTH_FUZZ needs clang: libFuzzer is part of it")
  endif()
  set(HEARTH_SANITIZE "address,undefined,fuzzer-no-link")
  set(HEARTH_HARDENED ON)
endif()
if(HEARTH_HARDENED)
  target_compile_definitions(hearth_settings INTERFACE _GLIBCXX_ASSERTIONS)
endif()
# Optimisation of libraries whose tests compute much, under the sanitizers. Instrumented code that is inlined freely takes
# Clang longer to compile: 18.3 s for the first eight sources of formats, 7.2 s with this threshold; of clusters 13.3 and 10.7.
set(hearth_sanitized_optimisation -O1)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  list(APPEND hearth_sanitized_optimisation -mllvm -inline-threshold=20)
endif()
if(HEARTH_SANITIZE)
  target_compile_options(hearth_settings INTERFACE -fsanitize=${HEARTH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(hearth_settings INTERFACE -fsanitize=${HEARTH_SANITIZE})
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  target_compile_options(hearth_settings INTERFACE -Og)
endif()

find_program(HEARTH_MOLD mold)
if(HEARTH_MOLD)
  target_link_options(hearth_settings INTERFACE -fuse-ld=mold)
endif()

# Test code runs once and is compiled often, so -O1 is enough; reference implementations that tests share are
# libraries, optimised as the rest.
set(hearth_test_options $<$<CONFIG:Release>:-O1>)

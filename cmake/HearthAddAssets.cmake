# hearth_add_assets(TARGET
#   SOURCES FILE ...          glTF, OBJ, ... from the current source folder; several become one pack
#   [OUTPUT FILE]             the pack, from the current binary folder; TARGET.hearth by default
#   [PROFILE FILE]            as --profile
#   [OPTIONS OPTION ...])     more of `hearth cook`, such as --visibility
#
# Cooks a pack before TARGET is built, or as a new target TARGET if there is none. The pack is cooked again
# when one of its input files changes, textures included, or the cookers change. Names may contain blanks.
# With '#', '$', ':', quotes or '\' in the name of a texture the build cooks every time, or misses a change:
# CMake cannot express a dependency on such a name.
include_guard(GLOBAL)
# depfiles work, whatever policy the caller's project sets
cmake_policy(VERSION 3.21...3.25)

# One cook at a time: cookers use all cores and much of the machine's memory.
set_property(GLOBAL APPEND PROPERTY JOB_POOLS hearth_cook=1)

function(hearth_add_assets target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "OUTPUT;PROFILE" "SOURCES;OPTIONS")
  if(ARG_UNPARSED_ARGUMENTS OR ARG_KEYWORDS_MISSING_VALUES OR NOT ARG_SOURCES)
    message(FATAL_ERROR "hearth_add_assets(${target}): needs SOURCES FILE ..., may have OUTPUT FILE, PROFILE FILE and "
      "OPTIONS OPTION ..., and nothing else: ${ARG_UNPARSED_ARGUMENTS} ${ARG_KEYWORDS_MISSING_VALUES}")
  endif()

  # the cookers of this build, or cookers installed on the build machine (also in a cross build)
  set(hearth hearth)
  get_property(programs GLOBAL PROPERTY HEARTH_PROGRAMS)
  if(NOT TARGET hearth)
    find_program(HEARTH_PROGRAM hearth HINTS "${HEARTH_PROGRAM_FOLDER}" NO_CMAKE_FIND_ROOT_PATH
      DOC "hearth, which cooks assets")
    set(hearth ${HEARTH_PROGRAM})
    set(programs ${HEARTH_PROGRAM})
  endif()
  if(NOT hearth)
    message(FATAL_ERROR "hearth_add_assets(${target}): the program hearth is not found: install it, "
      "or say where it is with -DHEARTH_PROGRAM=PATH")
  endif()

  if(NOT ARG_OUTPUT)
    set(ARG_OUTPUT ${target}.hearth)
  endif()
  cmake_path(ABSOLUTE_PATH ARG_OUTPUT BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} NORMALIZE)
  cmake_path(GET ARG_OUTPUT PARENT_PATH folder)
  file(MAKE_DIRECTORY ${folder})
  set(files)
  foreach(file IN LISTS ARG_SOURCES ARG_PROFILE)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    list(APPEND files ${file})
  endforeach()
  set(sources ${files})
  if(ARG_PROFILE)
    list(POP_BACK sources profile)
    list(PREPEND ARG_OPTIONS --profile ${profile})
  endif()

  # hearth leaves an unchanged pack untouched. Ninja handles that (restat); make would cook in every build.
  set(touch)
  if(CMAKE_GENERATOR MATCHES "Makefiles")
    set(touch COMMAND ${CMAKE_COMMAND} -E touch ${ARG_OUTPUT})
  endif()
  cmake_path(RELATIVE_PATH ARG_OUTPUT BASE_DIRECTORY ${CMAKE_BINARY_DIR} OUTPUT_VARIABLE name)
  add_custom_command(
    OUTPUT ${ARG_OUTPUT}
    COMMAND ${hearth} cook ${sources} -o ${ARG_OUTPUT} --depfile ${ARG_OUTPUT}.d ${ARG_OPTIONS}
    ${touch}
    DEPENDS ${files} ${programs}
    DEPFILE ${ARG_OUTPUT}.d
    JOB_POOL hearth_cook
    COMMENT "Cooking ${name}"
    VERBATIM)

  # a target for each pack of TARGET
  if(NOT TARGET ${target})
    add_custom_target(${target} ALL)
  endif()
  string(MAKE_C_IDENTIFIER ${name} identifier)
  add_custom_target(${target}_${identifier} DEPENDS ${ARG_OUTPUT})
  add_dependencies(${target} ${target}_${identifier})
endfunction()

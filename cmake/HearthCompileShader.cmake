# Compiles GLSL to SPIR-V 1.3 (Vulkan 1.1) at build time, and checks it with spirv-val: for Hearth, and for games that add
# material functions.
include_guard(GLOBAL)
# depfiles work, whatever policy the caller's project sets
cmake_policy(VERSION 3.21...3.25)

set(HEARTH_SHADER_CACHE "" CACHE PATH "Folder in which builds share compiled shaders; empty: none")

# Find the programs that compile shaders, and their versions.
macro(hearth_find_shader_tools)
  find_package(Vulkan REQUIRED COMPONENTS glslc)
  find_program(HEARTH_SPIRV_VAL spirv-val REQUIRED)
  find_program(HEARTH_SPIRV_OPT spirv-opt REQUIRED)
  set(HEARTH_SHADER_TOOLS "")
  foreach(tool ${Vulkan_GLSLC_EXECUTABLE} ${HEARTH_SPIRV_VAL} ${HEARTH_SPIRV_OPT})
    execute_process(COMMAND ${tool} --version OUTPUT_VARIABLE version ERROR_VARIABLE version
      COMMAND_ERROR_IS_FATAL ANY)
    string(APPEND HEARTH_SHADER_TOOLS "${version}")
  endforeach()
  string(SHA256 HEARTH_SHADER_TOOLS "${HEARTH_SHADER_TOOLS}")
endmacro()

# hearth_shader_command(OUTPUT SHADER [MACROS -DNAME ...] INCLUDES FOLDER ... [DEPENDS FILE ...]): a command that
# compiles SHADER, and writes its words as numbers into OUTPUT. Needs hearth_find_shader_tools().
function(hearth_shader_command output shader)
  cmake_parse_arguments(ARG "" "" "MACROS;INCLUDES;DEPENDS" ${ARGN})
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/compile_shader.cmake)
  cmake_path(GET output FILENAME name)
  string(REGEX REPLACE "\\.inc$" "" name ${name})
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D SHADER=${shader} -D "MACROS=${ARG_MACROS}" -D OUTPUT=${output}
      -D "INCLUDES=${ARG_INCLUDES}" -D GLSLC=${Vulkan_GLSLC_EXECUTABLE} -D SPIRV_VAL=${HEARTH_SPIRV_VAL}
      -D SPIRV_OPT=${HEARTH_SPIRV_OPT} -D TOOLS=${HEARTH_SHADER_TOOLS} -D CACHE=${HEARTH_SHADER_CACHE}
      -P ${script}
    DEPENDS ${shader} ${script} ${ARG_DEPENDS}
    DEPFILE ${output}.d
    COMMENT "Compiling ${name}"
    VERBATIM)
endfunction()

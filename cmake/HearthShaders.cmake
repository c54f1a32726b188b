# Compiles GLSL to SPIR-V 1.3 (Vulkan 1.1) at build time, checks it with spirv-val, and embeds it as words.
# Reproducible: no path and no debug information is included. FILE.spv in the build folder still has the names
# of the source, for tests.

# hearth_shader_library(NAME HEADER ... SHADERS ...): a static library with the words of the shaders, whose
# paths are relative to the current folder. HEADER declares a span for each, named after its file, in
# namespace hearth::shaders.
function(hearth_shader_library name)
  cmake_parse_arguments(ARG "" "HEADER" "SHADERS" ${ARGN})
  find_package(Vulkan REQUIRED COMPONENTS glslc)
  find_program(HEARTH_SPIRV_VAL spirv-val REQUIRED)
  find_program(HEARTH_SPIRV_OPT spirv-opt REQUIRED)
  set(embedded "// Generated.\n#include \"${ARG_HEADER}\"\n\nnamespace hearth::shaders\n{\n")
  set(words_files)
  foreach(shader ${ARG_SHADERS})
    cmake_path(GET shader FILENAME file)
    set(words ${CMAKE_CURRENT_BINARY_DIR}/${file}.inc)
    add_custom_command(
      OUTPUT ${words}
      COMMAND ${Vulkan_GLSLC_EXECUTABLE} -Werror -O -g --target-env=vulkan1.1 -I ${PROJECT_SOURCE_DIR} -MD -MF ${words}.d
        -MT ${words} ${CMAKE_CURRENT_SOURCE_DIR}/${shader} -o ${words}.spv
      COMMAND ${HEARTH_SPIRV_VAL} --target-env vulkan1.1 ${words}.spv
      COMMAND ${HEARTH_SPIRV_OPT} --strip-debug --compact-ids ${words}.spv -o ${words}.stripped
      COMMAND ${CMAKE_COMMAND} -D INPUT=${words}.stripped -D OUTPUT=${words} -P ${PROJECT_SOURCE_DIR}/cmake/embed_words.cmake
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${shader} ${PROJECT_SOURCE_DIR}/cmake/embed_words.cmake
      DEPFILE ${words}.d
      COMMENT "Compiling ${shader}"
      VERBATIM)
    list(APPEND words_files ${words})
    string(REPLACE "." "_" variable ${file})
    string(APPEND embedded "static constexpr uint32_t ${variable}_words[] = {\n#include \"${file}.inc\"\n};\n"
                           "const std::span<const uint32_t> ${variable}(${variable}_words);\n\n")
  endforeach()
  string(APPEND embedded "} // namespace hearth::shaders\n")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp CONTENT "${embedded}" @ONLY)

  hearth_library(${name} SOURCES ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp ${words_files} NO_EXCEPTIONS)
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
  set_target_properties(${name} PROPERTIES HEARTH_SHADERS "${ARG_SHADERS}" HEARTH_SHADER_HEADER ${ARG_HEADER})
endfunction()

# hearth_shader_list(NAME OF LIBRARY SOURCE_HEADER HEADER): a static library that lists the shaders of a shader
# library for tests; HEADER declares it.
function(hearth_shader_list name)
  cmake_parse_arguments(ARG "" "OF;SOURCE_HEADER" "" ${ARGN})
  get_target_property(shaders ${ARG_OF} HEARTH_SHADERS)
  get_target_property(header ${ARG_OF} HEARTH_SHADER_HEADER)
  get_target_property(folder ${ARG_OF} BINARY_DIR)
  set(source "// Generated.\n#include \"${ARG_SOURCE_HEADER}\"\n\n#include \"${header}\"\n\nnamespace hearth::test\n{\n\n")
  string(APPEND source "std::span<const ListedShader> listedShaders()\n{\n    static const ListedShader list[] = {\n")
  foreach(shader ${shaders})
    cmake_path(GET shader FILENAME file)
    string(REPLACE "." "_" variable ${file})
    string(APPEND source "        {\"${variable}\", shaders::${variable}, \"${folder}/${file}.inc.spv\"},\n")
  endforeach()
  string(APPEND source "    };\n    return list;\n}\n\n} // namespace hearth::test\n")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "${source}" @ONLY)
  hearth_library(${name} SOURCES ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp LINKS ${ARG_OF})
endfunction()

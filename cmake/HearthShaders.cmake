# Compiles GLSL to SPIR-V 1.3 (Vulkan 1.1) at build time, checks it with spirv-val, and embeds it as words.
# Reproducible: no path and no debug information is included.

# hearth_shader_library(NAME HEADER ... SHADERS ...): a static library with the words of the shaders, whose
# paths are relative to the current folder. HEADER declares a span for each, named after its file, in
# namespace hearth::shaders.
function(hearth_shader_library name)
  cmake_parse_arguments(ARG "" "HEADER" "SHADERS" ${ARGN})
  find_package(Vulkan REQUIRED COMPONENTS glslc)
  find_program(HEARTH_SPIRV_VAL spirv-val REQUIRED)
  set(embedded "// Generated.\n#include \"${ARG_HEADER}\"\n\nnamespace hearth::shaders\n{\n")
  set(words_files)
  foreach(shader ${ARG_SHADERS})
    cmake_path(GET shader FILENAME file)
    set(words ${CMAKE_CURRENT_BINARY_DIR}/${file}.inc)
    add_custom_command(
      OUTPUT ${words}
      COMMAND ${Vulkan_GLSLC_EXECUTABLE} -Werror -O --target-env=vulkan1.1 -I ${PROJECT_SOURCE_DIR} -MD -MF ${words}.d
        -MT ${words} ${CMAKE_CURRENT_SOURCE_DIR}/${shader} -o ${words}.spv
      COMMAND ${HEARTH_SPIRV_VAL} --target-env vulkan1.1 ${words}.spv
      COMMAND ${CMAKE_COMMAND} -D INPUT=${words}.spv -D OUTPUT=${words} -P ${PROJECT_SOURCE_DIR}/cmake/embed_words.cmake
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
endfunction()

# Compiles GLSL to SPIR-V 1.3 (Vulkan 1.1) at build time, checks it with spirv-val, and embeds it as words.
# Reproducible: no path and no debug information is included. NAME.spv in the build folder still has the names
# of the source, for tests.

include(${CMAKE_CURRENT_LIST_DIR}/HearthCompileShader.cmake)

# hearth_shader_library(NAME HEADER ... SHADERS ... [VARIED ... VARIANTS ...]): a static library with the words
# of the shaders, whose paths are relative to the current folder. HEADER declares a span for each, named after
# its file, in namespace hearth::shaders. VARIED shaders are compiled once more for each name of VARIANTS, with
# the macro HEARTH_NAME: HEADER declares an array of spans for each, without macro first.
function(hearth_shader_library name)
  cmake_parse_arguments(ARG "" "HEADER" "SHADERS;VARIED;VARIANTS" ${ARGN})
  hearth_find_shader_tools()
  set(embedded "// Generated.\n#include \"${ARG_HEADER}\"\n\nnamespace hearth::shaders\n{\n")
  set(words_files)
  set(named "")
  set(listed) # entries "variable,expression,file" of hearth_shader_list
  foreach(shader ${ARG_SHADERS} ${ARG_VARIED})
    set(spans)
    set(files) # names, as fileName returns them
    set(variants "")
    if(shader IN_LIST ARG_VARIED)
      set(variants ${ARG_VARIANTS})
    endif()
    cmake_path(GET shader FILENAME file)
    string(REPLACE "." "_" shader_variable ${file})
    foreach(variant "" ${variants})
      hearth_compile_shader(${shader} "${variant}" variable words)
      string(REGEX REPLACE "\\.inc$" "" module ${words})
      list(APPEND files ${module})
      list(APPEND words_files ${words})
      string(APPEND embedded "static constexpr uint32_t ${variable}_words[] = {\n#include \"${words}\"\n};\n")
      list(LENGTH spans number)
      list(APPEND spans "std::span<const uint32_t>(${variable}_words)")
      set(expression shaders::${shader_variable})
      if(variants)
        string(APPEND expression "[${number}]")
      endif()
      list(APPEND listed "${variable},${expression},${words}.spv")
    endforeach()
    if(variants)
      list(JOIN spans ", " spans)
      string(APPEND embedded "const VariedShader ${shader_variable}{${spans}};\n\n")
      list(TRANSFORM files REPLACE "(.+)" "\"\\1\"")
      list(JOIN files ", " files)
      string(APPEND named "        {&${shader_variable}, {${files}}},\n")
    else()
      string(APPEND embedded "const std::span<const uint32_t> ${shader_variable} = ${spans};\n\n")
    endif()
  endforeach()
  if(ARG_VARIED)
    string(APPEND embedded "std::string_view fileName(const VariedShader& shader, Variant variant)\n{\n"
      "    struct NamedShader\n    {\n        const VariedShader* shader;\n"
      "        std::array<std::string_view, kVariantCount> names;\n    };\n"
      "    static const NamedShader all[] = {\n${named}    };\n"
      "    for (const NamedShader& candidate : all)\n        if (candidate.shader == &shader)\n"
      "            return candidate.names[variant];\n    return {};\n}\n\n")
  endif()
  string(APPEND embedded "} // namespace hearth::shaders\n")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp CONTENT "${embedded}" @ONLY)

  list(TRANSFORM words_files PREPEND ${CMAKE_CURRENT_BINARY_DIR}/)
  hearth_library(${name} SOURCES ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp ${words_files} NO_EXCEPTIONS)
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
  set_target_properties(${name} PROPERTIES HEARTH_SHADERS "${listed}" HEARTH_SHADER_HEADER ${ARG_HEADER})
endfunction()

# hearth_compile_shader(SHADER VARIANT VARIABLE WORDS): compiles a shader, for a variant unless that is empty.
# VARIABLE gets its name in C++, WORDS the name of its file in the build folder.
function(hearth_compile_shader shader variant variable words)
  cmake_path(GET shader FILENAME file)
  set(macro)
  if(variant)
    cmake_path(GET file STEM stem)
    cmake_path(GET file EXTENSION extension)
    set(file ${stem}_${variant}${extension})
    string(TOUPPER "-DHEARTH_${variant}" macro)
  endif()
  hearth_shader_command(${CMAKE_CURRENT_BINARY_DIR}/${file}.inc ${CMAKE_CURRENT_SOURCE_DIR}/${shader}
    MACROS ${macro} INCLUDES ${PROJECT_SOURCE_DIR})
  string(REPLACE "." "_" name ${file})
  set(${variable} ${name} PARENT_SCOPE)
  set(${words} ${file}.inc PARENT_SCOPE)
endfunction()

# hearth_shader_list(NAME OF LIBRARY SOURCE_HEADER HEADER): a static library that lists the shaders of a shader
# library for tests, variants included; HEADER declares it.
function(hearth_shader_list name)
  cmake_parse_arguments(ARG "" "OF;SOURCE_HEADER" "" ${ARGN})
  get_target_property(shaders ${ARG_OF} HEARTH_SHADERS)
  get_target_property(header ${ARG_OF} HEARTH_SHADER_HEADER)
  get_target_property(folder ${ARG_OF} BINARY_DIR)
  set(source "// Generated.\n#include \"${ARG_SOURCE_HEADER}\"\n\n#include \"${header}\"\n\nnamespace hearth::test\n{\n\n")
  string(APPEND source "std::span<const ListedShader> listedShaders()\n{\n    static const ListedShader list[] = {\n")
  foreach(shader ${shaders})
    string(REGEX MATCH "^(.*),(.*),(.*)$" unused ${shader})
    string(APPEND source "        {\"${CMAKE_MATCH_1}\", ${CMAKE_MATCH_2}, \"${folder}/${CMAKE_MATCH_3}\"},\n")
  endforeach()
  string(APPEND source "    };\n    return list;\n}\n\n} // namespace hearth::test\n")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "${source}" @ONLY)
  hearth_library(${name} SOURCES ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp LINKS ${ARG_OF})
endfunction()

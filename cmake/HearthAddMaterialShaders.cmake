# hearth_add_material_shaders(TARGET
#   [FUNCTIONS FILE ...]       GLSL, from the current source folder; water.glsl defines
#                              void water(inout MaterialValues values, MaterialPoint point)
#   [MOTIONS FILE ...]         wind.glsl defines vec3 wind(MotionPoint point)
#   [LIGHT_METHODS NAME ...])  light methods beside those that light and shade at once: deferred, prepass,
#                              classic_prepass, encoded_prepass, stack
#
# Compiles the shading of Hearth's materials with the game's functions in it, for
# hearth_renderer_description.material_shaders. TARGET gets the header TARGET_material_shaders.h, which declares
# `const hearth_material_shaders TARGET_material_shaders`. See "Material functions" in runtime/c/README.md.
include_guard(GLOBAL)
include(${CMAKE_CURRENT_LIST_DIR}/HearthCompileShader.cmake)

# hearth_shader_sources_version(OUTPUT FOLDER): a command that writes the version of the shaders' sources.
function(hearth_shader_sources_version output folder)
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/hash_shader_sources.cmake)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/runtime/shaders/*.glsl ${folder}/runtime/shaders/*.vert
    ${folder}/runtime/shaders/*.frag ${folder}/formats/gpu_shared/*.h)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D FOLDER=${folder} -D OUTPUT=${output} -P ${script}
    DEPENDS ${sources} ${script}
    COMMENT "Hashing the sources of shaders"
    VERBATIM)
endfunction()

# hearth_choose_functions(TARGET FILES CALL INCLUDED NAMES): GLSL that includes the files, and in `calls` that calls the
# one of a number. NAMES gets an initializer of C. Adds the folders to `includes`.
function(hearth_choose_functions target files call included names)
  set(number 0)
  set(text "// Generated.\n")
  set(initializer "")
  set(calls "")
  foreach(file IN LISTS files)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    cmake_path(GET file STEM NAME)
    if(NOT NAME MATCHES "^[A-Za-z][A-Za-z0-9_]*$")
      message(FATAL_ERROR "hearth_add_material_shaders(${target}): ${file} has no name that a function may have")
    endif()
    math(EXPR number "${number} + 1")
    cmake_path(GET file PARENT_PATH directory)
    list(APPEND includes ${directory})
    cmake_path(GET file FILENAME file)
    string(APPEND text "#include \"${file}\"\n")
    string(CONFIGURE "${call}" line @ONLY)
    string(APPEND calls "    if (number == ${number}u)\n${line}")
    string(APPEND initializer "{\"${NAME}\"}, ")
  endforeach()
  set(${included} "${text}" PARENT_SCOPE)
  set(${names} "${initializer}" PARENT_SCOPE)
  set(calls "${calls}" PARENT_SCOPE)
  set(includes "${includes}" PARENT_SCOPE)
endfunction()

function(hearth_add_material_shaders target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "FUNCTIONS;MOTIONS;LIGHT_METHODS")
  if(ARG_UNPARSED_ARGUMENTS OR ARG_KEYWORDS_MISSING_VALUES OR NOT (ARG_FUNCTIONS OR ARG_MOTIONS))
    message(FATAL_ERROR "hearth_add_material_shaders(${target}): needs FUNCTIONS FILE ... or MOTIONS FILE ..., "
      "may have LIGHT_METHODS NAME ..., and nothing else: ${ARG_UNPARSED_ARGUMENTS} ${ARG_KEYWORDS_MISSING_VALUES}")
  endif()
  # Names of the shaders for each light method, %: for each combination of shadows and bricks.
  set(shaders_default shade/shading%.frag shade/view_surface.frag)
  set(shaders_deferred shade/surfaces%.frag)
  set(shaders_prepass prepass/summed%.frag prepass/normals.frag)
  set(shaders_classic_prepass prepass/joint%.frag prepass/joint_normals.frag)
  set(shaders_encoded_prepass prepass/joint%.frag prepass/encoded_normals.frag)
  set(shaders_stack stack/marked%.frag)
  # the sources of an installation, or of this tree
  set(sources ${HEARTH_SHADER_SOURCES})
  if(NOT sources)
    cmake_path(GET CMAKE_CURRENT_FUNCTION_LIST_DIR PARENT_PATH sources)
  endif()
  hearth_find_shader_tools()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_material_shaders)
  file(MAKE_DIRECTORY ${folder})

  # the functions and motions, and the choice among them
  set(includes ${sources} ${folder}) # glslc finds no absolute paths
  hearth_choose_functions(${target} "${ARG_FUNCTIONS}" "        @NAME@(values, point);\n" functions function_names)
  file(CONFIGURE OUTPUT ${folder}/material_functions.glsl CONTENT "${functions}
void callMaterialFunction(uint number, inout MaterialValues values, MaterialPoint point)
{
${calls}}
" @ONLY)
  hearth_choose_functions(${target} "${ARG_MOTIONS}" "        return @NAME@(point);\n" motions motion_names)
  file(CONFIGURE OUTPUT ${folder}/material_motions.glsl CONTENT "${motions}
vec3 callMaterialMotion(uint number, MotionPoint point)
{
${calls}    return vec3(0.0);
}
" @ONLY)
  list(REMOVE_DUPLICATES includes)
  list(LENGTH ARG_FUNCTIONS function_count)
  list(LENGTH ARG_MOTIONS motion_count)
  if(ARG_MOTIONS)
    list(APPEND shaders_default draw/visibility.vert draw/visibility_masked.vert draw/caster.vert draw/caster_masked.vert)
  endif()

  # the modules
  set(shaders)
  foreach(method IN ITEMS default ${ARG_LIGHT_METHODS})
    if(NOT DEFINED shaders_${method})
      message(FATAL_ERROR "hearth_add_material_shaders(${target}): ${method} is none of deferred, prepass, "
        "classic_prepass, encoded_prepass, stack")
    endif()
    foreach(shader IN LISTS shaders_${method})
      if(shader MATCHES "%")
        foreach(light "" _shadowed _gi _shadowed_gi)
          string(REPLACE "%" "${light}" combination ${shader})
          list(APPEND shaders ${combination})
        endforeach()
      else()
        list(APPEND shaders ${shader})
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES shaders)
  set(arrays "")
  set(modules "")
  set(outputs)
  foreach(shader IN LISTS shaders)
    cmake_path(GET shader STEM stem)
    cmake_path(GET shader EXTENSION extension)
    set(variants "")
    if(extension STREQUAL ".frag")
      set(variants _sampled)
    endif()
    foreach(variant "" ${variants})
      set(name ${stem}${variant}${extension})
      string(MAKE_C_IDENTIFIER ${name} array)
      set(macros -DHEARTH_MATERIAL_FUNCTIONS)
      if(variant)
        list(APPEND macros -DHEARTH_SAMPLED)
      endif()
      hearth_shader_command(${folder}/${name}.inc ${sources}/runtime/shaders/${shader}
        MACROS ${macros} INCLUDES ${includes}
        DEPENDS ${folder}/material_functions.glsl ${folder}/material_motions.glsl)
      list(APPEND outputs ${folder}/${name}.inc)
      string(APPEND arrays "static const uint32_t ${array}[] = {\n#include \"${name}.inc\"\n};\n")
      string(APPEND modules "    {\"${name}\", ${array}, sizeof(${array}) / sizeof(uint32_t)},\n")
    endforeach()
  endforeach()
  hearth_shader_sources_version(${folder}/version.inc ${sources})

  # the game's source of them
  set(variable ${target}_material_shaders)
  string(MAKE_C_IDENTIFIER ${variable} variable)
  set(header "/* Generated. */\n#pragma once\n#include <hearth.h>\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n")
  string(APPEND header "extern const hearth_material_shaders ${variable};\n#ifdef __cplusplus\n}\n#endif\n")
  set(source "/* Generated. */\n#include \"${target}_material_shaders.h\"\n\n${arrays}\n")
  string(APPEND source "static const hearth_material_module modules[] = {\n${modules}};\n")
  string(APPEND source "static const hearth_material_function functions[] = {${function_names}{0}};\n")
  string(APPEND source "static const hearth_material_function motions[] = {${motion_names}{0}};\n")
  string(APPEND source "static const char version[] =\n#include \"version.inc\"\n;\n\n"
    "const hearth_material_shaders ${variable} = {\n"
    "    ${function_count}, ${motion_count}, functions, motions,\n    sizeof(modules) / sizeof(modules[0]), modules, version};\n")
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  set(extension c)
  if("CXX" IN_LIST languages)
    set(extension cpp)
  endif()
  file(CONFIGURE OUTPUT ${folder}/${target}_material_shaders.h CONTENT "${header}" @ONLY)
  set(code ${folder}/${target}_material_shaders.${extension})
  file(CONFIGURE OUTPUT ${code} CONTENT "${source}" @ONLY)
  set_property(SOURCE ${code} APPEND PROPERTY OBJECT_DEPENDS "${outputs};${folder}/version.inc")
  target_sources(${target} PRIVATE ${code} ${outputs} ${folder}/version.inc)
  target_include_directories(${target} PUBLIC ${folder})
endfunction()

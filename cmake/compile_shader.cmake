# Script of hearth_shader_command: compiles SHADER, with MACROS (-DNAME), to OUTPUT.spv, checks it,
# and writes its words without names as C++ numbers into OUTPUT. With a folder CACHE, text that any build has
# compiled before is not compiled again: an optimised shader takes seconds, its text a quarter of one.
#   GLSLC SPIRV_VAL SPIRV_OPT  programs; TOOLS  their versions
#   INCLUDES                   folders of include paths

set(compile ${GLSLC} -Werror -g --target-env=vulkan1.1 ${MACROS})
foreach(folder IN LISTS INCLUDES)
  list(APPEND compile -I ${folder})
endforeach()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "cannot compile ${SHADER}")
  endif()
endfunction()

# Put a file in place whole, whatever other builds do.
function(put from to)
  string(RANDOM LENGTH 12 suffix)
  file(COPY_FILE ${from} ${to}.${suffix})
  file(RENAME ${to}.${suffix} ${to})
endfunction()

set(text ${OUTPUT}.text)
run(${compile} -E -MD -MF ${OUTPUT}.d -MT ${OUTPUT} ${SHADER} -o ${text})
file(SHA256 ${text} key)
file(SHA256 ${CMAKE_CURRENT_LIST_FILE} script)
string(SHA256 key "${key} ${script} ${MACROS} ${TOOLS}")
file(REMOVE ${text})
set(kept ${CACHE}/${key})
if(CACHE AND EXISTS ${kept}.spv AND EXISTS ${kept}.inc)
  put(${kept}.spv ${OUTPUT}.spv)
  put(${kept}.inc ${OUTPUT})
  return()
endif()

# names cost the passes of glslc -O half their time, so the module that keeps them for tests has a few passes only
run(${compile} ${SHADER} -o ${OUTPUT}.named)
run(${SPIRV_OPT} --eliminate-dead-functions --eliminate-dead-variables --eliminate-dead-const ${OUTPUT}.named -o ${OUTPUT}.spv)
run(${SPIRV_OPT} --strip-debug -O --compact-ids ${OUTPUT}.named -o ${OUTPUT}.stripped)
run(${SPIRV_VAL} --target-env vulkan1.1 ${OUTPUT}.stripped)
file(READ ${OUTPUT}.stripped bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUTPUT} "${words}\n")
file(REMOVE ${OUTPUT}.named ${OUTPUT}.stripped)
if(CACHE)
  file(MAKE_DIRECTORY ${CACHE})
  put(${OUTPUT}.spv ${kept}.spv)
  put(${OUTPUT} ${kept}.inc)
endif()

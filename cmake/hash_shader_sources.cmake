# Script: writes the hash of the shaders' sources below FOLDER into OUTPUT, as a string of C. A library and shaders of
# material functions fit together where it is the same.
file(GLOB_RECURSE files RELATIVE ${FOLDER}
  ${FOLDER}/runtime/shaders/*.glsl ${FOLDER}/runtime/shaders/*.vert ${FOLDER}/runtime/shaders/*.frag
  ${FOLDER}/formats/gpu_shared/*.h)
list(SORT files)
set(text "")
foreach(file IN LISTS files)
  file(SHA256 ${FOLDER}/${file} hash)
  string(APPEND text "${file} ${hash}\n")
endforeach()
string(SHA256 hash "${text}")
string(SUBSTRING ${hash} 0 16 hash)
file(WRITE ${OUTPUT} "\"${hash}\"\n")

# Script of hearth_embed_text: writes the constants as bytes, because a string literal has a length limit.
set(text "// Generated.\n#include \"${HEADER}\"\n\nnamespace ${NAMESPACE}\n{\n\n")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  string(MAKE_C_IDENTIFIER ${name} name)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND text "static constexpr char ${name}_bytes[] = {${bytes}};\n"
                     "const std::string_view ${name}(${name}_bytes, sizeof(${name}_bytes));\n\n")
endforeach()
string(APPEND text "} // namespace ${NAMESPACE}\n")
file(WRITE ${OUTPUT} "${text}")

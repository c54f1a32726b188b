# Script of hearth_shader_library: writes INPUT, a file of little-endian 32-bit words, as C++ numbers into
# OUTPUT.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUTPUT} "${words}\n")

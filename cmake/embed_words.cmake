# Run by hearth_shader_library: writes the words of INPUT, a file of little-endian 32-bit words, as numbers of C++ into OUTPUT.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUTPUT} "${words}\n")

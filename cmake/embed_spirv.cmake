# cmake -DIN=program.spv -DOUT=program.inc -P embed_spirv.cmake: the words of a SPIR-V binary (little-endian) as C++ initialisers.
file(READ ${IN} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${bytes}")
file(WRITE ${OUT} "${words}")

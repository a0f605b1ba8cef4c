# The two font files that drawings are lettered with become words of the program, so that it needs none where it runs.
find_path(STB_INCLUDE_DIR stb/stb_truetype.h REQUIRED)
set(fonts_of_debian /usr/share/fonts/truetype/dejavu)

function(relievo_fonts name)
  set(generated ${PROJECT_BINARY_DIR}/generated/fonts)
  file(MAKE_DIRECTORY ${generated})
  set(words "")
  foreach(font DejaVuSans DejaVuSans-Bold)
    find_file(FONT_${font} ${font}.ttf PATHS ${fonts_of_debian} REQUIRED)
    add_custom_command(OUTPUT ${generated}/${font}.inc
      COMMAND ${CMAKE_COMMAND} -DIN=${FONT_${font}} -DOUT=${generated}/${font}.inc -P ${PROJECT_SOURCE_DIR}/cmake/embed_spirv.cmake
      DEPENDS ${FONT_${font}} ${PROJECT_SOURCE_DIR}/cmake/embed_spirv.cmake
      COMMENT "Embedding ${font}" VERBATIM)
    list(APPEND words ${generated}/${font}.inc)
  endforeach()
  file(CONFIGURE OUTPUT ${generated}/font_words.cpp @ONLY CONTENT [[
// Written by CMake: the fonts of drawings.
#include "figure/font_words.h"
const std::uint32_t relievo::font_regular[] = {
#include "DejaVuSans.inc"
};
const std::uint32_t relievo::font_bold[] = {
#include "DejaVuSans-Bold.inc"
};
]])
  set_property(SOURCE ${generated}/font_words.cpp APPEND PROPERTY OBJECT_DEPENDS "${words}")
  target_sources(relievo_${name} PRIVATE ${generated}/font_words.cpp)
  target_include_directories(relievo_${name} SYSTEM PRIVATE ${STB_INCLUDE_DIR})
  target_link_libraries(relievo_${name} PUBLIC $<BUILD_INTERFACE:${STB_LIBRARY}>)
endfunction()

# Technique files become C++ functions (a wrapper each) and GPU programs (one per host and technique).
find_program(GLSLC glslc REQUIRED)
file(GLOB RELIEVO_TECHNIQUE_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/techniques/heightfield/*.glsl)

function(relievo_technique_functions name)
  set(generated ${PROJECT_BINARY_DIR}/generated/techniques)
  set(declarations "")
  set(files "")
  set(texts "")
  foreach(file ${RELIEVO_TECHNIQUE_FILES})
    get_filename_component(id ${file} NAME_WE)
    string(APPEND declarations "glsl::SurfaceHit ${id}(glsl::SurfaceRay ray, glsl::MarchParams params);\n")
    string(APPEND files "    \"${id}\",\n")
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    string(APPEND texts "    if (id == \"${id}\") return R\"glsl(${text})glsl\";\n")
    file(CONFIGURE OUTPUT ${generated}/${id}.cpp @ONLY CONTENT [[
// Written by CMake: shaders/techniques/heightfield/@id@.glsl as a C++ function.
#include "heightfield_functions.h"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-variable"
namespace relievo::glsl { namespace {
#include "techniques/heightfield/@id@.glsl"
} }
namespace relievo::heightfield {
glsl::SurfaceHit @id@(glsl::SurfaceRay ray, glsl::MarchParams params) { return glsl::@id@(ray, params); }
}
]])
    target_sources(relievo_${name} PRIVATE ${generated}/${id}.cpp)
    set_property(SOURCE ${generated}/${id}.cpp APPEND PROPERTY OBJECT_DEPENDS ${file})
  endforeach()
  file(GENERATE OUTPUT ${generated}/heightfield_texts.cpp CONTENT
    "// Written by CMake: the technique files as texts, for the chapters that list them.\n#include \"heightfield_functions.h\"\nstd::string_view relievo::heightfield::text(std::string_view id) {\n${texts}    return {};\n}\n")
  target_sources(relievo_${name} PRIVATE ${generated}/heightfield_texts.cpp)
  file(CONFIGURE OUTPUT ${generated}/heightfield_functions.h @ONLY CONTENT [[
// Written by CMake from the files of shaders/techniques/heightfield.
#pragma once
#include "techniques/glsl.h"
#include <string_view>
namespace relievo::heightfield {
@declarations@
inline constexpr std::string_view files[] = {
@files@};
// The file of this id, as written; empty for an unknown one.
std::string_view text(std::string_view id);
}
]])
  target_include_directories(relievo_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/shaders> $<BUILD_INTERFACE:${generated}>)
endfunction()

# One host's SPIR-V, checked by spirv-val and written as words for an #include; everything it includes is tracked.
function(relievo_gpu_program source out)
  add_custom_command(OUTPUT ${out}.inc
    COMMAND ${GLSLC} --target-env=vulkan1.3 -O -Werror -I ${PROJECT_SOURCE_DIR}/shaders -MD -MF ${out}.d -MT ${out}.inc
            -o ${out}.spv ${source}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.3 ${out}.spv
    COMMAND ${CMAKE_COMMAND} -DIN=${out}.spv -DOUT=${out}.inc -P ${PROJECT_SOURCE_DIR}/cmake/embed_spirv.cmake
    DEPENDS ${source} ${PROJECT_SOURCE_DIR}/cmake/embed_spirv.cmake
    DEPFILE ${out}.d
    VERBATIM)
endfunction()

# Programs without a technique are whole files in shaders/hosts; the others are a host and a technique joined by a wrapper.
function(relievo_gpu_programs name)
  find_program(SPIRV_VAL spirv-val REQUIRED)
  set(generated ${PROJECT_BINARY_DIR}/generated/programs)
  set(hosts ${PROJECT_SOURCE_DIR}/shaders/hosts/heightfield)
  file(MAKE_DIRECTORY ${generated})
  set(words "")
  set(arrays "")
  set(table "")
  foreach(host quad.vert rays.frag sheet.vert sheet.frag)
    string(REPLACE "." "_" program ${host})
    relievo_gpu_program(${hosts}/${host} ${generated}/${program})
    list(APPEND words ${generated}/${program}.inc)
    string(APPEND arrays "constexpr std::uint32_t ${program}[] = {\n#include \"${program}.inc\"\n};\n")
    string(APPEND table "    {\"${host}\", \"\", ${program}},\n")
  endforeach()
  foreach(host mesh/phong.vert mesh/phong.frag shells/skin.vert shells/skin.frag shells/strands.vert shells/strands.frag shells/light.vert shells/layers.vert shells/layers_combed.vert shells/layers.frag shells/layers_skin.frag shells/lapped.vert shells/lapped.frag
               strands/grow.comp strands/plot.comp strands/shade.vert strands/shade.frag
               maps/cell_cone_largest.comp maps/cell_cone_roof.comp maps/cell_cone_quadrants.comp
               maps/distance_down.comp maps/distance_along.comp maps/distance_stored.comp maps/cone.comp)
    string(REGEX REPLACE "[./]" "_" program ${host})
    relievo_gpu_program(${PROJECT_SOURCE_DIR}/shaders/hosts/${host} ${generated}/${program})
    list(APPEND words ${generated}/${program}.inc)
    string(APPEND arrays "constexpr std::uint32_t ${program}[] = {\n#include \"${program}.inc\"\n};\n")
    string(APPEND table "    {\"${host}\", \"\", ${program}},\n")
  endforeach()
  foreach(file ${RELIEVO_TECHNIQUE_FILES})
    get_filename_component(id ${file} NAME_WE)
    foreach(host shade.frag record.frag cast.comp)
      string(REPLACE "." "_" program ${id}_${host})
      file(CONFIGURE OUTPUT ${generated}/${id}_${host} @ONLY CONTENT [[
// Written by CMake: shaders/techniques/heightfield/@id@.glsl in the host @host@.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hosts/heightfield/family.glsl"
#include "techniques/heightfield/@id@.glsl"
SurfaceHit technique(SurfaceRay ray, MarchParams params) { return @id@(ray, params); }
#include "hosts/heightfield/@host@"
]])
      relievo_gpu_program(${generated}/${id}_${host} ${generated}/${program})
      list(APPEND words ${generated}/${program}.inc)
      string(APPEND arrays "constexpr std::uint32_t ${program}[] = {\n#include \"${program}.inc\"\n};\n")
      string(APPEND table "    {\"${host}\", \"${id}\", ${program}},\n")
    endforeach()
  endforeach()
  file(CONFIGURE OUTPUT ${generated}/programs.cpp @ONLY CONTENT [[
// Written by CMake: every GPU program as SPIR-V.
#include "render/programs.h"
namespace relievo {
namespace {
@arrays@
constexpr Program table[] = {
@table@};
}
std::span<const Program> programs() { return table; }
}
]])
  target_sources(relievo_${name} PRIVATE ${generated}/programs.cpp)
  set_property(SOURCE ${generated}/programs.cpp APPEND PROPERTY OBJECT_DEPENDS "${words}")
endfunction()

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

function(relievo_gpu_programs name)
endfunction()

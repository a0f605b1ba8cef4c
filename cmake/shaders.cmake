# Technique files become C++ functions (a wrapper each) and GPU programs (one per host and technique).
find_program(GLSLC glslc REQUIRED)
file(GLOB RELIEVO_TECHNIQUE_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/techniques/heightfield/*.glsl)

function(relievo_technique_functions name)
  set(generated ${PROJECT_BINARY_DIR}/generated/techniques)
  set(declarations "")
  set(files "")
  foreach(file ${RELIEVO_TECHNIQUE_FILES})
    get_filename_component(id ${file} NAME_WE)
    string(APPEND declarations "glsl::SurfaceHit ${id}(glsl::SurfaceRay ray, glsl::MarchParams params);\n")
    string(APPEND files "    \"${id}\",\n")
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
  file(CONFIGURE OUTPUT ${generated}/heightfield_functions.h @ONLY CONTENT [[
// Written by CMake from the files of shaders/techniques/heightfield.
#pragma once
#include "techniques/glsl.h"
#include <string_view>
namespace relievo::heightfield {
@declarations@
inline constexpr std::string_view files[] = {
@files@};
}
]])
  target_include_directories(relievo_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/shaders> $<BUILD_INTERFACE:${generated}>)
endfunction()

function(relievo_gpu_programs name)
endfunction()

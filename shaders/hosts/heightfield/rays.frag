// The question alone: where the pixel's ray meets the base, from where it is seen and how large the pixel is there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "pixel.glsl"

layout(location = 0) out vec4 uv_lod_coverage;
layout(location = 1) out vec4 view;

void main() {
    uv_lod_coverage = vec4(base_uv, pixel_lod(), 1.0f);
    view = vec4(pixel_view(), 0.0f);
}

// One directional light under Phong's model, on both sides of the surface. Where the mesh has no normal, that of the face.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "phong.glsl"
#include "shading/phong.glsl"

layout(location = 0) in vec3 at;
layout(location = 1) in vec3 facing;
layout(location = 0) out vec4 colour;

const vec3 clay = vec3(0.62f, 0.55f, 0.48f);
const float ambient = 0.12f;

void main() {
    vec3 view = normalize(eye.xyz - at);
    // Turned to the side of the face that is seen, not to the eye: at a silhouette the normal may lean away a little.
    vec3 face = cross(dFdx(at), dFdy(at));
    if (dot(face, view) < 0.0f) face = -face;
    vec3 normal = normalize(dot(facing, facing) > 1e-12f ? facing : face);
    if (dot(normal, face) < 0.0f) normal = -normal;
    vec3 lit = clay * ambient + phong(clay, 0.25f, 30.0f, normal, view, to_light.xyz) * step(0.0f, dot(normal, to_light.xyz));
    colour = vec4(lit, 1.0f);
}

// What both stages of the mesh host share: the camera and the light of a draw, as push constants (render/mesh_renderer.cpp).
layout(push_constant) uniform Push {
    mat4 to_clip;   // from the mesh's space
    vec4 eye;       // in the mesh's space; w unused
    vec4 to_light;  // unit, toward a directional light; w unused
};

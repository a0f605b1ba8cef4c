// What one light adds (Phong 1975): colour * max(0, n.l) + specular * max(0, r.v)^shininess, r the mirror image of l about n.
// Vectors are unit and in one space; the result is to be multiplied by the light that arrives.
#ifndef RELIEVO_SHADING_PHONG
#define RELIEVO_SHADING_PHONG

vec3 phong(vec3 colour, float specular, float shininess, vec3 normal, vec3 view, vec3 to_light) {
    float facing = dot(normal, to_light);
    vec3 mirrored = normal * (2.0f * facing) - to_light;
    float highlight = facing > 0.0f ? specular * pow(max(dot(mirrored, view), 0.0f), shininess) : 0.0f;
    return colour * max(facing, 0.0f) + vec3(highlight);
}

#endif

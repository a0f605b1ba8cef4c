// What one light adds (Blinn 1977): colour * max(0, n.l) + specular * max(0, n.h)^(4 shininess), h halfway between l and v. The angle
// between n and h is half of that between Phong's r and v where all lie in a plane, so four times the exponent gives a highlight of
// the same size (Fisher and Woo 1994, R.E versus N.H Specular Highlights); at grazing views it is narrower across than Phong's.
#ifndef RELIEVO_SHADING_BLINN_PHONG
#define RELIEVO_SHADING_BLINN_PHONG

vec3 blinn_phong(vec3 colour, float specular, float shininess, vec3 normal, vec3 view, vec3 to_light) {
    float facing = dot(normal, to_light);
    vec3 halfway = normalize(to_light + view);
    float highlight = facing > 0.0f ? specular * pow(max(dot(normal, halfway), 0.0f), 4.0f * shininess) : 0.0f;
    return colour * max(facing, 0.0f) + vec3(highlight);
}

#endif

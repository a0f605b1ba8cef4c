// Light from a strand: Kajiya and Kay (1989), "Rendering Fur with Three Dimensional Textures", for what is scattered, and two
// highlights after Marschner et al. (2003), "Light Scattering from Human Hair Fibers": one mirrored by the surface, tilted toward the
// root by the scales and as white as the light; one that went through the strand, tilted toward the tip, wider and coloured by it.
// The tilts and widths are those of Scheuermann (2004), "Practical Real-Time Hair Rendering and Shading".
// The squared sine between the tilted strand and the half vector.
float strand_sine2(vec3 tangent, vec3 normal, float shift, vec3 half_vector) {
    vec3 t = normalize(tangent + normal * shift);
    float along = dot(t, half_vector);
    return max(1.0f - along * along, 0.0f);
}

vec3 strand_light(vec3 albedo, vec3 tangent, vec3 normal, vec3 view, vec3 light, float gloss) {
    float along = dot(tangent, light);
    float across = sqrt(max(1.0f - along * along, 0.0f));
    // The skin under the fur takes the light away gradually behind the terminator, as strands stand above it.
    float facing = clamp((dot(normal, light) + 0.35f) / 1.35f, 0.0f, 1.0f);
    vec3 half_vector = normalize(light + view);
    // Sines to the powers 96 and 24, by squaring.
    float mirrored = strand_sine2(tangent, normal, 0.12f, half_vector), passed = strand_sine2(tangent, normal, -0.18f, half_vector);
    mirrored *= mirrored * mirrored;
    mirrored *= mirrored;
    mirrored *= mirrored;
    mirrored *= mirrored;
    mirrored *= mirrored;
    passed *= passed * passed;
    passed *= passed;
    passed *= passed;
    return facing * (albedo * across + gloss * (vec3(0.35f * mirrored) + albedo * (1.2f * passed)));
}

// Light from the skin: much of it is lost under fur. `covered` is 1 there and 0 where none grows.
vec3 skin_light(vec3 albedo, vec3 normal, vec3 light, float covered) {
    return albedo * mix(1.0f, 0.22f, covered) * (0.3f + 0.2f * normal.y + 1.6f * max(dot(normal, light), 0.0f));
}

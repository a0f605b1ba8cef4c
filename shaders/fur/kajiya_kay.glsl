// Kajiya and Kay (1989), "Rendering Fur with Three Dimensional Textures": light on a thin cylinder along `tangent`. `light` points toward
// the light, `from_eye` to the hair, all three of unit length. The specular part is the cosine of the angle between the way to the eye
// and the nearest of the cone of mirrored rays; its power is the caller's.
struct KajiyaKay {
    float diffuse;
    float specular;
};

KajiyaKay kajiya_kay(vec3 tangent, vec3 light, vec3 from_eye) {
    float cos_l = dot(tangent, light), cos_e = dot(tangent, from_eye);
    float sin_l = sqrt(max(1.0f - cos_l * cos_l, 0.0f)), sin_e = sqrt(max(1.0f - cos_e * cos_e, 0.0f));
    KajiyaKay result;
    result.diffuse = sin_l;
    result.specular = abs(cos_l * cos_e + sin_l * sin_e);
    return result;
}

// What one light adds on a microfacet surface: GGX normals (Walter et al. 2007), Smith's masking with correlated heights (Heitz 2014),
// Schlick's Fresnel (1994), over Lambert's diffuse. Lights are given so that a white Lambert surface facing one is as bright as the
// light (as in Phong's formula here), hence the factor pi that the usual form has in the light.
#ifndef RELIEVO_SHADING_GGX
#define RELIEVO_SHADING_GGX

vec3 ggx(vec3 colour, float roughness, float metallic, vec3 normal, vec3 view, vec3 to_light) {
    const float pi = 3.14159265f;
    vec3 result = vec3(0.0f);
    float n_l = dot(normal, to_light);
    if (n_l > 0.0f) {
        // A normal map turns normals away from the eye that a surface could not; they are shaded as if just grazed.
        float n_v = max(dot(normal, view), 1e-3f);
        vec3 halfway = normalize(to_light + view);
        float n_h = clamp(dot(normal, halfway), 0.0f, 1.0f);
        float v_h = clamp(dot(view, halfway), 0.0f, 1.0f);
        float a = roughness * roughness;
        float a2 = a * a;
        float d = (n_h * n_h) * (a2 - 1.0f) + 1.0f;
        float distribution = a2 / (pi * d * d);
        float visibility = 0.5f / (n_l * sqrt(n_v * n_v * (1.0f - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0f - a2) + a2));
        // 0.04: what a dielectric of index 1.5 reflects head on.
        vec3 head_on = mix(vec3(0.04f), colour, metallic);
        vec3 fresnel = head_on + (vec3(1.0f) - head_on) * pow(1.0f - v_h, 5.0f);
        vec3 diffuse = colour * (vec3(1.0f) - fresnel) * (1.0f - metallic);
        result = (diffuse + fresnel * (pi * distribution * visibility)) * n_l;
    }
    return result;
}

#endif

// The colour alone: the pass that is timed.
#include "surface.glsl"

layout(location = 0) out vec4 colour;

void main() {
    SurfaceRay ray = pixel_ray();
    MarchParams params = modified_march(march, ray, draw_modes(), numbers);
    SurfaceHit hit = modified_search(ray, params, draw_modes(), numbers);
    vec3 background = vec3(scene.background_r, scene.background_g, scene.background_b);
    colour = vec4(hit.found ? surface_colour(ray, hit) : background, 1.0f);
    // For other geometry: how far away the relief is here, not the polygon.
    gl_FragDepth = gl_FragCoord.z;
    if (sheet_mode == sheet_relief) {
        vec4 place = projected(surface_position(ray, hit));
        gl_FragDepth = hit.found ? clamp(place.z / place.w, 0.0f, 1.0f) : 1.0f;
    }
    if (edge_mode != edge_none) {
        EdgeNeighbour other = edge_neighbour(ray, hit, params, edge_mode, numbers.edge_width, numbers.edge_samples,
                                             border_mode == border_repeat ? 0.0f : numbers.chart);
        if (other.share > 0.0f) {
            vec3 beside = other.hit.found ? surface_colour(ray, other.hit) : background;
            colour = vec4(mix(vec3(colour), beside, other.share), 1.0f);
        }
    }
}

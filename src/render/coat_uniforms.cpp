#include "render/coat_uniforms.h"

#include "fur/lock_noise.h"
#include "render/eye_matrix.h"

#include <cmath>
#include <cstddef>

namespace relievo {

namespace {

static_assert(sizeof(CoatUniforms) == 49 * 4 && offsetof(CoatUniforms, root_r) == 31 * 4, "shaders/shared/coat.h without holes");
static_assert(sizeof(FurMatrices) == 128);

constexpr double light_range = 4;  // depth of the light's picture, in fur space: light.vert's unit cube is this wide

// Of the light that sees a ball of this radius around the origin.
FurMatrices light_matrices(Vec3d to_light, double radius) {
    const Vec3d back = normalize(to_light);
    const Vec3d right = normalize(cross(std::abs(back.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0), back)), up = cross(back, right);
    const Vec3d x = right * (1 / radius), y = up * (-1 / radius), z = back * (-1 / light_range);
    return {matrix({{{x.x, x.y, x.z, 0}, {y.x, y.y, y.z, 0}, {z.x, z.y, z.z, 0.5}, {0, 0, 0, 1}}}),
            matrix({{{x.x / 2, x.y / 2, x.z / 2, 0.5}, {y.x / 2, y.y / 2, y.z / 2, 0.5}, {z.x, z.y, z.z, 0.5}, {0, 0, 0, 1}}})};
}

}  // namespace

FurPass fur_pass(const FurView& view, int pass, float fur_length) {
    const bool only = view.passes == 1;
    const Vec2d r = quasirandom(pass), l = quasirandom(pass * 3 + 1);
    const double golden = pass * 0.6180339887498949;
    const FurMatrices light = light_matrices(normalize(view.to_key) + Vec3d(l.x - 0.5, 0, l.y - 0.5) * (only ? 0 : 0.12), 1.2 + static_cast<double>(fur_length));
    return {.eye = {eye_matrix(view.camera, only ? Vec2d{} : Vec2d(r.x - 0.5, r.y - 0.5)), light.to_light}, .light = light, .sample_shift = static_cast<float>(golden - std::floor(golden))};
}

CoatUniforms coat_uniforms(const Coat& c, float spacing) {
    CoatUniforms u{};
    u.fur_length = c.length;
    u.tilt = c.tilt;
    u.bend = c.bend;
    u.spread = c.spread;
    u.width = c.width * spacing;
    u.taper = c.taper;
    u.length_variation = c.length_variation;
    u.lock = c.lock;
    u.lock_frequency = 1 / (c.lock_size * LockNoise::hills);
    u.curl_radius = c.curl_radius * spacing;
    u.curl_turns = c.curl_turns;
    // Strands per area times the width they have on the whole way to the longest tip. Each takes 0.3 of an optical depth: what it covers,
    // less what it scatters onward.
    const float mean_width = 2 * u.width * (0.5f + 0.3f * c.taper) * (1 - 0.5f * c.length_variation) * (1 + 0.6f * c.guard_hairs);
    u.extinction = 0.3f * mean_width / (spacing * spacing);
    u.root_r = c.root_colour.x;
    u.root_g = c.root_colour.y;
    u.root_b = c.root_colour.z;
    u.tip_r = c.tip_colour.x;
    u.tip_g = c.tip_colour.y;
    u.tip_b = c.tip_colour.z;
    u.colour_variation = c.colour_variation;
    u.grizzle = c.grizzle;
    u.countershade = c.countershade;
    u.gloss = c.gloss;
    u.guard_hairs = c.guard_hairs;
    return u;
}

void set_view(CoatUniforms& u, const FurView& view) {
    const Vec3f eye(view.camera.camera.eye), key(normalize(view.to_key)), rim(normalize(view.to_rim));
    u.layers = static_cast<float>(layers_of(view));
    u.eye_x = eye.x;
    u.eye_y = eye.y;
    u.eye_z = eye.z;
    u.pixel_angle = static_cast<float>(2 * std::tan(view.camera.camera.fov_y_rad / 2) / view.camera.height);
    u.key_x = key.x;
    u.key_y = key.y;
    u.key_z = key.z;
    u.rim_x = rim.x;
    u.rim_y = rim.y;
    u.rim_z = rim.z;
    u.width_px = view.camera.width;
    u.height_px = view.camera.height;
}

}  // namespace relievo

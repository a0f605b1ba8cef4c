// The true picture against colours that can be written down.
#include "core/error.h"
#include "reference/cast.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

using namespace relievo;

namespace {

MapSet maps_of(HeightField height, Vec3f normal = {0, 0, 1}, std::array<std::uint8_t, 4> colour = {255, 255, 255, 255}) {
    MapSet maps;
    maps.height = std::move(height);
    ImageF normals(1, 1, 3);
    normals(0, 0, 0) = normal.x, normals(0, 0, 1) = normal.y, normals(0, 0, 2) = normal.z;
    maps.normal = {normals};
    Image8 colours(1, 1, 4);
    for (int c = 0; c < 4; ++c) colours(0, 0, c) = colour[static_cast<std::size_t>(c)];
    maps.colour = {colours};
    return maps;
}

RayField rays_of(int width, int height, Vec2f uv, Vec3f view, float lod = -20) {
    RayField rays(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            rays.coverage(x, y) = static_cast<std::uint8_t>(Coverage::hit);
            rays.uv(x, y, 0) = uv.x, rays.uv(x, y, 1) = uv.y;
            rays.view(x, y, 0) = view.x, rays.view(x, y, 1) = view.y, rays.view(x, y, 2) = view.z;
            rays.lod(x, y) = lod;
        }
    }
    return rays;
}

Frame frame_of(const RayField& rays, const MapSet& maps, const Lighting& lighting, ReferenceSettings settings = {}) {
    return reference_frame(std::span(&rays, 1), maps, lighting, settings);
}

}  // namespace

TEST(reference_frame, phong_of_a_flat_field_by_hand) {
    Lighting lighting{.ambient = {0.1f, 0.2f, 0.3f}, .lights = {}, .specular = 0.5f, .shininess = 4};
    Light light;
    light.position = {0.6f, 0, 0.8f};
    light.colour = {2, 1, 0.5f};
    lighting.lights = {light};
    // Code 188 is linear 0.5029 (IEC 61966-2-1). n.l = 0.8; the mirror image of l is (-0.6, 0, 0.8); the eye at (0,0,1): r.v = 0.8.
    const Frame frame = frame_of(rays_of(1, 1, {0.3f, 0.4f}, {0, 0, 1}), maps_of(HeightField(4, 4, 0.5f), {0, 0, 1}, {188, 188, 188, 255}), lighting);
    const double albedo = 0.50288645;
    const double shine = 0.5 * std::pow(0.8, 4);
    EXPECT_NEAR(frame.colour(0, 0, 0), 0.1 * albedo + 2 * (albedo * 0.8 + shine), 1e-6);
    EXPECT_NEAR(frame.colour(0, 0, 1), 0.2 * albedo + 1 * (albedo * 0.8 + shine), 1e-6);
    EXPECT_NEAR(frame.colour(0, 0, 2), 0.3 * albedo + 0.5 * (albedo * 0.8 + shine), 1e-6);
    EXPECT_EQ(frame.coverage(0, 0), static_cast<std::uint8_t>(Coverage::hit));
    EXPECT_EQ(frame.hit_height(0, 0), 0.5f);
    EXPECT_EQ(frame.hit_uv(0, 0, 0), 0.3f);
    EXPECT_EQ(frame.shadow(0, 0), 1.0f);
    EXPECT_EQ(frame.normal(0, 0, 2), 1.0f);
    EXPECT_EQ(frame.source, "reference");
}

TEST(reference_frame, a_near_light_fades_with_its_distance_to_the_displaced_point) {
    Lighting lighting{.ambient = {0, 0, 0}, .lights = {}, .specular = 0};
    Light light;
    light.directional = false;
    light.position = {0.5f, -0.25f, 2};
    light.constant = 1, light.linear = 0.5f, light.quadratic = 0.25f;
    lighting.lights = {light};
    // The light stands over uv (1.5, 0.75); the surface 0.25 of the height under the polygon: z = -0.25 * 0.4.
    const ReferenceSettings settings{.height_scale = 0.4f, .zero_level = 1};
    const Frame frame = frame_of(rays_of(1, 1, {1.5f, 0.75f}, {0, 0, 1}), maps_of(HeightField(4, 4, 0.75f)), lighting, settings);
    const double d = 2.1;
    EXPECT_NEAR(frame.colour(0, 0), 1 / (1 + 0.5 * d + 0.25 * d * d), 1e-6);
}

TEST(reference_frame, only_the_key_light_casts_shadows) {
    HeightField wall(32, 1, 0);
    wall.texels(20, 0) = 1;
    Lighting lighting{.ambient = {0, 0, 0}, .lights = {}, .specular = 0};
    Light key;
    key.position = {0.8f, 0, 0.6f};
    Light fill = key;
    fill.colour = {0, 1, 0};
    lighting.lights = {key, fill};
    const ReferenceSettings settings{.height_scale = 0.2f};
    const RayField rays = rays_of(1, 1, {0.55f, 0.5f}, {0, 0, 1});
    const Frame shadowed = frame_of(rays, maps_of(wall), lighting, settings);
    EXPECT_EQ(shadowed.shadow(0, 0), 0);
    EXPECT_EQ(shadowed.colour(0, 0, 0), 0);
    EXPECT_NEAR(shadowed.colour(0, 0, 1), 0.6, 1e-6);
    ReferenceSettings off = settings;
    off.shadow = false;
    EXPECT_EQ(frame_of(rays, maps_of(wall), lighting, off).shadow(0, 0), 1);
}

TEST(reference_frame, colour_is_filtered_between_texels_and_levels_in_linear_light) {
    MapSet maps = maps_of(HeightField(4, 4, 1.0f));
    Image8 fine(2, 2, 4, 0);
    for (int j = 0; j < 2; ++j) fine(1, j, 0) = 255;  // red in the right column
    Image8 coarse(1, 1, 4, 0);
    coarse(0, 0, 1) = 255;  // green, to tell the level
    maps.colour = {fine, coarse};
    Lighting lighting{.ambient = {1, 1, 1}, .lights = {}};
    const auto colour = [&](float u, float lod) {
        const Frame f = frame_of(rays_of(1, 1, {u, 0.3f}, {0, 0, 1}, lod), maps, lighting);
        return Vec2d{f.colour(0, 0, 0), f.colour(0, 0, 1)};
    };
    // Texel centres at 1/4 and 3/4; lod is relative to one texel, so -1 is level 0 of two texels and 0 is level 1.
    EXPECT_NEAR(colour(0.25f, -1).x, 0, 1e-6);
    EXPECT_NEAR(colour(0.75f, -1).x, 1, 1e-6);
    EXPECT_NEAR(colour(0.375f, -1).x, 0.25, 1e-6);
    EXPECT_NEAR(colour(0.0f, -9).x, 0.5, 1e-6);  // over the seam
    EXPECT_NEAR(colour(0.75f, -0.75f).x, 0.75, 1e-6);
    EXPECT_NEAR(colour(0.75f, -0.75f).y, 0.25, 1e-6);
    EXPECT_NEAR(colour(0.75f, 5).y, 1, 1e-6);
}

TEST(reference_frame, samples_average_into_colour_only) {
    const MapSet maps = maps_of(HeightField(4, 4, 0.5f));
    Lighting lighting{.ambient = {1, 1, 1}, .lights = {}, .background = {0.25f, 0.5f, 0.75f}};
    std::vector<RayField> samples(2, rays_of(2, 1, {0.3f, 0.4f}, {0, 0, 1}));
    samples[1].coverage(0, 0) = static_cast<std::uint8_t>(Coverage::background);
    samples[0].coverage(1, 0) = samples[1].coverage(1, 0) = static_cast<std::uint8_t>(Coverage::background);
    const Frame frame = reference_frame(samples, maps, lighting, {});
    EXPECT_FLOAT_EQ(frame.colour(0, 0, 0), 0.625f);
    EXPECT_FLOAT_EQ(frame.colour(1, 0, 2), 0.75f);
    EXPECT_EQ(frame.coverage(0, 0), static_cast<std::uint8_t>(Coverage::hit));
    EXPECT_EQ(frame.coverage(1, 0), static_cast<std::uint8_t>(Coverage::background));
    EXPECT_EQ(frame.hit_height(1, 0), 0);
}

TEST(reference_frame, is_the_same_for_any_number_of_threads) {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> uniform(0, 1);
    HeightField field(33, 20);
    for (float& h : field.texels.texels) h = uniform(random);
    const MapSet maps = maps_of(field);
    RayField rays = rays_of(40, 30, {0, 0}, {0.6f, 0, 0.8f});
    for (float& c : rays.uv.texels) c = uniform(random);
    Lighting lighting;
    lighting.lights.resize(1);
    lighting.lights[0].position = {0.5f, 0.5f, 0.5f};
    ReferenceSettings settings{.height_scale = 0.3f};
    settings.threads = 1;
    const Frame one = frame_of(rays, maps, lighting, settings);
    settings.threads = 3;
    const Frame three = frame_of(rays, maps, lighting, settings);
    EXPECT_EQ(one.colour.texels, three.colour.texels);
    EXPECT_EQ(one.hit_uv.texels, three.hit_uv.texels);
    EXPECT_EQ(one.hit_height.texels, three.hit_height.texels);
    EXPECT_EQ(one.shadow.texels, three.shadow.texels);
}

TEST(reference_frame, says_which_map_is_missing) {
    const RayField rays = rays_of(1, 1, {0, 0}, {0, 0, 1});
    MapSet maps = maps_of(HeightField(4, 4, 0.5f));
    maps.normal.clear();
    try {
        frame_of(rays, maps, {});
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("normal"), std::string::npos);
    }
    EXPECT_THROW(frame_of(rays, MapSet{}, {}), Error);
}

TEST(reference_frame, flat_views_end) {
    const MapSet maps = maps_of(HeightField(16, 16, 0.5f));
    for (const float z : {1e-9f, 0.0f, -0.1f}) {
        const Frame frame = frame_of(rays_of(1, 1, {0.3f, 0.4f}, {1, 0, z}), maps, {});
        EXPECT_EQ(frame.hit_height(0, 0), 0.5f);
        EXPECT_TRUE(std::isfinite(frame.hit_uv(0, 0, 0)));
    }
}

#include "pipeline/fur_reference.h"

#include "core/parallel_for.h"
#include "fur/strand_albedo.h"
#include "reference/strand_tracer.h"

#include <algorithm>
#include <cmath>

namespace relievo {

namespace {

// What a strand on the way to the light takes: exp(-0.3), the extinction of the layers' programs for one strand.
constexpr double extinction_per_strand = 0.3;
constexpr int most_strands = 16;  // e^-4.8 is not worth looking for

Vec3d scaled(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3d mixed(Vec3d a, Vec3d b, double t) { return a * (1 - t) + b * t; }
double fraction(double x) { return x - std::floor(x); }

// Kajiya and Kay's diffuse light, and Marschner's two highlights; shaders/fur/strand_light.glsl says the same in its own words.
Vec3d strand_light(Vec3d albedo, Vec3d tangent, Vec3d normal, Vec3d view, Vec3d light, double gloss) {
    const double along = dot(tangent, light), across = std::sqrt(std::max(1 - along * along, 0.0));
    const double facing = std::clamp((dot(normal, light) + 0.35) / 1.35, 0.0, 1.0);
    const Vec3d half = normalize(light + view);
    const auto lobe = [&](double shift, double power) {
        const double a = dot(normalize(tangent + normal * shift), half);
        return std::pow(std::max(1 - a * a, 0.0), power / 2);
    };
    return (albedo * (across + gloss * 1.2 * lobe(-0.18, 24)) + Vec3d(gloss * 0.35 * lobe(0.12, 96))) * facing;
}

double radical_inverse(std::uint32_t i, std::uint32_t base) {
    double sum = 0, digit = 1.0 / base;
    for (; i > 0; i /= base, digit /= base) sum += digit * (i % base);
    return sum;
}

}  // namespace

FurFrames trace_fur(const StrandCurves& curves, const Mesh& skin, const Coat& coat, const FurView& view, int samples, int threads, const Progress& progress,
                    std::span<const float> lengths) {
    const StrandTracer tracer({.pieces = curves.pieces, .points = curves.points, .radii = curves.radii}, skin);
    const int width = view.camera.width, height = view.camera.height;
    FurFrames frames;
    frames.colour = ImageF(width, height, 3);
    frames.coverage = ImageF(width, height, 1);
    const Vec3d eye = view.camera.camera.eye, key = normalize(view.to_key), rim = normalize(view.to_rim);
    const Vec3d root_colour(coat.root_colour);
    const double gloss = coat.gloss;

    const auto strand_colour = [&](const StrandHit& hit, Vec3d to_eye, Vec3d at) {
        const StrandCurves::Strand& s = curves.strands[hit.index];
        const auto stride = static_cast<std::size_t>(curves.pieces) + 1;
        const auto piece = std::min(static_cast<std::size_t>(hit.way * curves.pieces), stride - 2);
        const std::size_t p = hit.index * stride + piece;
        const Vec3d axis = Vec3d(curves.points[p + 1]) - Vec3d(curves.points[p]), tangent = normalize(axis), normal(s.normal);
        const double level = hit.way * static_cast<double>(s.tip);
        const Vec3d albedo = strand_albedo(coat, s, hit.way);
        const double occlusion = 0.18 + 0.82 * level;
        Vec3d shown = scaled(albedo, mixed({0.30, 0.27, 0.25}, {0.62, 0.70, 0.82}, 0.5 + 0.5 * normal.y)) * (0.55 * occlusion);
        const std::optional<int> crossed = tracer.strands_crossed(at, key, hit.index, most_strands);
        if (crossed) shown += scaled({2.0, 1.88, 1.7}, strand_light(albedo, tangent, normal, to_eye, key, gloss)) * std::exp(-extinction_per_strand * *crossed);
        const double edge = std::max(1 - std::abs(dot(normal, to_eye)), 0.0);
        shown += scaled({0.9, 1.0, 1.15}, albedo + Vec3d(0.1 * gloss)) * (edge * edge * std::max(dot(normal, rim) + 0.3, 0.0) * occlusion);
        return shown;
    };
    const auto skin_colour = [&](const StrandHit& hit) {
        const std::uint32_t* v = &skin.indices[std::size_t{hit.index} * 3];
        const Vec3d n0(skin.normals[v[0]]), n1(skin.normals[v[1]]), n2(skin.normals[v[2]]);
        const Vec3d n = n0 * (1 - hit.weights.x - hit.weights.y) + n1 * hit.weights.x + n2 * hit.weights.y;
        const double l = length(n);
        const Vec3d normal = l > 0 ? n / l : Vec3d(0, 1, 0);
        const Vec3d w(1 - hit.weights.x - hit.weights.y, hit.weights.x, hit.weights.y);
        const double share = lengths.empty() ? 1.0 : static_cast<double>(lengths[v[0]]) * w.x + static_cast<double>(lengths[v[1]]) * w.y + static_cast<double>(lengths[v[2]]) * w.z;
        const double covered = std::clamp(share * 4, 0.0, 1.0);
        return mixed({0.55, 0.42, 0.36}, root_colour, covered) * ((1 - 0.78 * covered) * (0.3 + 0.2 * normal.y + 1.6 * std::max(dot(normal, key), 0.0)));
    };

    parallel_for(height, 4, threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < width; ++x) {
                Vec3d sum;
                int covered = 0;
                // Each pixel's points are turned by a number of its own (Cranley and Patterson 1976), or all would err alike.
                const double turn_x = fraction(x * 0.7548776662466927 + y * 0.5698402909980532), turn_y = fraction(x * 0.5698402909980532 + y * 0.3247179572447461);
                for (int k = 0; k < samples; ++k) {
                    const auto i = static_cast<std::uint32_t>(k);
                    const Vec2d pixel(x + fraction(radical_inverse(i, 2) + turn_x), y + fraction(radical_inverse(i, 3) + turn_y));
                    const Vec3d ray = view.camera.camera.ray(pixel, width, height);
                    const std::optional<StrandHit> hit = tracer.first_hit(eye, ray);
                    if (!hit) continue;
                    ++covered;
                    const Vec3d c = hit->skin ? skin_colour(*hit) : strand_colour(*hit, ray * -1.0, eye + ray * hit->t);
                    // A display shows no more than 1; layers are averaged after that limit, too.
                    sum += Vec3d(std::min(c.x, 1.0), std::min(c.y, 1.0), std::min(c.z, 1.0));
                }
                frames.colour(x, y, 0) = static_cast<float>(sum.x / samples);
                frames.colour(x, y, 1) = static_cast<float>(sum.y / samples);
                frames.colour(x, y, 2) = static_cast<float>(sum.z / samples);
                frames.coverage(x, y) = static_cast<float>(covered) / static_cast<float>(samples);
            }
    }, progress, "tracing strands");
    return frames;
}

}  // namespace relievo

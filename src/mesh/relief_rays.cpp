#include "mesh/relief_rays.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace relievo {

namespace {

// A triangle ready to be met, and what it covers of the picture.
struct Target {
    Vec3d a, edge1, edge2;
    Vec2d uv, uv1, uv2;  // of a; along the edges
    int left = 0, right = -1, top = 0, bottom = -1;  // pixels, inclusive; none
};

struct Met {
    double t = std::numeric_limits<double>::infinity();
    double b1 = 0, b2 = 0;
    std::uint32_t face = no_face;
};

Target target_of(const Mesh& mesh, std::size_t face, const Camera& camera, const Camera::Axes& axes, const ReliefRays& s) {
    const std::uint32_t* c = &mesh.indices[face * 3];
    Target target;
    target.a = Vec3d(mesh.positions[c[0]]);
    target.edge1 = Vec3d(mesh.positions[c[1]]) - target.a;
    target.edge2 = Vec3d(mesh.positions[c[2]]) - target.a;
    target.uv = Vec2d(mesh.uvs[c[0]]);
    target.uv1 = Vec2d(mesh.uvs[c[1]]) - target.uv;
    target.uv2 = Vec2d(mesh.uvs[c[2]]) - target.uv;
    if (!(dot(cross(target.edge1, target.edge2), camera.eye - target.a) > 0)) return target;
    if (target.uv1.x * target.uv2.y - target.uv1.y * target.uv2.x == 0) return target;
    const double up = s.height / (2 * std::tan(camera.fov_y_rad / 2));
    std::array<double, 2> low{1e30, 1e30}, high{-1e30, -1e30};
    for (int k = 0; k < 3; ++k) {
        const Vec3d p = Vec3d(mesh.positions[c[k]]) - camera.eye;
        const double depth = -dot(p, axes.back);
        // What reaches behind the eye may be anywhere.
        if (!(depth > 1e-9)) {
            low = {-1e30, -1e30}, high = {1e30, 1e30};
            break;
        }
        const double at[2] = {s.width / 2.0 + dot(p, axes.right) / depth * up, s.height / 2.0 - dot(p, axes.up) / depth * up};
        for (std::size_t i = 0; i < 2; ++i) low[i] = std::min(low[i], at[i]), high[i] = std::max(high[i], at[i]);
    }
    target.left = static_cast<int>(std::clamp(low[0] - 1, 0.0, static_cast<double>(s.width)));
    target.right = static_cast<int>(std::clamp(high[0] + 1, -1.0, s.width - 1.0));
    target.top = static_cast<int>(std::clamp(low[1] - 1, 0.0, static_cast<double>(s.height)));
    target.bottom = static_cast<int>(std::clamp(high[1] + 1, -1.0, s.height - 1.0));
    return target;
}

// Möller and Trumbore 1997. Edges belong to both sides, so that no pixel falls between two faces.
void meet(const Target& target, Vec3d eye, Vec3d direction, double beyond, std::uint32_t face, Met& nearest) {
    const Vec3d p = cross(direction, target.edge2);
    const double det = dot(target.edge1, p);
    if (!(det > 0)) return;
    const Vec3d from = eye - target.a;
    constexpr double rim = -1e-9;
    const double b1 = dot(from, p) / det;
    if (!(b1 >= rim && b1 <= 1 - rim)) return;
    const Vec3d q = cross(from, target.edge1);
    const double b2 = dot(direction, q) / det;
    if (!(b2 >= rim && b1 + b2 <= 1 - rim)) return;
    const double t = dot(target.edge2, q) / det;
    if (t > beyond && t < nearest.t) nearest = {t, b1, b2, face};
}

void put(ImageF& plane, int x, int y, Vec3d v) {
    plane(x, y, 0) = static_cast<float>(v.x), plane(x, y, 1) = static_cast<float>(v.y), plane(x, y, 2) = static_cast<float>(v.z);
}

// Gradients of u and v in the plane with normal n, of a face whose edges are laid into it.
std::pair<Vec3d, Vec3d> gradients(const Target& t, Vec3d n) {
    const Vec3d e1 = t.edge1 - n * dot(t.edge1, n);
    const Vec3d e2 = t.edge2 - n * dot(t.edge2, n);
    // Dual to the edges: d1 . e1 = 1, d1 . e2 = 0.
    const double twice = dot(cross(e1, e2), n);
    const Vec3d d1 = cross(e2, n) / twice;
    const Vec3d d2 = cross(n, e1) / twice;
    return {d1 * t.uv1.x + d2 * t.uv2.x, d1 * t.uv1.y + d2 * t.uv2.y};
}

}  // namespace

MeshRays relief_rays(const Mesh& mesh, const Charts& charts, const Camera& camera, const ReliefRays& s) {
    assert(mesh.normals.size() == mesh.positions.size() && mesh.uvs.size() == mesh.positions.size());
    assert(charts.of_face.size() == mesh.faces() && s.width > 0 && s.height > 0 && s.repeats > 0);
    const Camera::Axes axes = camera.axes();
    std::vector<Target> targets(mesh.faces());
    parallel_for(static_cast<int>(targets.size()), 1024, s.threads, [&](int begin, int end) {
        for (int f = begin; f < end; ++f) targets[static_cast<std::size_t>(f)] = target_of(mesh, static_cast<std::size_t>(f), camera, axes, s);
    });

    MeshRays out(s.width, s.height);
    constexpr int band = 8;
    parallel_for((s.height + band - 1) / band, 1, s.threads, [&](int begin, int end) {
        for (int b = begin; b < end; ++b) {
            const int top = b * band;
            const int bottom = std::min(top + band, s.height) - 1;
            std::vector<Met> met(static_cast<std::size_t>(band * s.width));
            const auto direction = [&](double x, double y) { return camera.ray(Vec2d{x + 0.5, y + 0.5} + s.offset, s.width, s.height); };
            for (std::size_t f = 0; f < targets.size(); ++f) {
                const Target& t = targets[f];
                for (int y = std::max(top, t.top); y <= std::min(bottom, t.bottom); ++y)
                    for (int x = t.left; x <= t.right; ++x)
                        meet(t, camera.eye, direction(x, y), s.beyond != nullptr ? static_cast<double>((*s.beyond)(x, y)) : 0.0, static_cast<std::uint32_t>(f),
                             met[static_cast<std::size_t>((y - top) * s.width + x)]);
            }
            for (int y = top; y <= bottom; ++y) {
                for (int x = 0; x < s.width; ++x) {
                    const Met& m = met[static_cast<std::size_t>((y - top) * s.width + x)];
                    if (m.face == no_face) continue;
                    const Target& t = targets[m.face];
                    const std::uint32_t* c = &mesh.indices[std::size_t{m.face} * 3];
                    const Vec3d d = direction(x, y);
                    const Vec3d face_normal = normalize(cross(t.edge1, t.edge2));
                    const Vec3d blended = Vec3d(mesh.normals[c[0]]) * (1 - m.b1 - m.b2) + Vec3d(mesh.normals[c[1]]) * m.b1 + Vec3d(mesh.normals[c[2]]) * m.b2;
                    // Near an outline the blended normal may turn away while the face does not; the face's own is then the plane's.
                    const bool usable = dot(blended, blended) > 1e-12 && -dot(normalize(blended), d) > flattest_cosine && dot(normalize(blended), face_normal) > 0.1;
                    const Vec3d n = usable ? normalize(blended) : face_normal;
                    const auto [gradient_u, gradient_v] = gradients(t, n);
                    const Vec3d along_u = gradient_u * s.repeats;
                    const Vec3d along_v = gradient_v * s.repeats;
                    const double amplitude = s.height_scale * charts.scale[charts.of_face[m.face]] / s.repeats;
                    const double cosine = std::clamp(-dot(n, d), flattest_cosine, 1.0);
                    const Vec2d per_height = Vec2d{-dot(along_u, d), -dot(along_v, d)} * (amplitude / cosine);
                    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
                    const double speed = length(per_height);
                    const Vec2d uv = t.uv + t.uv1 * m.b1 + t.uv2 * m.b2;

                    out.rays.coverage(x, y) = static_cast<std::uint8_t>(Coverage::hit);
                    out.rays.uv(x, y, 0) = static_cast<float>(uv.x * s.repeats);
                    out.rays.uv(x, y, 1) = static_cast<float>(uv.y * s.repeats);
                    const Vec2d toward = speed > 0 ? per_height * (sine / speed) : Vec2d{0, 0};
                    put(out.rays.view, x, y, {toward.x, toward.y, cosine});
                    out.height_scale(x, y) = static_cast<float>(sine > 1e-9 ? speed * cosine / sine : s.height_scale);
                    // The pixel's footprint on the face's plane (Heckbert 1983's max(|du|, |dv|)).
                    double footprint = 0;
                    for (const Vec2d step : {Vec2d{1, 0}, Vec2d{0, 1}}) {
                        const Vec3d beside = direction(x + step.x, y + step.y);
                        const double facing = dot(face_normal, beside);
                        if (facing == 0) continue;
                        const Vec3d moved = beside * (dot(face_normal, t.a - camera.eye) / facing) - d * m.t;
                        footprint = std::max(footprint, length(Vec2d{dot(along_u, moved), dot(along_v, moved)}));
                    }
                    out.rays.lod(x, y) = static_cast<float>(std::log2(std::max(footprint, 1e-9)));

                    out.range(x, y, 0) = 1, out.range(x, y, 1) = 0;
                    if (s.ends_with_chart) {
                        const Vec2d whole = per_height * (1 / s.repeats);
                        const double above = 1 - s.zero_level;
                        if (above > 0) out.range(x, y, 0) = static_cast<float>(s.zero_level + above * walk_chart(mesh, charts, m.face, uv, whole * above).share);
                        else out.range(x, y, 0) = static_cast<float>(s.zero_level);
                        out.range(x, y, 1) = static_cast<float>(s.zero_level * (1 - walk_chart(mesh, charts, m.face, uv, whole * -s.zero_level).share));
                    }
                    out.amplitude(x, y) = static_cast<float>(amplitude);
                    put(out.position, x, y, camera.eye + d * m.t);
                    put(out.to_eye, x, y, -d);
                    put(out.normal, x, y, n);
                    put(out.along_u, x, y, along_u);
                    put(out.along_v, x, y, along_v);
                    out.distance(x, y) = static_cast<float>(m.t);
                    out.face[static_cast<std::size_t>(y) * static_cast<std::size_t>(s.width) + static_cast<std::size_t>(x)] = m.face;
                }
            }
        }
    });
    return out;
}

}  // namespace relievo

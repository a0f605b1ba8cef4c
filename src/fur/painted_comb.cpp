#include "fur/painted_comb.h"

#include "core/error.h"
#include "mesh/equal_vertices.h"
#include "mesh/tangents.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace relievo {

namespace {

// 128 of a byte is 0 and 255 is 1, in pictures of any depth. 128/255 is no float: what its rounding leaves is nothing painted.
double signed_code(double v) {
    const double code = std::clamp((v * 255 - 128) / 127, -1.0, 1.0);
    return std::abs(code) > 1e-6 ? code : 0;
}

struct Stroke {
    Vec2d along;  // u and v
    double weight = 0;
};

// Bilinear between the texels' middles, weighted colours, so that what is painted does not fade into what is not.
Stroke stroke_at(const ImageF& picture, Vec2d uv) {
    const double x = uv.x * picture.width - 0.5, y = uv.y * picture.height - 0.5, left = std::floor(x), below = std::floor(y);
    const auto wrapped = [](double i, int size) { return static_cast<int>(i - std::floor(i / size) * size); };
    Stroke sum;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const double share = (i ? x - left : 1 - (x - left)) * (j ? y - below : 1 - (y - below));
            const float* t = picture.at(wrapped(left + i, picture.width), wrapped(below + j, picture.height));
            const double weight = share * std::clamp(static_cast<double>(t[picture.channels >= 4 ? 3 : 2]), 0.0, 1.0);
            sum.along += Vec2d(signed_code(static_cast<double>(t[0])), signed_code(static_cast<double>(t[1]))) * weight;
            sum.weight += weight;
        }
    return sum;
}

Vec3d no_longer_than(Vec3d v, double limit) {
    const double l = length(v);
    return l > limit ? v * (limit / l) : v;
}

}  // namespace

std::vector<PaintedLean> painted_leans(const Mesh& mesh, const CombPaint& paint) {
    if (paint.empty()) return {};
    assert(mesh.normals.size() == mesh.positions.size() && (paint.colours || paint.picture));
    const std::size_t count = mesh.positions.size();
    struct Sum {
        Vec3d lean;
        double weight = 0, corners = 0;
    };
    std::vector<Sum> sums(count);
    const std::vector<std::uint32_t> place = first_equal_vertex(mesh, Compared::positions);
    const auto add = [&](std::uint32_t v, Vec3d lean, double weight) {
        Sum& s = sums[place[v]];
        s.lean += lean;
        s.weight += weight;
        s.corners += 1;
    };
    if (paint.colours) {
        if (mesh.colours.empty()) throw Error("comb the fur of", mesh.name, "it has no vertex colours", "paint it, or take a picture (--comb FILE.png)");
        for (const std::uint32_t v : mesh.indices) {
            const Vec3f& c = mesh.colours[v];
            const Vec3d way = no_longer_than({signed_code(static_cast<double>(c.x)), signed_code(static_cast<double>(c.y)), signed_code(static_cast<double>(c.z))}, 1);
            // Full strength whatever the weight, from 30 degrees off the normal, as the comb's own flow is laid into the skin.
            const double weight = length(way);
            const Vec3d unit = weight > 0 ? way / weight : Vec3d(), n(mesh.normals[v]), d = unit - n * dot(n, unit);
            const double l = length(d);
            add(v, (l > 0.5 ? d / l : d * 2.0) * weight, weight);
        }
    } else {
        if (mesh.uvs.empty()) throw Error("comb the fur of", mesh.name, "it has no texture coordinates, over which " + paint.file + " could be painted", "unwrap it, or paint its vertices (--comb colours)");
        if (paint.picture->channels < 3) throw Error("comb fur by", paint.file, "it has no red, green and blue", "save it as RGB or RGBA: red and green tell the direction, alpha or blue how strongly it holds");
        const TangentMesh framed = with_tangents(mesh);
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const std::uint32_t v = mesh.indices[i];
            const Vec4f& frame = framed.tangents[framed.mesh.indices[i]];
            const Vec3d n(mesh.normals[v]), t(frame.x, frame.y, frame.z), b = cross(n, t) * static_cast<double>(frame.w);
            const Stroke s = stroke_at(*paint.picture, Vec2d(mesh.uvs[v]));
            add(v, no_longer_than(t * s.along.x + b * s.along.y, s.weight), s.weight);
        }
    }
    std::vector<PaintedLean> leans(count);
    bool any = false;
    for (std::size_t v = 0; v < count; ++v) {
        const Sum& s = sums[place[v]];
        if (!(s.corners > 0)) continue;
        leans[v] = {Vec3f(s.lean / s.corners), static_cast<float>(s.weight / s.corners)};
        any = any || leans[v].weight > 0;
    }
    if (!any) leans.clear();
    return leans;
}

std::vector<Vec3f> upright_but_for(const Mesh& mesh, std::span<const PaintedLean> painted) {
    std::vector<Vec3f> comb(mesh.positions.size());
    for (std::size_t v = 0; v < painted.size(); ++v) comb[v] = painted[v].weighted - mesh.normals[v] * dot(mesh.normals[v], painted[v].weighted);
    return comb;
}

}  // namespace relievo

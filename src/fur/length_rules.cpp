#include "fur/length_rules.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "core/suggest.h"
#include "fur/lock_noise.h"
#include "mesh/equal_vertices.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace relievo {

namespace {

constexpr LengthQuantityEntry quantities[] = {
    {LengthQuantity::up, "up", -0.3, 0.3, LengthArgument::none, "how far the skin looks up: 1 on level ground, 0 on a wall, -1 on a ceiling"},
    {LengthQuantity::height, "height", 0, 1, LengthArgument::none, "0 at the mesh's lowest point, 1 at its highest"},
    {LengthQuantity::curvature, "curvature", -2, 2, LengthArgument::none, "of the skin, per radius of the mesh's sphere: positive where it bulges"},
    {LengthQuantity::distance, "distance", 0.2, 0.4, LengthArgument::place, "from the place @X,Y,Z of the mesh's own space, in radii of its sphere"},
    {LengthQuantity::noise, "noise", -0.5, 0.5, LengthArgument::size, "hills from -1 to 1, @SIZE radii wide (0.2): fur of uneven height"},
    {LengthQuantity::red, "red", 0, 1, LengthArgument::none, "of the mesh's vertex colours, as stored"},
    {LengthQuantity::green, "green", 0, 1, LengthArgument::none, "the same"},
    {LengthQuantity::blue, "blue", 0, 1, LengthArgument::none, "the same"},
    {LengthQuantity::grey, "grey", 0, 1, LengthArgument::none, "the mean of the three"},
    {LengthQuantity::mask, "mask", 0, 1, LengthArgument::file, "grey of the picture @FILE at the mesh's texture coordinates; without any, thrown on along z"},
};

const LengthQuantityEntry& entry_of(LengthQuantity quantity) { return *std::ranges::find(quantities, quantity, &LengthQuantityEntry::quantity); }

double number(std::string_view text, const std::string& rule) {
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw UsageError("--grow-where takes NAME=FROM..TO@ARGUMENT; \"" + std::string(text) + "\" in \"" + rule + "\" is no number");
    return value;
}

double smooth(double from, double to, double value) {
    const double t = from == to ? (value < from ? 0.0 : 1.0) : std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// Row 0 at v = 0, the edge repeated outwards.
double grey_at(const ImageF& mask, Vec2d uv) {
    // The whole part is cut off: coordinates of tiled pictures go on beyond 1, and 1 itself is the far edge.
    const auto inside = [](double c) { return c >= 0 && c <= 1 ? c : c - std::floor(c); };
    const double x = inside(uv.x) * mask.width - 0.5, y = inside(uv.y) * mask.height - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const auto texel = [&](int i, int j) {
        const float* t = mask.at(std::clamp(i, 0, mask.width - 1), std::clamp(j, 0, mask.height - 1));
        const int colours = mask.channels >= 3 ? 3 : 1;
        double sum = 0;
        for (int c = 0; c < colours; ++c) sum += static_cast<double>(t[c]);
        return sum / colours;
    };
    const double fx = x - x0, fy = y - y0;
    return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) + (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

}  // namespace

std::span<const LengthQuantityEntry> length_quantities() { return quantities; }

LengthRule length_rule(const std::string& text) {
    std::string_view rest = text, argument;
    const std::size_t at = rest.find('@');
    if (at != std::string_view::npos) {
        argument = rest.substr(at + 1);
        rest = rest.substr(0, at);
    }
    const std::size_t equals = rest.find('=');
    const std::string_view id = rest.substr(0, equals);
    const auto found = std::ranges::find(quantities, id, &LengthQuantityEntry::id);
    if (found == std::end(quantities)) {
        std::vector<std::string> known;
        for (const LengthQuantityEntry& q : quantities) known.emplace_back(q.id);
        throw UsageError(unknown_word("rule of length", std::string(id), known));
    }
    LengthRule rule{.quantity = found->quantity, .from = found->from, .to = found->to};
    if (equals != std::string_view::npos) {
        const std::string_view range = rest.substr(equals + 1);
        const std::size_t dots = range.find("..");
        if (dots == std::string_view::npos) throw UsageError("--grow-where takes NAME=FROM..TO, not \"" + text + "\"");
        rule.from = number(range.substr(0, dots), text);
        rule.to = number(range.substr(dots + 2), text);
    }
    const bool given = !argument.empty();
    switch (found->argument) {
    case LengthArgument::none:
        if (given) throw UsageError("--grow-where " + std::string(id) + " takes nothing behind an @: \"" + text + "\"");
        break;
    case LengthArgument::size:
        if (given) rule.size = number(argument, text);
        if (!(rule.size > 0)) throw UsageError("--grow-where " + std::string(id) + " takes a size above 0 behind the @, not \"" + text + "\"");
        break;
    case LengthArgument::file:
        if (!given) throw UsageError("--grow-where " + std::string(id) + " takes a picture: " + std::string(id) + "@FILE");
        rule.file = argument;
        break;
    case LengthArgument::place: {
        std::array<double, 3> c{};
        std::string_view left = argument;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t comma = a < 2 ? left.find(',') : left.size();
            if (left.empty() || comma == std::string_view::npos) throw UsageError("--grow-where " + std::string(id) + " takes a place: " + std::string(id) + "@X,Y,Z, not \"" + text + "\"");
            c[a] = number(left.substr(0, comma), text);
            left = left.substr(std::min(comma + 1, left.size()));
        }
        rule.place = {c[0], c[1], c[2]};
    }
    }
    return rule;
}

std::vector<float> mean_curvature(const Mesh& mesh, int threads) {
    assert(mesh.normals.size() == mesh.positions.size());
    // Edges of the inside come twice, once from either face; those of a border once: all that is wanted is their mean.
    const std::vector<std::uint32_t> place = first_equal_vertex(mesh, Compared::positions, threads);
    std::vector<double> sum(mesh.positions.size(), 0.0);
    std::vector<std::uint32_t> edges(mesh.positions.size(), 0);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
            const Vec3d way = Vec3d(mesh.positions[b]) - Vec3d(mesh.positions[a]);
            const double square = dot(way, way);
            if (!(square > 0)) continue;
            const double bend = dot(Vec3d(mesh.normals[b]) - Vec3d(mesh.normals[a]), way) / square;
            for (const std::uint32_t v : {place[a], place[b]}) {
                sum[v] += bend;
                ++edges[v];
            }
        }
    std::vector<float> curvature(mesh.positions.size(), 0.0f);
    for (std::size_t v = 0; v < curvature.size(); ++v)
        if (edges[place[v]] > 0) curvature[v] = static_cast<float>(sum[place[v]] / edges[place[v]]);
    return curvature;
}

std::vector<float> length_shares(const Mesh& mesh, const Sphere& sphere, std::span<const LengthRule> rules, int threads) {
    if (rules.empty()) return {};
    assert(mesh.normals.size() == mesh.positions.size());
    const Box box = bounding_box(mesh.positions, threads);
    std::vector<float> curvature;
    LockNoise noise;
    for (const LengthRule& r : rules) {
        const LengthQuantityEntry& e = entry_of(r.quantity);
        if (r.quantity == LengthQuantity::curvature && curvature.empty()) curvature = mean_curvature(mesh, threads);
        if (r.quantity == LengthQuantity::noise && noise.texels.empty()) noise = lock_noise();
        const bool colour = r.quantity >= LengthQuantity::red && r.quantity <= LengthQuantity::grey;
        if (colour && mesh.colours.empty())
            throw Error("grow fur by \"" + std::string(e.id) + "\" on", mesh.name, "it has no vertex colours", "paint it, or take mask@PICTURE or another rule (relievo fur --help)");
        assert(r.quantity != LengthQuantity::mask || r.mask);
    }
    const auto value = [&](const LengthRule& r, std::size_t v) -> double {
        const Vec3d p(mesh.positions[v]);
        switch (r.quantity) {
        case LengthQuantity::up: return static_cast<double>(mesh.normals[v].y);
        case LengthQuantity::height: return box.size().y > 0 ? (p.y - static_cast<double>(box.low.y)) / box.size().y : 0.0;
        case LengthQuantity::curvature: return static_cast<double>(curvature[v]);
        case LengthQuantity::distance: return length(p - (r.place - sphere.centre) * (1 / sphere.radius));
        case LengthQuantity::noise: return lock_noise_at(noise, p * (1 / (r.size * LockNoise::hills))).y;
        case LengthQuantity::red: return static_cast<double>(mesh.colours[v].x);
        case LengthQuantity::green: return static_cast<double>(mesh.colours[v].y);
        case LengthQuantity::blue: return static_cast<double>(mesh.colours[v].z);
        case LengthQuantity::grey: return static_cast<double>(mesh.colours[v].x + mesh.colours[v].y + mesh.colours[v].z) / 3;
        case LengthQuantity::mask: {
            if (!mesh.uvs.empty()) return grey_at(*r.mask, Vec2d(mesh.uvs[v]));
            const Vec3d size = box.size(), from = p - Vec3d(box.low);
            return grey_at(*r.mask, {size.x > 0 ? from.x / size.x : 0.5, size.y > 0 ? from.y / size.y : 0.5});
        }
        }
        return 0;
    };
    std::vector<float> shares(mesh.positions.size());
    parallel_for(static_cast<int>(shares.size()), 16384, threads, [&](int begin, int end) {
        for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
            double share = 1;
            for (const LengthRule& r : rules) share *= smooth(r.from, r.to, value(r, v));
            shares[v] = static_cast<float>(share);
        }
    });
    return shares;
}

}  // namespace relievo

#include "pipeline/fur_effects.h"

#include "mesh/made_up_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace relievo {

namespace {

// Strands that stand upright on a ball, apart enough to see between them; red, on skin and roots of green. On a ball a direction's texture is at its
// best: normal and position agree.
constexpr double fur_length = 0.15;

Mesh ball() { return made_up_scan({.faces = 8000, .relief = 0, .noise = 0}); }

// Its sides are flat but at the edges, where normals turn.
Mesh box() {
    constexpr int n = 16;
    Mesh mesh;
    mesh.name = "box";
    const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int side = 0; side < 6; ++side) {
        const Vec3d out = axes[side / 2] * (side % 2 == 0 ? 1 : -1), u = axes[(side / 2 + 1) % 3], v = cross(out, u);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k <= n; ++k)
            for (int i = 0; i <= n; ++i) mesh.positions.push_back(Vec3f(out + u * (2.0 * i / n - 1) + v * (2.0 * k / n - 1)));
        for (std::uint32_t k = 0; k < n; ++k)
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t a = first + k * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
                mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
            }
    }
    return mesh;
}

Coat brush(double grown, float strands = 6000) {
    Coat coat;
    coat.strands = strands;
    coat.length = static_cast<float>(fur_length * grown);
    coat.tilt = coat.bend = coat.spread = coat.length_variation = coat.lock = 0;
    coat.width = 0.2f;
    coat.taper = 1;
    coat.root_colour = {0.01f, 0.4f, 0.01f};
    coat.tip_colour = {0.4f, 0.01f, 0.01f};
    coat.colour_variation = coat.countershade = coat.gloss = coat.guard_hairs = 0;
    return coat;
}

// From the front, `turned` to the right; the picture is as high as a square of that side at the ball's middle.
MeshView seen(double turned_rad, double side, int pixels) {
    constexpr double distance = 4;
    MeshView view;
    view.width = view.height = pixels;
    view.camera.eye = {distance * std::sin(turned_rad), 0, distance * std::cos(turned_rad)};
    view.camera.target = {0, 0, 0};
    view.camera.up = {0, 1, 0};
    view.camera.fov_y_rad = 2 * std::atan(side / 2 / distance);
    return view;
}

FurFrames drawn(CoatPainter& painter, Mesh mesh, const Coat& coat, FurView view) {
    view = with_layers(view, painter.wear(std::move(mesh), coat, view.camera).layers);
    return painter.draw(view);
}

double light_at(const FurFrames& f, int x, int y) { return f.colour(x, y, 0) + f.colour(x, y, 1) + f.colour(x, y, 2); }

// Between pixels, whose middles lie at halves.
double light_between(const FurFrames& f, Vec2d at) {
    const double x = std::clamp(at.x - 0.5, 0.0, f.colour.width - 1.001), y = std::clamp(at.y - 0.5, 0.0, f.colour.height - 1.001);
    const int i = static_cast<int>(x), k = static_cast<int>(y);
    const double u = x - i, v = y - k;
    return (light_at(f, i, k) * (1 - u) + light_at(f, i + 1, k) * u) * (1 - v) + (light_at(f, i, k + 1) * (1 - u) + light_at(f, i + 1, k + 1) * u) * v;
}

// Where a place is seen by `seen(turned)`.
Vec2d projected(Vec3d place, double turned_rad, const MeshView& view) {
    const double c = std::cos(turned_rad), s = std::sin(turned_rad);
    const double x = place.x * c - place.z * s, depth = length(view.camera.eye) - (place.x * s + place.z * c);
    const double pixels = view.height / (2 * std::tan(view.camera.fov_y_rad / 2)) / depth;
    return {view.width / 2.0 + x * pixels, view.height / 2.0 - place.y * pixels};
}

// Correlation of two square pictures without what changes over more than a few pixels: light on the ball would agree at any height.
double likeness_of_detail(const std::vector<double>& l, const std::vector<double>& r, int size) {
    constexpr int near = 4;
    double ll = 0, rr = 0, lr = 0;
    for (int y = near; y < size - near; ++y)
        for (int x = near; x < size - near; ++x) {
            double mean_l = 0, mean_r = 0;
            for (int j = -near; j <= near; ++j)
                for (int i = -near; i <= near; ++i) {
                    const auto p = static_cast<std::size_t>((y + j) * size + x + i);
                    mean_l += l[p], mean_r += r[p];
                }
            constexpr double count = (2 * near + 1) * (2 * near + 1);
            const auto p = static_cast<std::size_t>(y * size + x);
            const double a = l[p] - mean_l / count, b = r[p] - mean_r / count;
            ll += a * a, rr += b * b, lr += a * b;
        }
    return lr / std::sqrt(std::max(ll * rr, 1e-12));
}

// Two views ten degrees to either side, laid over each other as if all they show lay at one height over the skin. The height at which they agree
// best is that of what is seen: the skin's own where strands are painted on it.
double measured_parallax(CoatPainter& painter, double grown) {
    constexpr double turn = 10 * std::numbers::pi / 180, side = 0.8;
    const FurView left{.camera = seen(-turn, side, 200), .to_key = {0, 0.5, 1}, .passes = 4}, right{.camera = seen(turn, side, 200), .to_key = {0, 0.5, 1}, .passes = 4};
    const FurFrames from_left = drawn(painter, ball(), brush(grown), left), from_right = drawn(painter, ball(), brush(grown), right);
    double best = -2, height = 0;
    for (int step = -10; step <= 30; ++step) {
        const double h = fur_length * step / 20;
        constexpr int half = 40;
        constexpr double reach = 0.22;  // radians from the ball's front
        std::vector<double> l, r;
        for (int i = -half; i <= half; ++i)
            for (int k = -half; k <= half; ++k) {
                const double u = reach * i / half, v = reach * k / half;
                const Vec3d place = Vec3d(std::sin(u) * std::cos(v), std::sin(v), std::cos(u) * std::cos(v)) * (1 + h);
                l.push_back(light_between(from_left, projected(place, -turn, left.camera)));
                r.push_back(light_between(from_right, projected(place, turn, right.camera)));
            }
        const double alike = likeness_of_detail(l, r, 2 * half + 1);
        if (alike > best) {
            best = alike;
            height = h;
        }
    }
    return height / fur_length;
}

// A ring of the ball, radii in its own units, as the front view shows it: of its pixels the share that `counts` says.
template <class Counts>
double share_of_ring(const FurFrames& f, const MeshView& view, double inner, double outer, const Counts& counts) {
    double sum = 0;
    int pixels = 0;
    const double half = std::tan(view.camera.fov_y_rad / 2);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double px = (2 * x + 1 - view.width) * half / view.height, py = (2 * y + 1 - view.height) * half / view.height;
            const double radius = length(view.camera.eye) * std::sin(std::atan(std::hypot(px, py)));
            if (radius < inner || radius > outer) continue;
            sum += counts(f, x, y);
            ++pixels;
        }
    return sum / std::max(pixels, 1);
}

double is_green(const FurFrames& f, int x, int y) { return f.colour(x, y, 1) > f.colour(x, y, 0) ? 1 : 0; }
double is_covered(const FurFrames& f, int x, int y) { return f.coverage(x, y); }

// Skin and roots near the rim, seen at 12 to 26 degrees, with strands and with stubble. One pass, so that a pixel is one or the
// other; by hue, so that light does not matter.
double measured_occlusion(CoatPainter& painter, double grown) {
    const FurView view{.camera = seen(0, 2.5, 200), .to_key = {0, 0.5, 1}, .passes = 1};
    const auto green = [&](double share) { return share_of_ring(drawn(painter, ball(), brush(share), view), view.camera, 0.9, 0.98, is_green); };
    return 1 - green(grown) / std::max(green(fur_stubble), 1e-9);
}

// A side of a box, lit from 30 and from 75 degrees to its normal: the lower light comes through more fur. Next to that the same of
// stubble, which leaves how strands of the one kind shine in either light. Red alone, which is strands and no skin.
double measured_shadow(CoatPainter& painter, double grown) {
    constexpr double high = 30 * std::numbers::pi / 180, low = 75 * std::numbers::pi / 180;
    FurView view{.camera = seen(0, 1, 160), .passes = 4};
    view.camera.camera.eye = {0, 2.8, 2.8};
    const auto red = [&](double share, double angle) {
        view.to_key = {std::sin(angle), 0, std::cos(angle)};
        const FurFrames f = drawn(painter, box(), brush(share, 20000), view);
        double sum = 0;
        for (int y = view.camera.height / 2; y < view.camera.height; ++y)
            for (int x = 0; x < view.camera.width; ++x)
                if (std::hypot(x - view.camera.width / 2, y - view.camera.height * 0.8) < 24) sum += f.colour(x, y, 0);
        return sum;
    };
    const auto quotient = [&](double share) { return red(share, low) / std::max(red(share, high), 1e-9); };
    return 1 - quotient(grown) / std::max(quotient(fur_stubble), 1e-9);
}

double measured_silhouette(CoatPainter& painter, double grown) {
    const FurView view{.camera = seen(0, 2.5, 200), .passes = 4};
    return share_of_ring(drawn(painter, ball(), brush(grown), view), view.camera, 1 + 0.15 * fur_length, 1 + 0.4 * fur_length, is_covered);
}

double measured_evenness(CoatPainter& painter, double) {
    Coat coat;
    coat.strands = 20000;
    painter.wear(made_up_scan({.faces = 8000}), coat, seen(0, 2.5, 200));
    return 1 / painter.counted().evenness.density_p95_over_p5;  // 0 of infinity
}

constexpr FurEffectKind kinds[] = {
    {"parallax", "Parallax", "upright strands on a ball, seen from ten degrees to the left and to the right", "height over the skin at which the two pictures agree, in lengths of a strand", 0.3, 0.1,
     &FurEffects::parallax, measured_parallax},
    {"occlusion", "Occlusion", "skin and roots behind such strands, seen 12 to 26 degrees above the skin", "share of them that strands hide", 0.5, 0.1, &FurEffects::occlusion, measured_occlusion},
    {"self_shadow", "Self-shadow", "20,000 such strands on a box, lit from 30 and from 75 degrees to the normal of a side", "share of the lower light that strands take from each other", 0.1, 0.03, &FurEffects::self_shadow, measured_shadow},
    {"silhouette", "Silhouette", "a ring beyond the ball's own outline", "share of it that is covered", 0.5, 0.02, &FurEffects::silhouette, measured_silhouette},
    {"even_roots", "Even roots", "a made-up scan in 20,000 strands", "density of strands over the surface, 5th percentile over 95th", 0.67, 0.4, &FurEffects::even_roots, measured_evenness},
};
static_assert(std::size(kinds) == fur_effect_count);

std::string cell_text(double share, const FurEffectKind& kind, bool markdown) {
    char number[16];
    std::snprintf(number, sizeof number, "%.2f", std::max(share, 0.0));
    const bool there = share >= kind.present_from;
    return std::string(there ? (markdown ? "**yes** " : "yes ") : (markdown ? "no " : "no  ")) + number;
}

}  // namespace

std::span<const FurEffectKind> fur_effect_kinds() { return kinds; }

std::vector<FurEffectRow> fur_effects_table(const std::string& device, const Progress& progress) {
    std::vector<FurEffectRow> rows;
    for (const FurMode& mode : fur_modes) {
        report(progress, "measuring effects of fur", static_cast<double>(rows.size()) / std::size(fur_modes));
        CoatPainter painter(mode.kind, device);
        FurEffectRow& row = rows.emplace_back();
        row.mode = &mode;
        for (std::size_t k = 0; k < fur_effect_count; ++k) row.shares[k] = kinds[k].measure(painter, 1);
    }
    report(progress, "measuring effects of fur", 1);
    return rows;
}

std::string fur_effects_text(std::span<const FurEffectRow> rows, bool markdown) {
    std::string text = markdown ? "| mode |" : "mode      ";
    for (const FurEffectKind& k : kinds) {
        std::string title(markdown ? k.title : k.id);
        if (!markdown) title.resize(14, ' ');
        text += markdown ? " " + title + " |" : title;
    }
    text += "\n";
    if (markdown) {
        text += "|---|";
        for (int k = 0; k < fur_effect_count; ++k) text += "---|";
        text += "\n";
    }
    for (const FurEffectRow& row : rows) {
        std::string id(row.mode->id);
        if (!markdown) id.resize(10, ' ');
        text += markdown ? "| [" + std::string(row.mode->title) + "](fur/" + id + ".md) |" : id;
        for (std::size_t k = 0; k < fur_effect_count; ++k) {
            std::string cell = cell_text(row.shares[k], kinds[k], markdown);
            if (!markdown) cell.resize(14, ' ');
            text += markdown ? " " + cell + " |" : cell;
        }
        while (text.back() == ' ') text.pop_back();
        text += "\n";
    }
    return text;
}

}  // namespace relievo

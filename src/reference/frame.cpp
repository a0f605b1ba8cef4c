#include "reference/cast.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "reference/area_light.h"
#include "reference/cell_walk.h"

#include <array>
#include <numbers>
#include <utility>

namespace relievo {

namespace {

// IEC 61966-2-1.
std::array<double, 256> make_srgb_table() {
    std::array<double, 256> table{};
    for (int i = 0; i < 256; ++i) {
        const double c = i / 255.0;
        table[static_cast<std::size_t>(i)] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return table;
}
const std::array<double, 256> linear_of_srgb = make_srgb_table();

double value_of(float texel) { return texel; }
double value_of(std::uint8_t texel) { return linear_of_srgb[texel]; }

// Bilinear between texel centres, repeated; each texel decoded before it is weighed.
template <class T>
Vec3d bilinear(const Image<T>& image, Vec2d uv) {
    const double x = uv.x * image.width - 0.5;
    const double y = uv.y * image.height - 0.5;
    const double fx = x - std::floor(x);
    const double fy = y - std::floor(y);
    const int i0 = wrap_index(static_cast<int>(std::floor(x)), image.width);
    const int j0 = wrap_index(static_cast<int>(std::floor(y)), image.height);
    const int i1 = i0 + 1 == image.width ? 0 : i0 + 1;
    const int j1 = j0 + 1 == image.height ? 0 : j0 + 1;
    const auto texel = [&](int i, int j) {
        const T* t = image.at(i, j);
        return Vec3d{value_of(t[0]), value_of(t[1]), value_of(t[2])};
    };
    return (texel(i0, j0) * (1 - fx) + texel(i1, j0) * fx) * (1 - fy) + (texel(i0, j1) * (1 - fx) + texel(i1, j1) * fx) * fy;
}

// `lod` is RayField's: of a map of one texel. Levels between two of the chain blend linearly.
template <class T>
Vec3d trilinear(const std::vector<Image<T>>& chain, Vec2d uv, double lod) {
    const double finest = std::log2(std::max(chain[0].width, chain[0].height));
    const double level = std::clamp(lod + finest, 0.0, static_cast<double>(chain.size() - 1));
    const auto fine = static_cast<std::size_t>(level);
    const double share = level - static_cast<double>(fine);
    const Vec3d a = bilinear(chain[fine], uv);
    return share > 0 ? a * (1 - share) + bilinear(chain[fine + 1], uv) * share : a;
}

struct Shaded {
    ReferenceHit hit;
    Vec3d normal;
    Vec3d colour;
    double key_visibility = 1;
    bool under_sheet = false;
};

class Shader {
public:
    Shader(const MapSet& maps, const Lighting& lighting, const ReferenceSettings& settings)
        : maps_(maps), lighting_(lighting), settings_(settings) {
        highest_ = *std::max_element(maps.height.texels.texels.begin(), maps.height.texels.texels.end());
    }

    Shaded operator()(const RayField& rays, int x, int y) const {
        const float* v = rays.view.at(x, y);
        const Vec3d view = normalize(Vec3d{v[0], v[1], v[2]});
        const Vec2d uv_per_height = Vec2d{view.x, view.y} * (settings_.height_scale / std::max(view.z, flattest_cosine));
        // Above the highest texel there is nothing to find.
        ReferenceRay ray{.uv = {rays.uv(x, y, 0), rays.uv(x, y, 1)},
                         .uv_per_height = uv_per_height,
                         .zero_level = settings_.zero_level,
                         .z_start = std::clamp(highest_, 0.0, 1.0)};
        if (settings_.chart > 0) {
            const Heights over = heights_over_chart(ray.uv, ray.uv_per_height);
            ray.z_start = std::min(ray.z_start, over.highest);
            ray.z_end = std::max(ray.z_end, over.lowest);
        }
        Shaded result{};
        if (ray.z_start >= ray.z_end) result.hit = reference_cast(maps_.height, ray);
        if (!result.hit.found) {
            result.colour = Vec3d(lighting_.background);
            return result;
        }
        const ReferenceHit& hit = result.hit;
        if (settings_.sheet >= 0 && hit.height < settings_.sheet) {
            // The sheet ends with the base, of which the ray's way to it may have left.
            const Vec2d at = ray.uv + ray.uv_per_height * (settings_.sheet - settings_.zero_level);
            const Vec2d edge = settings_.uv_at_origin * 2.0;
            result.under_sheet = at.x >= 0 && at.y >= 0 && at.x <= edge.x && at.y <= edge.y;
        }
        const double lod = rays.lod(x, y);
        const Vec3d albedo = trilinear(maps_.colour, hit.uv, lod);
        result.normal = normalize(trilinear(maps_.normal, hit.uv, lod));
        const Vec3d n = result.normal;

        const Vec3d world{hit.uv.x - settings_.uv_at_origin.x, hit.uv.y - settings_.uv_at_origin.y,
                          (hit.height - settings_.zero_level) * settings_.height_scale};
        result.colour = Vec3d(lighting_.ambient) * albedo;
        for (std::size_t k = 0; k < lighting_.lights.size(); ++k) {
            const Light& light = lighting_.lights[k];
            Vec3d l{light.position};
            double fading = 1;
            if (!light.directional) {
                l = l - world;
                const double d = length(l);
                fading = 1 / (light.constant + light.linear * d + light.quadratic * d * d);
            }
            l = normalize(l);
            double visibility = 1;
            if (k == 0 && settings_.shadow) {
                visibility = key_light_share(hit, l);
                result.key_visibility = visibility;
            }
            result.colour += Vec3d(light.colour) * reflected(albedo, hit, n, view, l, lod) * (visibility * fading);
        }
        if (result.under_sheet) result.colour = sheet_colour;
        return result;
    }

private:
    struct Heights {
        double lowest, highest;
    };
    // At which a line stands over the chart.
    Heights heights_over_chart(Vec2d uv, Vec2d uv_per_height) const {
        Heights all{-1e9, 1e9};
        for (const auto& [at, by] : {std::pair{uv.x, uv_per_height.x}, std::pair{uv.y, uv_per_height.y}}) {
            if (by == 0) {
                if (at < 0 || at > settings_.chart) all.lowest = 1e9;
                continue;
            }
            const double a = settings_.zero_level - at / by;
            const double b = settings_.zero_level + (settings_.chart - at) / by;
            all.lowest = std::max(all.lowest, std::min(a, b));
            all.highest = std::min(all.highest, std::max(a, b));
        }
        return all;
    }

    // Phong's terms for white light: Lambert's and the highlight's.
    struct Terms {
        double diffuse, highlight;
    };
    Terms phong(Vec3d n, Vec3d view, Vec3d l) const {
        const double n_l = dot(n, l);
        if (!(n_l > 0)) return {0, 0};
        return {n_l, lighting_.specular * std::pow(std::max(0.0, dot(n * (2 * n_l) - l, view)), static_cast<double>(lighting_.shininess))};
    }

    Vec3d reflected(Vec3d albedo, const ReferenceHit& hit, Vec3d n, Vec3d view, Vec3d l, double lod) const {
        Terms t{};
        switch (settings_.reflection) {
            case Reflection::phong: t = phong(n, view, l); break;
            case Reflection::blinn_phong: {
                const double n_l = dot(n, l);
                if (n_l > 0) t = {n_l, lighting_.specular * std::pow(std::max(0.0, dot(n, normalize(l + view))), 4.0 * lighting_.shininess)};
                break;
            }
            case Reflection::ggx: return ggx(albedo, n, view, l);
            case Reflection::flat: t = phong(facet_normal(hit.uv), view, l); break;
            case Reflection::gouraud: {
                const double cells = settings_.facets;
                const Vec2d p = hit.uv * cells;
                const Vec2d corner{std::floor(p.x), std::floor(p.y)};
                const Vec2d inside = p - corner;
                for (int k = 0; k < 4; ++k) {
                    const Vec2d place{static_cast<double>(k % 2), static_cast<double>(k / 2)};
                    const double share = (k % 2 == 1 ? inside.x : 1 - inside.x) * (k / 2 == 1 ? inside.y : 1 - inside.y);
                    const Terms vertex = phong(normalize(trilinear(maps_.normal, (corner + place) * (1 / cells), lod)), view, l);
                    t.diffuse += share * vertex.diffuse;
                    t.highlight += share * vertex.highlight;
                }
                break;
            }
        }
        return albedo * t.diffuse + Vec3d(t.highlight);
    }

    // Walter et al. 2007, eq. 33 for the normals; Heitz 2014, eq. 99 for the masking; Schlick 1994. With a factor pi, as the lights of
    // this program shine: a white Lambert surface that faces one is as bright as it.
    Vec3d ggx(Vec3d albedo, Vec3d n, Vec3d view, Vec3d l) const {
        const double n_l = dot(n, l);
        if (!(n_l > 0)) return {};
        const double n_v = std::max(dot(n, view), 1e-3);
        const Vec3d h = normalize(l + view);
        const double alpha = settings_.roughness * settings_.roughness;
        const double cos2 = std::min(1.0, dot(n, h) * dot(n, h));
        const double tan2 = (1 - cos2) / cos2;
        const double d = alpha * alpha / (std::numbers::pi * cos2 * cos2 * (alpha * alpha + tan2) * (alpha * alpha + tan2));
        const auto lambda = [&](double c) { return (std::sqrt(1 + alpha * alpha * (1 - c * c) / (c * c)) - 1) / 2; };
        const double masking = 1 / (1 + lambda(n_l) + lambda(n_v));
        const Vec3d head_on = Vec3d(0.04) * (1 - settings_.metallic) + albedo * settings_.metallic;
        const Vec3d fresnel = head_on + (Vec3d(1) - head_on) * std::pow(1 - std::clamp(dot(view, h), 0.0, 1.0), 5);
        const Vec3d specular = fresnel * (d * masking / (4 * n_l * n_v));
        const Vec3d diffuse = albedo * (Vec3d(1) - fresnel) * ((1 - settings_.metallic) / std::numbers::pi);
        return (diffuse + specular) * (std::numbers::pi * n_l);
    }

    Vec3d facet_normal(Vec2d uv) const {
        const double cells = settings_.facets;
        const Vec2d corner{std::floor(uv.x * cells) / cells, std::floor(uv.y * cells) / cells};
        const auto height = [&](double u, double v) { return maps_.height.sample(corner + Vec2d{u, v} * (1 / cells)); };
        const double h00 = height(0, 0), h10 = height(1, 0), h01 = height(0, 1), h11 = height(1, 1);
        const double slope = settings_.height_scale * cells / 2;
        return normalize(Vec3d{(h00 - h10 + h01 - h11) * slope, (h00 - h01 + h10 - h11) * slope, 1});
    }

    double key_light_share(const ReferenceHit& hit, Vec3d to_light) const {
        if (settings_.light_radius_rad > 0)
            return reference_light_share(maps_.height, hit, to_light, settings_.height_scale, settings_.light_radius_rad, 16,
                                         settings_.chart);
        double highest = 1;
        if (settings_.chart > 0) {
            const Vec2d per_height = Vec2d{to_light.x, to_light.y} * (settings_.height_scale / std::max(to_light.z, flattest_cosine));
            highest = std::min(1.0, heights_over_chart(hit.uv + per_height * (settings_.zero_level - hit.height), per_height).highest);
        }
        return reference_shadow(maps_.height, hit, to_light, settings_.height_scale, highest) ? 0 : 1;
    }

    const MapSet& maps_;
    const Lighting& lighting_;
    const ReferenceSettings& settings_;
    double highest_ = 1;
};

void store(ImageF& image, int x, int y, Vec3d v) {
    image(x, y, 0) = static_cast<float>(v.x);
    image(x, y, 1) = static_cast<float>(v.y);
    image(x, y, 2) = static_cast<float>(v.z);
}

}  // namespace

Frame reference_frame(std::span<const RayField> samples, const MapSet& maps, const Lighting& lighting,
                      const ReferenceSettings& settings, const Progress& progress) {
    assert(!samples.empty());
    const auto require = [](bool present, const char* map) {
        if (!present) throw Error("draw the reference of", "this material", std::string("it has no ") + map + " map", "bake or give one first");
    };
    require(!maps.height.empty(), "height");
    require(!maps.normal.empty(), "normal");
    require(!maps.colour.empty(), "colour");

    const int width = samples[0].width;
    const int height = samples[0].height;
    Frame frame(width, height);
    frame.source = "reference";
    const Shader shade(maps, lighting, settings);
    const auto rows = [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                Vec3d sum;
                for (std::size_t k = 0; k < samples.size(); ++k) {
                    assert(samples[k].width == width && samples[k].height == height);
                    const bool meets = samples[k].coverage(x, y) != static_cast<std::uint8_t>(Coverage::background);
                    if (!meets) {
                        sum += Vec3d(lighting.background);
                        continue;
                    }
                    const Shaded s = shade(samples[k], x, y);
                    sum += s.colour;
                    if (k > 0) continue;
                    if (!s.hit.found) {
                        frame.coverage(x, y) = static_cast<std::uint8_t>(Coverage::no_hit);
                        continue;
                    }
                    frame.coverage(x, y) = static_cast<std::uint8_t>(Coverage::hit);
                    frame.hit_uv(x, y, 0) = static_cast<float>(s.hit.uv.x);
                    frame.hit_uv(x, y, 1) = static_cast<float>(s.hit.uv.y);
                    frame.hit_height(x, y) = static_cast<float>(s.hit.height);
                    store(frame.normal, x, y, s.normal);
                    frame.shadow(x, y) = static_cast<float>(s.key_visibility);
                }
                store(frame.colour, x, y, sum * (1.0 / static_cast<double>(samples.size())));
            }
        }
    };
    // Few rows a block: grazing rows cost many times what steep ones do.
    parallel_for(height, 4, settings.threads, rows, progress, "reference");
    return frame;
}

}  // namespace relievo

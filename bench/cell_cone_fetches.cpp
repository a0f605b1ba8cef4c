// Fetches a ray of cell_cone_tracing beside pure cell cones (pure_cell_cones.h) and max_mip_tracing: the same rays over every height map
// found under a folder, resampled to one size, and over fields of our own; as a table in Markdown.
//
//   bench_cell_cone_fetches [--size 1024] [--degrees 30] [--rays 16000] [--out table.md] [FOLDER]
//
// Height maps are the files of the folder, or of its folders, whose name begins with `height`. A fetch is any read of a texture, a gather of
// four texels among them. Each pure cone's hit is compared with the reference, ours too: a hit more than half a texel from it counts as wrong,
// also one that only rounding explains (tests/techniques/exact_searches.cpp tells these apart).
#include "assets/atomic_file.h"
#include "assets/image_file.h"
#include "maps/map_kinds.h"
#include "maps/max_pyramid.h"
#include "pure_cell_cones.h"
#include "techniques/adversarial_fields.h"
#include "techniques/catalogue.h"

#include <atomic>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <random>
#include <set>

namespace {

using namespace relievo;
using namespace relievo::bench;

struct Weighed {
    int texel;
    double weight;
};

// What the texel `to` of `count` takes from a periodic row of `from` texels: all it covers where it is wider than they are, else the two
// about its middle.
std::vector<Weighed> taken(int to, int count, int from) {
    const double width = static_cast<double>(from) / count;
    std::vector<Weighed> all;
    if (width > 1) {
        const double begin = to * width;
        const double end = begin + width;
        for (int k = static_cast<int>(begin); k < end; ++k) all.push_back({k % from, (std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k))) / width});
    } else {
        const double middle = (to + 0.5) * width - 0.5;
        const double below = std::floor(middle);
        all.push_back({wrap_index(static_cast<int>(below), from), 1 - (middle - below)});
        all.push_back({wrap_index(static_cast<int>(below) + 1, from), middle - below});
    }
    return all;
}

HeightField resampled(const std::filesystem::path& file, int size) {
    const ImageF image = read_image(file);
    HeightField field(size, size);
    parallel_for(size, 16, 0, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            const auto rows = taken(j, size, image.height);
            for (int i = 0; i < size; ++i) {
                double sum = 0;
                for (const Weighed& x : taken(i, size, image.width))
                    for (const Weighed& y : rows) sum += x.weight * y.weight * image(x.texel, y.texel, 0);
                field.texels(i, j) = std::clamp(static_cast<float>(sum), 0.0f, 1.0f);
            }
        }
    });
    return field;
}

struct Counts {
    double ours = 0;
    double pyramid = 0;
    double pure = 0;          // leaps from the cell's wall
    double pure_drafted = 0;  // leaps from where the ray is
    long wrong = 0;
    long pure_wrong = 0;
    Counts& operator+=(const Counts& o) {
        ours += o.ours, pyramid += o.pyramid, pure += o.pure, pure_drafted += o.pure_drafted, wrong += o.wrong, pure_wrong += o.pure_wrong;
        return *this;
    }
    double ratio() const { return ours / std::min(pure, pyramid); }
};

Counts count(const HeightField& field, double degrees, int rays) {
    constexpr double height_scale = 0.1;
    const Technique& ours = *find_technique("cell_cone_tracing");
    const Technique& mipmaps = *find_technique("max_mip_tracing");
    MapSet maps;
    maps.height = field;
    const Progress silent;
    std::set<Map> needed(ours.maps.begin(), ours.maps.end());
    needed.insert(mipmaps.maps.begin(), mipmaps.maps.end());
    for (const Map map : needed)
        if (const auto bake = map_kind(map).bake) bake(maps, {.height_scale = height_scale, .threads = 0, .progress = silent});
    const PureCellCones cones = pure_cell_cones(field, maps.max_pyramid);

    constexpr int block = 500;
    std::vector<Counts> parts(static_cast<std::size_t>((rays + block - 1) / block));
    parallel_for(static_cast<int>(parts.size()), 1, 0, [&](int begin, int end) {
        for (int b = begin; b < end; ++b) {
            Counts& sum = parts[static_cast<std::size_t>(b)];
            std::mt19937_64 random(1000u + static_cast<unsigned>(b));
            std::uniform_real_distribution<double> uniform(0, 1);
            for (int k = b * block; k < std::min(rays, (b + 1) * block); ++k) {
                const double azimuth = uniform(random) * 2 * std::numbers::pi;
                const double elevation = degrees * std::numbers::pi / 180;
                glsl::SurfaceRay ray{};
                ray.view = {static_cast<float>(std::cos(elevation) * std::cos(azimuth)), static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
                            static_cast<float>(std::sin(elevation))};
                ray.height_scale = static_cast<float>(height_scale);
                ray.uv_per_height = Vec2f{ray.view.x, ray.view.y} * (ray.height_scale / ray.view.z);
                ray.zero_level = 1;
                ray.uv = {static_cast<float>(uniform(random)), static_cast<float>(uniform(random))};
                ray.z_start = 1;
                const ReferenceRay same{.uv = Vec2d(ray.uv), .uv_per_height = Vec2d(ray.uv_per_height)};
                const double truth = reference_cast(field, same).height;
                const double half_texel = 0.5 / (length(same.uv_per_height) * field.width());
                const auto fetches = [&](const Technique& t) {
                    glsl::bound_maps = declared_maps(t, maps);
                    glsl::fetch_count = 0;
                    const glsl::SurfaceHit hit = t.heightfield(ray, default_params(t));
                    sum.wrong += std::abs(static_cast<double>(hit.height) - truth) > half_texel;
                    return glsl::fetch_count;
                };
                sum.ours += fetches(ours);
                sum.pyramid += fetches(mipmaps);
                for (const bool from_wall : {false, true}) {
                    const PureHit hit = cast_pure(field, cones, same, from_wall);
                    (from_wall ? sum.pure : sum.pure_drafted) += hit.fetches;
                    sum.pure_wrong += std::abs(hit.height - truth) > half_texel;
                }
            }
        }
    });
    Counts all;
    for (const Counts& part : parts) all += part;
    all.ours /= rays, all.pyramid /= rays, all.pure /= rays, all.pure_drafted /= rays;
    return all;
}

std::vector<std::filesystem::path> height_files(const std::filesystem::path& folder) {
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().filename().string().starts_with("height")) files.insert(entry.path());
    return {files.begin(), files.end()};
}

struct Field {
    std::string name;
    std::function<HeightField()> make;
};

}  // namespace

int main(int argc, char** argv) {
    int size = 1024;
    double degrees = 30;
    int rays = 16000;
    std::string out;
    std::string folder;
    for (int k = 1; k < argc; ++k) {
        const auto value = [&] { return k + 1 < argc ? argv[++k] : ""; };
        if (std::strcmp(argv[k], "--size") == 0) size = std::atoi(value());
        else if (std::strcmp(argv[k], "--degrees") == 0) degrees = std::atof(value());
        else if (std::strcmp(argv[k], "--rays") == 0) rays = std::atoi(value());
        else if (std::strcmp(argv[k], "--out") == 0) out = value();
        else if (argv[k][0] == '-') size = 0;  // a word not known: say which are
        else folder = argv[k];
    }
    if (size < 2 || size > 8192 || !(degrees >= 1 && degrees < 90) || rays < 1) {
        std::fprintf(stderr, "bench_cell_cone_fetches [--size 2..8192] [--degrees 1..89] [--rays N] [--out table.md] [FOLDER]\n");
        return 2;
    }
    std::vector<Field> fields;
    if (!folder.empty()) {
        try {
            for (const auto& file : height_files(folder))
                fields.push_back({file.parent_path().filename().string(), [file, size] { return resampled(file, size); }});
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
            return 1;
        }
    }
    fields.push_back({"fBm", [size] { return adversarial::fbm(size, size, 1); }});
    fields.push_back({"cobbles (round stones)", [size] { return adversarial::cobble(size, size, 1); }});
    fields.push_back({"one-texel spikes", [size] { return adversarial::spikes(size, size, 1); }});

    std::string table = "| field | cell cone tracing | pure cones | pure cones, drafted leap | pyramid | over the better |\n|---|---|---|---|---|---|\n";
    double worst = 0;
    double logs = 0;
    long wrong = 0;
    long pure_wrong = 0;
    for (const Field& field : fields) {
        const Counts c = count(field.make(), degrees, rays);
        char row[256];
        std::snprintf(row, sizeof row, "| %s | %.2f | %.2f | %.2f | %.2f | %.3f |\n", field.name.c_str(), c.ours, c.pure, c.pure_drafted, c.pyramid, c.ratio());
        table += row;
        std::fputs(row, stdout);
        std::fflush(stdout);
        worst = std::max(worst, c.ratio());
        logs += std::log(c.ratio());
        wrong += c.wrong;
        pure_wrong += c.pure_wrong;
    }
    char last[256];
    std::snprintf(last, sizeof last, "\n%zu fields of %d^2, %d rays each at %g degrees: over the better at most %.3f, geometric mean %.3f; hits off by half a texel: %ld, of pure cones %ld.\n",
                  fields.size(), size, rays, degrees, worst, std::exp(logs / static_cast<double>(fields.size())), wrong, pure_wrong);
    table += last;
    std::fputs(last, stdout);
    if (!out.empty()) write_file_atomically(out, table);
    // Two searches each; one hit in 10^5 is left to rounding.
    return std::max(wrong, pure_wrong) * 100000 > 2L * rays * static_cast<long>(fields.size()) ? 1 : 0;
}

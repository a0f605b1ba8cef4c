#include "pipeline/compare.h"

#include "assets/atomic_file.h"
#include "assets/frame_file.h"
#include "assets/image_file.h"
#include "core/error.h"
#include "core/parallel_for.h"
#include "core/version.h"
#include "maps/map_kinds.h"
#include "measure/astray.h"
#include "measure/error_picture.h"
#include "measure/measure.h"
#include "measure/steepness.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/reference_picture.h"
#include "pipeline/write_report.h"
#include "reference/solids.h"
#include "report/pixels.h"
#include "techniques/catalogue.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <unistd.h>

namespace relievo {

namespace {

namespace fs = std::filesystem;

// One technique at one setting.
struct Contestant {
    const Technique* technique;
    MarchParams params;
};

std::string utc_now() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

// A name as a folder: what is not a plain letter or digit becomes '_', so that any material's pictures have portable paths.
std::string folder_name(const std::string& name) {
    std::string result = name;
    for (char& c : result)
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.')) c = '_';
    return result.empty() || result.front() == '.' ? "material" + result : result;
}

KnobValues knob_values(const Technique& technique, const MarchParams& params) {
    KnobValues values;
    for (const KnobDefault& k : technique.knobs) values.emplace_back(std::string(k.knob->id), k.knob->get(params));
    return values;
}

// The settings of a sweep, the cheapest first. A technique's first knob is its budget. An exact technique has none (its steps are a
// limit that it does not reach), and one without knobs is a single point. No setting comes twice where a knob's range ends or whole
// numbers round.
std::vector<Contestant> sweep_of(const std::vector<const Technique*>& list, Sweep sweep) {
    std::vector<float> factors;
    if (sweep == Sweep::small) factors = {0.5f, 2.0f};
    if (sweep == Sweep::full) factors = {0.125f, 0.25f, 0.5f, 2.0f, 4.0f, 8.0f};
    std::vector<Contestant> settings;
    std::set<std::pair<const Technique*, float>> taken;
    for (const float factor : factors) {
        for (const Technique* technique : list) {
            if (technique->exact || technique->knobs.count == 0) continue;
            const KnobDefault& budget = *technique->knobs.begin();
            MarchParams params = default_params(*technique);
            taken.insert({technique, budget.knob->get(params)});
            budget.knob->set(params, budget.value * factor);
            if (taken.insert({technique, budget.knob->get(params)}).second) settings.push_back({technique, params});
        }
    }
    return settings;
}

// Frames that are held at once: what is timed together is interleaved, and so compares fairly on a busy machine; but a sweep of large
// pictures must not fill the memory. Half a gibibyte holds all settings of twenty techniques at the default size.
std::size_t most_frames(int width, int height) {
    constexpr std::size_t bytes_per_pixel = 48;  // the planes of a Frame
    return (std::size_t{1} << 29) / (bytes_per_pixel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) + 1;
}

TimeSpread spread(std::vector<double> ms) {
    std::ranges::sort(ms);
    const std::size_t n = ms.size();
    const double median = n % 2 == 1 ? ms[n / 2] : (ms[n / 2 - 1] + ms[n / 2]) / 2;
    return {ms.front(), median, ms.back(), static_cast<int>(n)};
}

// One line of progress over the whole comparison. Every long step reports into its part of it, so that an interruption is heard
// within a moment wherever it comes.
class Line {
public:
    Line(const Progress& progress, std::string stage, double total) : progress_(progress), stage_(std::move(stage)), total_(total) {}

    // The Progress of a step worth `units` of the total, which begins where the one before it ended.
    Progress step(double units) {
        begin_ = end_;
        end_ = begin_ + units;
        return [this, begin = begin_, units](std::string_view, double share) { show(begin + units * share); };
    }

private:
    // Steps with several passes begin again at 0; the line never goes back.
    void show(double done) {
        shown_ = std::max(shown_, std::min(done / total_, 1.0));
        report(progress_, stage_, shown_);
    }

    const Progress& progress_;
    std::string stage_;
    double total_;
    double begin_ = 0;
    double end_ = 0;
    double shown_ = 0;
};

// What the steps of a comparison cost beside each other, roughly: seconds of twelve techniques on one view at 512 x 288. Only the
// time left that the progress shows depends on it.
constexpr double baking_units = 1;
constexpr double reference_units = 1;
constexpr double solids_units = 0.5;
constexpr double drawing_units = 3;
constexpr double measuring_units = 1;
constexpr double writing_units = 0.5;
constexpr double view_units = reference_units + solids_units + drawing_units + measuring_units + writing_units;

// Why no promise can be judged under these options; empty where one can. They hold of the ray as it is, searched at its own knobs.
std::string unpromised(const DrawOptions& options) {
    const DrawOptions usual;
    for (const auto choice : {&glsl::DrawModes::steps, &glsl::DrawModes::scale, &glsl::DrawModes::border, &glsl::DrawModes::fade})
        if (options.*choice != usual.*choice) return "the search was changed by " + described(options);
    return {};
}

// Pictures under way. They move to their places together at the end, so that an interrupted run leaves an older report whole.
class PictureFolder {
public:
    explicit PictureFolder(const fs::path& out) : target_(out), staging_(out / (".relievo-" + std::to_string(::getpid()) + "-pictures.tmp")) {
        std::error_code ignored;
        made_target_ = !fs::exists(out, ignored);
        make_folder(out);
        // Tried at the beginning: an unwritable place is known before the work.
        for (const char* file : {"results.json", "results.csv", "index.html"}) const AtomicFile probe(out / file);
        made_pictures_ = !fs::exists(out / "pictures", ignored);
        make_folder(out / "pictures");
        make_folder(staging_);
    }
    ~PictureFolder() {
        std::error_code ignored;
        fs::remove_all(staging_, ignored);
        // Nothing was published: no empty folders either. remove() takes only those.
        if (made_pictures_) fs::remove(target_ / "pictures", ignored);
        if (made_target_) fs::remove(target_, ignored);
    }
    PictureFolder(const PictureFolder&) = delete;
    PictureFolder& operator=(const PictureFolder&) = delete;

    const fs::path& staging() const { return staging_; }

    void publish() const {
        for (const auto& entry : fs::recursive_directory_iterator(staging_)) {
            const fs::path place = target_ / fs::relative(entry.path(), staging_);
            if (entry.is_directory()) {
                make_folder(place);
                continue;
            }
            std::error_code error;
            fs::rename(entry.path(), place, error);
            if (error) throw Error("write", place.string(), error.message());
        }
    }

    static void make_folder(const fs::path& folder) {
        std::error_code error;
        fs::create_directories(folder, error);
        std::error_code ignored;
        if (!fs::is_directory(folder, ignored)) throw Error("make folder", folder.string(), error ? error.message() : "a file of that name is in the way");
    }

private:
    fs::path target_;
    fs::path staging_;
    bool made_target_ = false;
    bool made_pictures_ = false;
};

class Comparison {
public:
    Comparison(const CompareSettings& settings, const Progress& progress)
        : settings_(settings), techniques_(settings.techniques), views_(settings.views), progress_(progress),
          gpu_(settings.device, settings.validation),
          machine_(BakeMachine::automatic(settings.device)) {
        if (techniques_.empty())
            for (const Technique& t : techniques()) techniques_.push_back(&t);
        if (views_.empty()) views_.assign(views().begin(), views().end());
        picture_.offsets = sample_offsets(settings.samples);
        picture_.width = settings.width;
        picture_.height = settings.height;
        picture_.options = settings.options;
    }

    Results run() {
        const auto began = std::chrono::steady_clock::now();
        for (const MaterialSource& source : settings_.materials) check_source(source);  // the last one's slip is known before the first one's work
        const fs::path out = settings_.out;
        const PictureFolder pictures(out);

        Results results;
        results.manifest = {.command = settings_.command,
                            .version = std::string(version),
                            .date = utc_now(),
                            .device = gpu_.device_name(),
                            .driver = gpu_.driver(),
                            .width = settings_.width,
                            .height = settings_.height,
                            .runs = settings_.runs,
                            .samples_per_pixel = settings_.samples,
                            .shadow = std::string(find_modifier("shadow")->value(settings_.options).id),
                            .modifiers = described(settings_.options),
                            .threads = settings_.threads > 0 ? settings_.threads : default_threads(),
                            .seconds = 0,
                            .docs = {},
                            .materials = {}};
        results.error_legend = hit_error_legend();
        results.fetches_legend = fetches_legend();
        for (const MapKind& m : map_kinds()) results.maps.push_back({m.map, std::string(m.id), std::string(m.title), std::string(m.summary)});

        const auto count = [](std::size_t n, const char* word) { return std::to_string(n) + " " + word + (n == 1 ? "" : "s"); };
        Line line(progress_, "comparing " + count(techniques_.size(), "technique") + " on " + count(settings_.materials.size(), "material"),
                  static_cast<double>(settings_.materials.size()) *
                      (baking_units + static_cast<double>(views_.size()) * view_units +
                       static_cast<double>(settings_.sweep == Sweep::full ? views_.size() : 1) * sweep_units(sweep_of(techniques_, settings_.sweep).size())));
        for (const MaterialSource& source : settings_.materials) compare_material(source, pictures.staging(), results, line);

        results.manifest.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        const std::string json = results_json(results);
        pictures.publish();
        write_report(out, results);
        write_file_atomically(out / "results.json", json);
        if (const auto messages = gpu_.validation_messages(); !messages.empty())
            throw Error("trust", "the Vulkan calls of this run", "the validation layers said: " + messages.front());
        return results;
    }

private:
    // `wanted`, or with a number where it is taken: two folders may have one name, and two names one folder.
    static std::string unique(const std::string& wanted, std::set<std::string>& taken) {
        std::string name = wanted;
        for (int copy = 2; !taken.insert(name).second; ++copy) name = wanted + "-" + std::to_string(copy);
        return name;
    }

    // Of so many settings beside the defaults.
    double sweep_units(std::size_t settings) const { return static_cast<double>(settings) / static_cast<double>(techniques_.size()) * (drawing_units + measuring_units); }

    void compare_material(const MaterialSource& source, const fs::path& out, Results& results, Line& line) {
        const Progress baking = line.step(baking_units);
        report(baking, "loading", 0);
        Material material = load_source(source);
        report(baking, "loading", 0);
        const std::string name = unique(material.name, names_);
        const std::string folder = unique(folder_name(material.name), folders_);

        BakedMaps baked = bake_maps(std::move(material), maps_to_draw(techniques_, std::span(&settings_.options, 1)),
                                    {.threads = settings_.threads, .use_cache = settings_.use_cache, .progress = baking, .machine = &machine_});
        results.manifest.materials.push_back({.name = name,
                                              .width = baked.maps.height.width(),
                                              .height = baked.maps.height.height(),
                                              .height_scale = baked.height_scale,
                                              .zero_level = baked.zero_level,
                                              .physical_size_m = baked.physical_size_m,
                                              .notes = baked.notes,
                                              .input_hash = baked.input_hash});
        const auto uploaded = gpu_.upload(baked.maps, baked.height_scale, baked.zero_level);
        report(baking, "uploading", 1);
        PictureFolder::make_folder(out / "pictures" / folder);
        for (const View& view : views_) compare_view(view, {name, folder}, baked, *uploaded, out, results, line);
    }

    struct Place {
        std::string name;    // the material's, as people know it
        std::string folder;  // of its pictures
    };

    void compare_view(const View& view, const Place& place, const BakedMaps& baked, const GpuMaterial& material, const fs::path& out,
                      Results& results, Line& line) {
        const Stage stage = stage_for(view);
        std::vector<RayField> rays;
        for (const Vec2f offset : picture_.offsets) rays.push_back(gpu_.rays(stage, material, settings_.width, settings_.height, offset));
        const Frame truth = reference_picture(stage, baked.maps, rays,
                                              {.height_scale = baked.height_scale,
                                               .zero_level = baked.zero_level,
                                               .options = settings_.options,
                                               .threads = settings_.threads},
                                              line.step(reference_units));
        const std::string no_promise = unpromised(settings_.options);
        const Progress following = line.step(solids_units);
        RaySolids solids;
        if (no_promise.empty())
            solids = reference_solids(rays.front(), baked.maps.height,
                                      {.height_scale = baked.height_scale, .zero_level = baked.zero_level, .threads = settings_.threads}, following);
        const double exposure = wall_exposure(rms_slope(baked.maps.height, static_cast<double>(baked.height_scale)), view.elevation_deg);
        const std::string prefix = "pictures/" + place.folder + "/" + folder_name(view.id) + "-";
        const std::string reference_path = prefix + "reference.png";

        const std::string reference_pixels = prefix + "reference-pixels.js";
        const PixelSettings pixels{baked.maps.height.width(), baked.maps.height.height()};

        std::vector<Contestant> contestants;
        for (const Technique* t : techniques_) contestants.push_back({t, default_params(*t)});
        // A small sweep is made in the first view only: one view shows how error falls with cost.
        if (settings_.sweep == Sweep::full || &view == &views_.front())
            for (const Contestant& c : sweep_of(techniques_, settings_.sweep)) contestants.push_back(c);
        const auto drawn = [&](std::span<const Contestant> group) {
            std::vector<GpuRenderer::Timed> timed;
            for (const Contestant& c : group) timed.push_back({c.technique, c.params, settings_.options});
            return gpu_.draw_timed(stage, material, timed, picture_, settings_.runs, line.step(drawing_units * static_cast<double>(group.size()) / static_cast<double>(techniques_.size())));
        };
        const auto measuring_of = [&](std::size_t count) { return line.step(measuring_units * static_cast<double>(count) / static_cast<double>(techniques_.size())); };
        const auto judged = [&](const Contestant& c, const Frame& frame) {
            Row row{.technique = std::string(c.technique->id),
                    .material = place.name,
                    .view = view.id,
                    .elevation_deg = view.elevation_deg,
                    .knobs = knob_values(*c.technique, c.params),
                    .m = measure(frame, truth, rays.front(),
                                 {.texels_x = baked.maps.height.width(), .texels_y = baked.maps.height.height(), .threads = settings_.threads})};
            row.m.gpu_ms = spread(frame.gpu_ms);
            if (!no_promise.empty()) {
                row.m.astray = row.m.astray_budget = Measured<double>::missing(no_promise);
            } else {
                row.m.astray = astray_share(frame, rays.front(), solids,
                                            {.texels = {baked.maps.height.width(), baked.maps.height.height()},
                                             .height_scale = static_cast<double>(baked.height_scale),
                                             .zero_level = static_cast<double>(baked.zero_level),
                                             .promise = [&c](double view_z) { return promise_of(*c.technique, c.params, static_cast<float>(view_z)); },
                                             .threads = settings_.threads});
                row.m.astray_budget = astray_budget(*c.technique, exposure);
            }
            return row;
        };
        const auto judge_sweep = [&](const Contestant& c, const Frame& frame) {
            results.sweep.push_back(judged(c, frame));
            results.sweep.back().no_picture = "a point of the budget sweep, measured but not kept as a picture";
        };
        // The defaults, whose pictures are kept, with as many of the others as there is room for.
        const std::span<const Contestant> all = contestants;
        const std::size_t most = std::max(techniques_.size(), most_frames(settings_.width, settings_.height));
        const std::span<const Contestant> first = all.first(std::min(most, all.size()));
        const std::vector<Frame> frames = drawn(first);

        // Pictures are encoded together at the end, on all cores.
        std::vector<std::function<void()>> writes;
        writes.push_back([&] { write_frame_png(out / reference_path, truth.colour); });
        writes.push_back([&] { write_file_atomically(out / reference_pixels, reference_pixel_script(truth)); });
        const Progress measuring = measuring_of(first.size());
        for (std::size_t i = 0; i < first.size(); ++i) {
            report(measuring, "measuring", static_cast<double>(i) / static_cast<double>(first.size()));
            if (i >= techniques_.size()) {
                judge_sweep(first[i], frames[i]);
                continue;
            }
            const Frame* frame = &frames[i];
            Row row = judged(first[i], *frame);
            row.image = prefix + row.technique + ".png";
            row.error_image = prefix + row.technique + "-error.png";
            row.fetches_image = prefix + row.technique + "-fetches.png";
            row.reference_image = reference_path;
            row.pixels = prefix + row.technique + "-pixels.js";
            row.reference_pixels = reference_pixels;
            row.where = where_it_is_wrong(*frame, truth, rays.front(), pixels);
            writes.push_back([frame, file = out / row.image] { write_frame_png(file, frame->colour); });
            writes.push_back([frame, &truth, &rays, &baked, file = out / row.error_image] {
                const Vec2i texels{baked.maps.height.width(), baked.maps.height.height()};
                write_png(file, hit_error_picture(hit_error_texels(*frame, truth, rays.front(), texels, 1), 1), FirstRow::top);
            });
            writes.push_back([frame, &truth, &rays, pixels, file = out / row.pixels] {
                write_file_atomically(file, pixel_script(*frame, truth, rays.front(), pixels));
            });
            writes.push_back([frame, file = out / row.fetches_image] { write_png(file, fetches_picture(*frame, 1), FirstRow::top); });
            results.rows.push_back(std::move(row));
        }
        for (std::size_t done = first.size(); done < all.size();) {
            const std::span<const Contestant> group = all.subspan(done, std::min(most, all.size() - done));
            const std::vector<Frame> swept = drawn(group);
            const Progress judging = measuring_of(group.size());
            for (std::size_t i = 0; i < group.size(); ++i) {
                report(judging, "measuring", static_cast<double>(i) / static_cast<double>(group.size()));
                judge_sweep(group[i], swept[i]);
            }
            done += group.size();
        }
        const auto write = [&](int begin, int end) {
            for (int i = begin; i < end; ++i) writes[static_cast<std::size_t>(i)]();
        };
        parallel_for(static_cast<int>(writes.size()), 1, settings_.threads, write, line.step(writing_units), "writing");
    }

    const CompareSettings& settings_;
    std::vector<const Technique*> techniques_;
    std::vector<View> views_;
    const Progress& progress_;
    GpuRenderer gpu_;
    BakeMachine machine_;
    PictureSettings picture_;
    std::set<std::string> names_;
    std::set<std::string> folders_;
};

}  // namespace

std::vector<Vec2f> sample_offsets(int samples) {
    if (samples == 5) return {{0, 0}, {-0.375f, -0.125f}, {0.125f, -0.375f}, {0.375f, 0.125f}, {-0.125f, 0.375f}};
    const int n = static_cast<int>(std::lround(std::sqrt(samples)));
    assert(n * n == samples && n % 2 == 1);
    std::vector<Vec2f> offsets;
    const auto place = [n](int i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(n) - 0.5f; };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) offsets.push_back({place(x), place(y)});
    std::swap(offsets.front(), offsets[offsets.size() / 2]);
    return offsets;
}

Results compare(const CompareSettings& settings, const Progress& progress) { return Comparison(settings, progress).run(); }

}  // namespace relievo

#include "report/fur_replication.h"

#include "core/error.h"
#include "report/escaped.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

constexpr PublishedFur published[] = {
    {"cube", 12, 205, 181, 128, 108},      {"torus", 384, 189, 178, 115, 110},         {"bunny", 16301, 133, 126, 78, 74},
    {"dragon", 202520, 43, 42, 23, 23},    {"armadillo", 83026, 90, 76, 50, 47},       {"buddha", 293232, 37, 37, 20, 20},
};

double rounded(double v, double unit) { return std::round(v / unit) * unit; }

std::string fixed(double v, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, v);
    return text;
}

std::string fps(double ms) { return ms > 0 ? fixed(1000 / ms, 1000 / ms < 10 ? 1 : 0) : "-"; }

const FurTrial* trial_of(const FurUnit& unit, std::string_view mode, int layers) {
    for (const FurTrial& t : unit.trials)
        if (t.mode == mode && t.layers == layers && !t.chosen) return &t;
    return nullptr;
}

using Cells = std::vector<std::vector<std::string>>;
std::string table_of(const Cells& rows, bool markdown) {
    std::vector<std::size_t> width(rows[0].size(), 0);
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
    std::string text;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        std::string line = markdown ? "|" : "";
        for (std::size_t c = 0; c < rows[r].size(); ++c) {
            const std::string pad(width[c] - rows[r][c].size(), ' ');
            line += markdown ? " " + rows[r][c] + " |" : (c == 0 ? rows[r][c] + pad : pad + rows[r][c]) + "  ";
        }
        while (line.back() == ' ') line.pop_back();
        text += line + "\n";
        if (markdown && r == 0) {
            text += "|---|";
            for (std::size_t c = 1; c < rows[0].size(); ++c) text += "---:|";
            text += "\n";
        }
    }
    return text;
}

// The modes that strands are compared with, in the order of their first trial.
std::vector<std::string> rivals_of(const FurReplication& r) {
    std::vector<std::string> rivals;
    for (const FurUnit& u : r.units)
        for (const FurTrial& t : u.trials)
            if (t.mode != "strands" && std::ranges::find(rivals, t.mode) == rivals.end()) rivals.push_back(t.mode);
    return rivals;
}

Cells frame_rates(const FurReplication& r) {
    Cells rows{{"mesh", "faces", "published faces", "layers", "height", "density", "published fps", "classic fps", "strands fps", "classic FLIP", "strands FLIP", "classic coverage", "strands coverage"}};
    for (const FurUnit& u : r.units)
        for (const int layers : published_fur_layers) {
            const FurTrial *classic = trial_of(u, "classic", layers), *strands = trial_of(u, "strands", layers);
            if (classic == nullptr || strands == nullptr) continue;
            const auto there = published_fur_fps(u.mesh, layers, u.height_percent);
            rows.push_back({u.mesh, std::to_string(u.faces), std::to_string(u.published_faces), std::to_string(layers), fixed(u.height_percent, 0) + " %", fixed(u.density_percent, 0) + " %",
                            there ? fixed(*there, 0) : "-", fps(classic->ms), fps(strands->ms), fixed(classic->frame_flip, 3), fixed(strands->frame_flip, 3), fixed(classic->coverage_error, 3),
                            fixed(strands->coverage_error, 3)});
        }
    return rows;
}

Cells verdicts(const FurReplication& r, const std::string& rival) {
    Cells rows{{"mesh", "height", "density", "layers", "FLIP", "ms", "strands as good: layers", "FLIP", "ms", "times as fast", "strands as quick: layers", "FLIP", "ms"}};
    for (const FurUnit& u : r.units)
        for (const int layers : {16, 32}) {
            const FurVerdict v = fur_verdict(u, rival, layers);
            if (v.layers == nullptr) continue;
            const auto of = [](const FurTrial* t, int what) {
                if (t == nullptr) return std::string("none");
                return what == 0 ? std::to_string(t->layers) + (t->chosen ? " (own)" : "") : what == 1 ? fixed(t->frame_flip, 3) : fixed(t->ms, 0);
            };
            rows.push_back({u.mesh, fixed(u.height_percent, 0) + " %", fixed(u.density_percent, 0) + " %", std::to_string(layers), fixed(v.layers->frame_flip, 3), fixed(v.layers->ms, 0), of(v.as_good, 0),
                            of(v.as_good, 1), of(v.as_good, 2), v.as_good ? fixed(v.speedup(), 2) : "-", of(v.as_quick, 0), of(v.as_quick, 1), of(v.as_quick, 2)});
        }
    return rows;
}

std::string summary(const FurReplication& r, const std::string& rival) {
    std::string text;
    for (const int layers : {16, 32}) {
        int all = 0, faster = 0, better = 0;
        double log_speedup = 0;
        int with = 0;
        for (const FurUnit& u : r.units) {
            const FurVerdict v = fur_verdict(u, rival, layers);
            if (v.layers == nullptr) continue;
            ++all;
            faster += v.faster();
            better += v.better();
            if (v.as_good != nullptr) {
                log_speedup += std::log(v.speedup());
                ++with;
            }
        }
        if (all == 0) continue;
        text += "Beside " + std::to_string(layers) + " uniform layers (" + rival + "): at no higher FLIP strands are faster in " + std::to_string(faster) + " of " + std::to_string(all) +
                (with > 0 ? ", by " + fixed(std::exp(log_speedup / with), 2) + " times in the geometric mean of the " + std::to_string(with) + " where they are as good" : std::string()) +
                "; at no longer time their FLIP is lower in " + std::to_string(better) + " of " + std::to_string(all) + ".\n";
    }
    return text;
}

}  // namespace

std::span<const PublishedFur> published_fur() { return published; }

std::optional<double> published_fur_fps(std::string_view mesh, int layers, double height_percent) {
    for (const PublishedFur& p : published)
        if (p.mesh == mesh) {
            if (layers == 8) return height_percent < 3 ? p.fps_8_layers_2_percent : p.fps_8_layers_5_percent;
            if (layers == 16) return height_percent < 3 ? p.fps_16_layers_2_percent : p.fps_16_layers_5_percent;
        }
    return std::nullopt;
}

FurVerdict fur_verdict(const FurUnit& unit, std::string_view rival, int layers) {
    FurVerdict v{.layers = trial_of(unit, rival, layers)};
    if (v.layers == nullptr) return v;
    for (const FurTrial& t : unit.trials) {
        if (t.mode != "strands") continue;
        if (t.frame_flip <= v.layers->frame_flip && (v.as_good == nullptr || t.ms < v.as_good->ms)) v.as_good = &t;
        if (t.ms <= v.layers->ms && (v.as_quick == nullptr || t.frame_flip < v.as_quick->frame_flip)) v.as_quick = &t;
    }
    return v;
}

std::string fur_replication_json(const FurReplication& r) {
    Json json{{"published", "Evangelista 2009, tables 7.6 and 7.7"}, {"device", r.device}, {"width", r.width}, {"height", r.height}, {"passes", r.passes}, {"samples", r.samples},
              {"stand_ins", r.stand_ins}, {"units", Json::array()}};
    for (const FurUnit& u : r.units) {
        Json unit{{"mesh", u.mesh}, {"from", u.from}, {"faces", u.faces}, {"published_faces", u.published_faces}, {"height_percent", u.height_percent}, {"density_percent", u.density_percent},
                  {"strands", u.strands}, {"trials", Json::array()}};
        for (const FurTrial& t : u.trials) {
            const auto there = t.mode == "classic" ? published_fur_fps(u.mesh, t.layers, u.height_percent) : std::nullopt;
            unit["trials"].push_back({{"mode", t.mode}, {"layers", t.layers}, {"own_layers", t.chosen}, {"ms", rounded(t.ms, 1e-3)}, {"published_fps", there ? Json(*there) : Json(nullptr)},
                                      {"frame_flip", rounded(t.frame_flip, 1e-5)}, {"flip", rounded(t.flip, 1e-5)}, {"coverage_error", rounded(t.coverage_error, 1e-5)}, {"gaps", rounded(t.gaps, 1e-5)}});
        }
        json["units"].push_back(std::move(unit));
    }
    return json.dump(1) + "\n";
}

FurReplication fur_replication_from(const std::string& text, const std::string& file) {
    try {
        const Json json = Json::parse(text);
        FurReplication r{.device = json.at("device"), .width = json.at("width"), .height = json.at("height"), .passes = json.at("passes"), .samples = json.at("samples"),
                         .stand_ins = json.at("stand_ins"), .units = {}};
        for (const Json& u : json.at("units")) {
            FurUnit unit{.mesh = u.at("mesh"), .from = u.at("from"), .faces = u.at("faces"), .published_faces = u.at("published_faces"), .height_percent = u.at("height_percent"),
                         .density_percent = u.at("density_percent"), .strands = u.at("strands"), .trials = {}};
            for (const Json& t : u.at("trials"))
                unit.trials.push_back({.mode = t.at("mode"), .layers = t.at("layers"), .chosen = t.at("own_layers"), .ms = t.at("ms"), .frame_flip = t.at("frame_flip"), .flip = t.at("flip"),
                                       .coverage_error = t.at("coverage_error"), .gaps = t.at("gaps")});
            r.units.push_back(std::move(unit));
        }
        return r;
    } catch (const nlohmann::json::exception& e) {
        throw Error("go on from", file, e.what(), "remove it to begin anew");
    }
}

std::string fur_replication_csv(const FurReplication& r) {
    std::string text = "mesh,from,faces,published_faces,height_percent,density_percent,strands,mode,layers,own_layers,ms,published_fps,frame_flip,flip,coverage_error,gaps\n";
    for (const FurUnit& u : r.units)
        for (const FurTrial& t : u.trials) {
            const auto there = t.mode == "classic" ? published_fur_fps(u.mesh, t.layers, u.height_percent) : std::nullopt;
            text += u.mesh + "," + csv_text(u.from) + "," + std::to_string(u.faces) + "," + std::to_string(u.published_faces) + "," + fixed(u.height_percent, 0) + "," + fixed(u.density_percent, 0) + "," +
                    std::to_string(u.strands) + "," + t.mode + "," + std::to_string(t.layers) + "," + (t.chosen ? "1" : "0") + "," + fixed(t.ms, 3) + "," + (there ? fixed(*there, 0) : "") + "," +
                    fixed(t.frame_flip, 5) + "," + fixed(t.flip, 5) + "," + fixed(t.coverage_error, 5) + "," + fixed(t.gaps, 5) + "\n";
        }
    return text;
}

std::string fur_replication_text(const FurReplication& r, bool markdown) {
    if (r.units.empty()) return "nothing has been measured yet\n";
    const std::string title = markdown ? "## " : "";
    std::string text = title + "The eight configurations\n\n" + table_of(frame_rates(r), markdown) + "\n";
    for (const std::string& rival : rivals_of(r))
        text += title + "At equal error and at equal time: strands beside " + rival + "\n\n" + summary(r, rival) + "\n" + table_of(verdicts(r, rival), markdown) + "\n";
    return text;
}

std::string fur_replication_page(const FurReplication& r, const std::string& command) {
    return "# Fur of 2009, run again\n\n"
           "B. Evangelista (*Renderização em tempo real de pelos aplicados sobre malhas tridimensionais arbitrárias obtidas de objetos reais*, UFMG 2009)\n"
           "drew six meshes in eight configurations: 8 or 16 layers, fur 2 or 5 % of the radius of the smallest sphere high, strands on 10 or 20 % of the texels of\n"
           "cube maps of 256 x 256. His frame rates (table 7.7) are those of a GeForce 8600GT at 1280 x 800; his pictures were judged by eye. Here the same configurations\n"
           "run with [his method](concepts/fur_classic.md) and with [strands in object space](concepts/fur.md), and both are measured.\n\n"
           "**The reference** is what his maps stand for, as curves: as many strands as the map has, evenly over the surface, upright, of the height asked for and\n"
           "so thick that they fill the share of the skin that the density says (widened by a fifth for the pointed tips that our strands have and his have not).\n"
           "They are ray traced with shadows on the mesh itself. The same strands, root by root, are what mode strands draws; mode classic has its own, where its map\n"
           "puts them, as no even ones can be had of it. Light is not the map's fault: the ambient, diffuse and specular parts of the classic layers are fitted to\n"
           "each reference by least squares, which is the most that three numbers can do, while strands keep their light as it is. Both draw at one sample a pixel;\n"
           "Classic layers are drawn on the scan's own faces, as in the thesis, lapped ones on a simplified mesh; strands are plotted one by one, and of the mesh only the skin is\n"
           "drawn: on scans most of the difference in speed lies there, on the cube and the torus none of it. What stands under *layers* for strands is the number of\n"
           "straight pieces of each.\n"
           "FLIP is that of one frame, and coverage is the mean difference of coverage, after averaging, where either picture has any, which no light touches.\n\n"
           "**Meshes**: of each object the nearest of at least as many faces as published, simplified to that many, or the largest there is. " +
           std::string(r.stand_ins ? "No folder of meshes was given: made-up scans of the published sizes stand in for the four scans.\n\n" : "\n\n") +
           "<!-- measured -->\nMade by `" + command + "` on " + r.device + ", " + std::to_string(r.width) + " x " + std::to_string(r.height) + ", medians of interleaved frames, reference of " +
           std::to_string(r.samples) + (r.samples == 1 ? " ray a pixel.\n\n" : " rays a pixel.\n\n") + fur_replication_text(r, true) + "<!-- /measured -->\n";
}

}  // namespace relievo

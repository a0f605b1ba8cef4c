#include "pipeline/replicate.h"

#include "report/technique_text.h"

#include <algorithm>
#include <cstdio>

namespace relievo {

namespace {

// Why a technique does not stand where the published ranking has it; what the numbers show, not what the eye said.
struct Reason {
    std::string_view technique;
    std::string_view reason;
};
constexpr Reason reasons[] = {
    {"cone_step_mapping",
     "with the published 10 to 20 steps it is among the cheapest searches of the comparison, as it was then, but it does not arrive: the walk ends in the air before "
     "the surface (all of its wrong pixels in test 4 are early), and cones blended between texels let it into edges (those of tests 6 to 8 are mostly late). Off "
     "by a texel or two it still looks sharp, which is what the eye judged; measured, one pixel in ten is wrong."},
    {"parallax_occlusion_mapping",
     "as right as relief mapping wherever it is given 30 steps and more; test 6 allows it as few as 10 in a middle view, and there it steps over grooves. That test, "
     "and its longer marches, put it behind relief mapping, with which it was tied."},
    {"relief_mapping",
     "bisection leaves nothing of a step's error, so only what the linear search stepped over is wrong, less than one pixel in a hundred; no technique of the eight "
     "is more often right, and its 15 to 40 steps cost no more than the others'."},
    {"parallax_iterative",
     "it settles on a crossing that need not be the first, and where the relief is steep it does not settle: a tenth to four tenths of its pixels are wrong, most of "
     "them early. It cannot hide what lies behind a wall, which a still picture hardly shows. It was fast then; two reads an iteration, one of them of a filtered "
     "normal, make it the dearest of all on a device without texture units."},
    {"linear_search",
     "the same place for another reason. Then it was right but slow; here its cost is that of the other searches, but every hit is late by up to a step, which is more than "
     "half a texel as soon as the map has 1024 texels or the view is not steep (a third of the pixels in test 6). Its 99th percentile stays below two texels there: "
     "terraces, not tears."},
    {"parallax_offset_limiting",
     "its shift is too short at any but steep views, so fewer of its pixels fall within half a texel than plain parallax mapping's. Judged by how far off the worst pixels are, it "
     "is the better one at grazing views (tests 7 and 8: less than half of plain parallax's 99th percentile), and that is what was seen: nothing tears."},
    {"parallax_mapping",
     "the reverse: more pixels nearly right, the others torn away by tens of texels at grazing views. Its place is the published one only because the offset-limited "
     "shift has fallen behind it."},
    {"normal_mapping", "it shows no relief, and every hit that is not on the polygon is wrong: last in both."},
};

std::string padded(std::string text, std::size_t width, bool right = false) {
    // Columns count letters, not bytes.
    const auto letters = static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
    if (letters >= width) return text;
    return right ? std::string(width - letters, ' ') + text : text + std::string(width - letters, ' ');
}

std::string fixed(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string share(double value) { return value == 0 ? "0" : short_number(100 * value) + " %"; }

std::string knobs_of(const ReplicatedRun& run) {
    std::string text;
    for (const KnobDefault& k : run.technique->knobs) {
        if (run.published != nullptr && !std::ranges::any_of(run.published->knobs, [&](const KnobDefault& p) { return p.knob == k.knob; })) continue;
        char one[64];
        std::snprintf(one, sizeof one, "%s=%g", std::string(k.knob->id).c_str(), static_cast<double>(k.knob->get(run.params)));
        text += std::string(text.empty() ? "" : " ") + one;
    }
    return text;
}

// A table whose first row is its head; a terminal's columns or a page's.
using Cells = std::vector<std::vector<std::string>>;
std::string table_text(const Cells& rows, bool markdown) {
    std::string text;
    std::vector<std::size_t> width(rows.front().size(), 0);
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c)
            width[c] = std::max(width[c], static_cast<std::size_t>(std::ranges::count_if(row[c], [](char b) { return (static_cast<unsigned char>(b) & 0xc0) != 0x80; })));
    for (std::size_t r = 0; r < rows.size(); ++r) {
        std::string line = markdown ? "|" : "";
        for (std::size_t c = 0; c < rows[r].size(); ++c) line += markdown ? std::string(" ") + rows[r][c] + " |" : padded(rows[r][c], width[c], c > 1) + "  ";
        while (line.back() == ' ') line.pop_back();
        text += line + "\n";
        if (markdown && r == 0) {
            text += "|";
            for (std::size_t c = 0; c < rows[r].size(); ++c) text += c > 1 ? "---:|" : "---|";
            text += "\n";
        }
    }
    return text;
}

std::string name_of(const Technique& t, bool markdown) {
    if (!markdown) return std::string(t.id);
    std::string link = "[";
    return link.append(t.title).append("](generated/techniques/").append(t.id).append(".md)");
}

std::string test_title(const PublishedTest& test) {
    std::string title = readable_name(std::string(test.id));
    title[0] = 'T';
    return title + ": " + std::string(test.scene) + ", " + std::string(test.view) + " view, colour " + std::to_string(test.colour_texels) + "^2, height and normal " +
           std::to_string(test.height_texels) + "^2";
}

std::string test_table(const ReplicatedTest& test, bool markdown) {
    const std::string base(test.runs.front().technique->id);
    Cells rows{{"technique", "setting", "fps", "time / " + base, "published ratio", "wrong", "UV p99, texels", "fetches"}};
    for (const ReplicatedRun& run : test.runs)
        rows.push_back({name_of(*run.technique, markdown), knobs_of(run) + (run.published == nullptr && !knobs_of(run).empty() ? " (default)" : ""), short_number(run.frames_per_second()),
                        fixed(run.time_ratio, 2), run.published_ratio ? fixed(*run.published_ratio, 2) : "-", share(run.wrong), short_number(run.uv_p99_texels), fixed(run.fetches, 1)});
    return table_text(rows, markdown);
}

std::string ranking_table(const std::vector<Ranked>& ranking, bool markdown) {
    Cells rows{{"place", "technique", "published place", "error class", "wrong, mean", "time / normal_mapping"}};
    for (const Ranked& r : ranking)
        rows.push_back({std::to_string(r.place), name_of(*r.technique, markdown), r.published_place ? std::to_string(*r.published_place) : "-", std::to_string(r.error_class), share(r.wrong),
                        fixed(r.time_ratio, 2)});
    return table_text(rows, markdown);
}

}  // namespace

std::string replication_text(const Replication& replication) {
    std::string text;
    for (const ReplicatedTest& test : replication.tests) text += test_title(*test.test) + "\n" + test_table(test, false) + "\n";
    text += "Ranking, error first and time second, over " + std::to_string(replication.tests.size()) + (replication.tests.size() == 1 ? " test\n" : " tests\n") + ranking_table(replication.ranking, false);
    if (replication.with_others.size() > replication.ranking.size()) text += "\nThe same with techniques that were not compared then\n" + ranking_table(replication.with_others, false);
    return text + "\nPublished: " + std::string(published_tests_source) + ".\n";
}

std::string replication_page(const Replication& replication, const std::string& command) {
    std::string text = "# Eight published tests, run again\n\n"
        "In 2011 G. Nobrega de Lima compared eight techniques in eight tests (*Mapeamento de Geometrias a partir de Texturas em Tempo Real*, Universidade\n"
        "Federal do ABC, chapter 4): one quad, three reliefs, views from steep to grazing, each technique with as many steps as it took to look its best.\n"
        "Speed was measured in frames per second on a GeForce GTX 275; quality was judged by eye. Here the same techniques run with the same step counts,\n"
        "and both are measured.\n\n"
        "What cannot be had again: the three reliefs (only their sizes are known: three of our procedural materials stand in), the exact views (named as\n"
        "large, middle and small angles; ours are 65, 35 and 15 degrees), the size of the picture, the card. Frame rates are therefore set beside each other as\n"
        "ratios: how many times as long a frame takes as the first technique of its test. A pixel is *wrong* when its hit is off by more than half a texel\n"
        "along the ray, either way, or missing.\n\n"
        "Places go by error first and time second: techniques whose share of wrong pixels is within a quarter of the best of their class (or within a\n"
        "thousandth of all pixels) share an error class, and inside a class the faster comes first.\n\n"
        "<!-- measured -->\nMade by `" + command + "` on " + replication.device + " (" + replication.driver + "), " + std::to_string(replication.width) + " x " +
        std::to_string(replication.height) + ", median of " + std::to_string(replication.runs) + " interleaved runs.\n\n## Ranking\n\n" + ranking_table(replication.ranking, true);
    if (replication.with_others.size() > replication.ranking.size()) text += "\nWith the techniques that were not compared then, at their default knobs:\n\n" + ranking_table(replication.with_others, true);
    text += "<!-- /measured -->\n\n## Where and why the rankings differ\n\n";
    for (const PublishedPlace& p : published_ranking()) {
        const auto reason = std::ranges::find(reasons, p.technique, &Reason::technique);
        text += "- **" + technique_title(p.technique) + "** (published place " + std::to_string(p.place) + "): " + (reason != std::end(reasons) ? std::string(reason->reason) : "not explained yet.") + "\n";
    }
    for (const ReplicatedTest& test : replication.tests) text += "\n## " + test_title(*test.test) + "\n\n<!-- measured -->\n" + test_table(test, true) + "<!-- /measured -->\n";
    return text;
}

}  // namespace relievo

// What a comparison found, as one value: the conditions, a row per technique, material and view, and the budget sweep behind the
// plots. results.json holds exactly this; results.csv its rows; the page is made from it and from the catalogue.
#pragma once

#include "core/legend.h"
#include "core/map_set.h"
#include "core/measurement.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace relievo {

// A number by name, in the order in which it is to be read. Knob ids are those of techniques/knobs.h.
using KnobValues = std::vector<std::pair<std::string, double>>;

struct Row {
    std::string technique;  // id in the catalogue
    std::string material;   // name, as in Manifest::materials
    std::string view;       // id ("grazing") or degrees ("27.5")
    double elevation_deg = 0;
    KnobValues knobs;
    Measurement m;

    // Paths relative to the results' folder, with forward slashes; empty when there is no such picture.
    std::string image;
    std::string error_image;      // where it is wrong, in the colours of Results::error_legend
    std::string reference_image;  // the exact answer at the same size, same exposure
    std::string fetches_image;    // cost per pixel, in the colours of Results::fetches_legend
    std::string pixels;           // scripts with the values behind the pictures (pixels.h), for the page's inspector:
    std::string reference_pixels; //   the row's own, and those of the reference
    std::string where;            // where in the picture it is wrong, in words (pixels.h); may be empty
    std::string no_picture;       // why a path is empty, where one is; a general sentence stands in when this is empty too
};

struct MaterialNote {
    std::string name;
    int width = 0;  // of the height map, texels
    int height = 0;
    double height_scale = 0;  // amplitude of the relief, in UV units of the texture
    double zero_level = 0;    // height at which the polygon lies
    std::optional<double> physical_size_m;
    std::vector<std::string> notes;  // what was assumed or corrected on loading
    std::string input_hash;          // of everything that was read
};

struct Manifest {
    std::string command;
    std::string version;  // relievo's
    std::string date;     // UTC, ISO 8601
    std::string device;
    std::string driver;
    int width = 0;  // of a picture
    int height = 0;
    int runs = 0;               // timed runs per row, interleaved
    int samples_per_pixel = 0;  // of the reference image
    std::string shadow;         // how shadows were made: an id of techniques/modifiers.h
    std::string modifiers;      // those that were not at their defaults, "id=value" separated by blanks; may be empty
    int threads = 0;
    double seconds = 0;  // the whole comparison
    std::string docs;    // where the chapters are (folder or address); empty: the page links to none
    std::vector<MaterialNote> materials;
};

// The maps' names, which belong to a table this folder does not see.
struct MapName {
    Map map{};
    std::string id;
    std::string title;
    std::string summary;
};

struct Results {
    Manifest manifest;
    std::vector<Row> rows;
    std::vector<Row> sweep;  // the same techniques at other budgets: numbers only, no pictures
    Legend error_legend;
    Legend fetches_legend;
    std::vector<MapName> maps;
};

// The text of results.json. Numbers are finite or null; what is null has its reason in the row's "reasons", under its own name.
std::string results_json(const Results& results);

// The text of results.csv: a header line and one line per row (not the sweep), RFC 4180. A missing number is an empty field.
std::string results_csv(const Results& results);

// The reverse of results_json. `source` names the text in errors. Throws Error naming the first thing that is wrong and where.
Results parse_results(std::string_view json, const std::string& source);

// Reads a results.json, or the one inside a folder.
Results read_results(const std::filesystem::path& path);

}  // namespace relievo

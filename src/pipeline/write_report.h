// Everything that is written from the numbers of a comparison for people to read.
#pragma once

#include "report/results.h"

#include <filesystem>
#include <string>

namespace relievo {

// Writes index.html, results.csv and, where promises were judged, budgets.md (budget_table.h; else an older one is removed) into folder. All are made before the first is
// written, so a page that cannot be made leaves the folder as it was.
void write_report(const std::filesystem::path& folder, const Results& results);

// The same from a results.json, named by its path or its folder: after an upgrade of the page, or for results that came without it.
// Returns the page's path.
std::string rewrite_report(const std::string& path);

}  // namespace relievo

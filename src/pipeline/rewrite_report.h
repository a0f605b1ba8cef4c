// The page again, from the numbers: after an upgrade of the page, or for results that came without it.
#pragma once

#include <string>

namespace relievo {

// path: results.json or its folder. Writes index.html and results.csv beside it and returns the page's path.
std::string rewrite_report(const std::string& path);

}  // namespace relievo

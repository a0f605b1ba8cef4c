// The page: one HTML text that holds its style, its program and the results, and needs nothing else but the pictures beside it.
#pragma once

#include "report/results.h"

#include <string>
#include <vector>

namespace relievo {

// The text of index.html, to lie in the folder that the rows' picture paths are relative to. Opens from disk, asks nothing of the
// network. Throws Error when there is no row to show.
std::string page_html(const Results& results);

// The finding in two or three sentences of plain text, made from the numbers.
std::vector<std::string> answer(const Results& results);

}  // namespace relievo

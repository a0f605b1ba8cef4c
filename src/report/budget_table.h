// Whether every technique did what its row of the catalogue says, as a table to read.
#pragma once

#include "report/results.h"

#include <string>

namespace relievo {

// Markdown, a line per technique in the catalogue's order: pictures inside the budget, hits astray, and the picture that comes closest
// to the budget with the share of it that was needed, and the same of another material: how far apart the two are says what a budget set
// without the first would have been worth there. Rows that could not be judged are left out; empty if none could.
std::string budget_table(const Results& results);

}  // namespace relievo

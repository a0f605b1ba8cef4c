// Text as a page and as a table of commas takes it.
#pragma once

#include <string>
#include <string_view>

namespace relievo {

// For the content of an element or of an attribute in double quotes.
std::string html_text(std::string_view text);

// A field of CSV, in quotes where it needs them (RFC 4180).
std::string csv_text(std::string_view text);

}  // namespace relievo

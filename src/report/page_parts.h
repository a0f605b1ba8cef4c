// The files of src/report/page by name, as CMake embedded them.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace relievo {

const std::map<std::string, std::string, std::less<>>& page_parts();

}  // namespace relievo

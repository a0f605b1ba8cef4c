// How steady a film of fur is, as `relievo fur` prints it.
#pragma once

#include "pipeline/fur_steadiness.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace relievo {

nlohmann::ordered_json steadiness_json(const FurSteadiness& steadiness);

// A row for each number of passes.
std::string steadiness_text(const FurSteadiness& steadiness);

}  // namespace relievo

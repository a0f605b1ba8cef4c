// The proofs of what baked maps promise, as they are stored, and how often the published definitions break the same promise.
#pragma once

#include "core/map_set.h"
#include "core/progress.h"
#include "maps/cone_verifier.h"
#include "pipeline/material_source.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relievo {

struct VerifySettings {
    MaterialSource material;
    std::optional<Map> map;  // one of verifiable_maps(); none: all of them
    bool use_cache = true;
    int threads = 0;
};

struct VerifiedMap {
    std::string_view id, claim, source;
    bool promised;  // whether this program's techniques rely on it: a violation is then a failure
    Verification proof;
    double ms = 0;  // of the proof alone
};

// Ids of what can be verified: maps of the table, and "quick_cone", which is here for comparison only.
std::vector<std::string> verifiable_maps();

// Values are those a reader gets back from 16 bits, rounded to the safe side; for the published definitions too, in their favour.
// Throws UsageError for a map that makes no promise.
std::vector<VerifiedMap> verify_maps(const VerifySettings& settings, const Progress& progress);

}  // namespace relievo

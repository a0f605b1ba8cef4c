// The finding in words. It is told on the case that separates most: the material and view on which the best of the inexact
// techniques is worst. Wrong means a first hit more than half a texel late or early, or none.
#include "report/page.h"
#include "report/technique_text.h"

#include "techniques/catalogue.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

namespace relievo {

namespace {

std::optional<double> wrong_share(const Row& row) {
    if (!row.m.missed_first_hit || !row.m.early_hit) return std::nullopt;
    const double wrong = *row.m.missed_first_hit + *row.m.early_hit;
    return std::isfinite(wrong) ? std::optional(wrong) : std::nullopt;
}

bool is_exact(const Row& row) {
    const Technique* t = find_technique(row.technique);
    return t && t->exact;
}

// Techniques that at least try to find the hit; the others are wrong almost everywhere and make a cheap contrast.
bool searches(const Row& row) {
    const Technique* t = find_technique(row.technique);
    return !t || t->effects.self_occlusion;
}

std::string named(const Row& row, bool with_setting) {
    std::string name = technique_title(row.technique);
    const std::string setting = with_setting ? setting_text(row.knobs) : "";
    return setting.empty() ? name : name + " with " + setting;
}

std::string seen(const Row& row) {
    char degrees[32];
    std::snprintf(degrees, sizeof degrees, "%.4g", row.elevation_deg);
    return readable_name(row.material) + " seen at " + degrees + " degrees";
}

std::string wrong_pixels(double share) { return share == 0 ? "no wrong pixel" : percent(share) + " wrong pixels"; }

// "1.3 times the time", or the fetches where either was not timed.
std::string cost_against(const Row& row, const Row& other) {
    const auto ratio = [](double a, double b, const char* what) { return " at " + short_number(a / b) + " times the " + what + " of "; };
    if (row.m.gpu_ms && other.m.gpu_ms && row.m.gpu_ms->median > 0 && other.m.gpu_ms->median > 0)
        return ratio(row.m.gpu_ms->median, other.m.gpu_ms->median, "time");
    if (row.m.fetches && other.m.fetches && row.m.fetches->mean > 0 && other.m.fetches->mean > 0)
        return ratio(row.m.fetches->mean, other.m.fetches->mean, "fetches");
    return "";
}

// Fewer wrong pixels, or as few for fewer fetches: unlike times, those are the same in every run, and so is the sentence.
bool better(const Row& row, const Row& than) {
    if (*wrong_share(row) != *wrong_share(than)) return *wrong_share(row) < *wrong_share(than);
    return row.m.fetches && than.m.fetches && row.m.fetches->mean < than.m.fetches->mean;
}

struct Case {
    const Row* exact = nullptr;
    std::vector<const Row*> others;  // that search, best first
};

std::vector<Case> cases_of(const Results& results) {
    std::map<std::pair<std::string, std::string>, Case> by_place;
    for (const Row& row : results.rows) {
        if (!wrong_share(row)) continue;
        Case& c = by_place[{row.material, row.view}];
        if (is_exact(row)) {
            if (!c.exact || better(row, *c.exact)) c.exact = &row;
        } else if (searches(row)) {
            c.others.push_back(&row);
        }
    }
    std::vector<Case> cases;
    for (auto& [place, c] : by_place) {
        std::ranges::stable_sort(c.others, {}, [](const Row* r) { return *wrong_share(*r); });
        if (!c.others.empty()) cases.push_back(c);
    }
    return cases;
}

// Whether techniques do what their rows say, over all pictures that could be judged; empty if none could.
std::string budgets_sentence(const Results& results) {
    int judged = 0;
    int outside = 0;
    const Row* worst = nullptr;
    const auto times = [](const Row& row) { return *row.m.astray / std::max(*row.m.astray_budget, 1e-12); };
    for (const Row& row : results.rows) {
        const Measured<bool> inside = inside_budget(row.m);
        if (!inside) continue;
        ++judged;
        if (*inside) continue;
        ++outside;
        if (!worst || times(row) > times(*worst)) worst = &row;
    }
    if (judged == 0) return {};
    if (outside == 0) return "Every technique keeps its promise in every picture.";
    return std::to_string(outside) + " of " + std::to_string(judged) + " pictures break what their technique promises; worst is " +
           inside_sentence(named(*worst, false)) + " on " + seen(*worst) + ", with " + percent(*worst->m.astray) + " of its hits astray where " +
           percent(*worst->m.astray_budget) + " are allowed.";
}

}  // namespace

std::vector<std::string> answer(const Results& results) {
    std::vector<std::string> sentences;
    const std::vector<Case> cases = cases_of(results);
    if (cases.empty()) return {"The rows hold no two techniques that search for the surface, so there is nothing to weigh against each other."};

    const Case& hard = *std::ranges::max_element(cases, {}, [](const Case& c) { return *wrong_share(*c.others.front()); });
    const Row& best = *hard.others.front();
    const Row& worst = *hard.others.back();
    if (hard.exact) {
        const std::string cost = cost_against(*hard.exact, best);
        const bool tied = *wrong_share(best) == *wrong_share(*hard.exact);
        std::string text = "On " + seen(best) + ", " + inside_sentence(named(*hard.exact, false)) + " shows " + wrong_pixels(*wrong_share(*hard.exact));
        if (!cost.empty()) text += "," + cost + inside_sentence(named(best, true));
        else text += "; " + inside_sentence(named(best, true));
        if (tied) text += cost.empty() ? " does as well" : ", which does as well";
        else text += (cost.empty() ? " puts " : ", which puts ") + percent(*wrong_share(best)) + " of the pixels in the wrong place";
        sentences.push_back(text + ".");
    } else {
        sentences.push_back("On " + seen(best) + ", the hardest case here, " + inside_sentence(named(best, true)) + " comes closest, with " +
                            wrong_pixels(*wrong_share(best)) + ".");
    }
    if (&worst != &best)
        sentences.push_back(named(worst, true) + " gets " + percent(*wrong_share(worst)) + " wrong there.");

    if (hard.exact && cases.size() > 1) {
        double exact_worst = 0;
        std::map<std::string, std::pair<double, int>> sums;  // mean wrong share of each inexact technique
        std::set<std::string> materials;
        int counted = 0;
        for (const Case& c : cases) {
            if (!c.exact) continue;
            ++counted;
            materials.insert(c.exact->material);
            exact_worst = std::max(exact_worst, *wrong_share(*c.exact));
            for (const Row* r : c.others) sums[r->technique].first += *wrong_share(*r), ++sums[r->technique].second;
        }
        const auto mean = [](const auto& s) { return s.second.first / s.second.second; };
        const auto runner_up = std::ranges::min_element(sums, {}, mean);
        sentences.push_back("Over all " + std::to_string(counted) + " pictures of " + std::to_string(materials.size()) +
                            (materials.size() == 1 ? " material" : " materials") + ", the exact search shows " +
                            (exact_worst == 0 ? "no wrong pixel" : "at most " + wrong_pixels(exact_worst)) +
                            "; the best of the others, " + inside_sentence(technique_title(runner_up->first)) + ", is wrong on " +
                            percent(mean(*runner_up)) + " on average.");
    }
    if (const std::string kept = budgets_sentence(results); !kept.empty()) sentences.push_back(kept);
    return sentences;
}

}  // namespace relievo

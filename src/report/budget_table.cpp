#include "report/budget_table.h"

#include "report/technique_text.h"
#include "techniques/catalogue.h"

#include <algorithm>
#include <vector>

namespace relievo {

std::string budget_table(const Results& results) {
    std::string table;
    for (const Technique& t : techniques()) {
        std::vector<double> astray;
        int inside = 0;
        const Row* closest = nullptr;
        const Row* next = nullptr;  // closest of another material
        const auto used = [](const Row& row) { return *row.m.astray / *row.m.astray_budget; };
        for (const Row& row : results.rows) {
            const Measured<bool> verdict = inside_budget(row.m);
            if (row.technique != t.id || !verdict) continue;
            astray.push_back(*row.m.astray);
            inside += *verdict ? 1 : 0;
            if (!closest || used(row) > used(*closest)) {
                if (closest && closest->material != row.material) next = closest;
                closest = &row;
            } else if (row.material != closest->material && (!next || used(row) > used(*next))) {
                next = &row;
            }
        }
        if (!closest) continue;
        std::ranges::sort(astray);
        table += "| " + std::string(t.id) + " | " + std::to_string(inside) + " of " + std::to_string(astray.size()) + " | " + percent(astray[astray.size() / 2]) +
                 " / " + percent(astray.back()) + " | " + readable_name(closest->material) + ", " + closest->view + ": " + percent(*closest->m.astray) + " of " +
                 percent(*closest->m.astray_budget) + " | " + short_number(used(*closest)) + " | " +
                 (next ? readable_name(next->material) + ": " + short_number(used(*next)) : std::string("")) + " |\n";
    }
    if (table.empty()) return {};
    return "| technique | pictures inside its budget | hits astray, median / worst picture | closest to its budget | share of it used | closest of another material |\n|---|---|---|---|---|---|\n" + table;
}

}  // namespace relievo

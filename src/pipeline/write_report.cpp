#include "pipeline/write_report.h"

#include "assets/atomic_file.h"
#include "report/budget_table.h"
#include "report/page.h"

namespace relievo {

namespace fs = std::filesystem;

void write_report(const fs::path& folder, const Results& results) {
    const std::string csv = results_csv(results);
    const std::string page = page_html(results);
    const std::string budgets = budget_table(results);
    write_file_atomically(folder / "results.csv", csv);
    std::error_code none;  // that nothing stands there is well
    if (budgets.empty()) fs::remove(folder / "budgets.md", none);  // of an earlier comparison, whose promises were judged
    else write_file_atomically(folder / "budgets.md", budgets);
    write_file_atomically(folder / "index.html", page);
}

std::string rewrite_report(const std::string& path) {
    const fs::path folder = fs::is_directory(path) ? fs::path(path) : fs::path(path).parent_path();
    const Results results = read_results(path);
    write_report(folder, results);
    return (folder / "index.html").string();
}

}  // namespace relievo

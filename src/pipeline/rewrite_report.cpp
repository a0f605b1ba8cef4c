#include "pipeline/rewrite_report.h"

#include "assets/atomic_file.h"
#include "report/page.h"
#include "report/results.h"

#include <filesystem>

namespace relievo {

std::string rewrite_report(const std::string& path) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::is_directory(path) ? fs::path(path) : fs::path(path).parent_path();
    const Results results = read_results(path);
    write_file_atomically(folder / "results.csv", results_csv(results));
    write_file_atomically(folder / "index.html", page_html(results));
    return (folder / "index.html").string();
}

}  // namespace relievo

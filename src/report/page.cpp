#include "report/page.h"

#include "report/page_parts.h"

#include "core/error.h"

namespace relievo {

std::vector<std::string> answer(const Results&) { return {}; }

std::string page_html(const Results& results) {
    if (results.rows.empty()) throw Error("write the report", "index.html", "there is no row to show");
    std::string html = page_parts().at("index.html");
    std::string json = results_json(results);
    for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos; at += 3) json.replace(at, 2, "<\\/");
    html.replace(html.find("@results@"), 9, json);
    return html;
}

}  // namespace relievo

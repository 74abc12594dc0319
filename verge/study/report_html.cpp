// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <string_view>

#include <fmt/format.h>

#include "verge/core/version.hpp"
#include "verge/study/markup.hpp"
#include "verge/study/plots.hpp"
#include "verge/study/report.hpp"
#include "verge/study/table.hpp"

namespace verge::study {
namespace {

constexpr std::string_view kStyle =
    R"(:root{color-scheme:light dark;--ground:#fff;--ink:#16202a;--faint:#51606e;--line:#c9d1d9}
@media(prefers-color-scheme:dark){:root{--ground:#0d1117;--ink:#e6edf3;--faint:#9aa7b4;--line:#3a4550}}
body{margin:0 auto;padding:1.5rem;max-width:75rem;background:var(--ground);color:var(--ink);font:1rem/1.5 system-ui,sans-serif}
h1{font-size:1.7rem;margin:0 0 .5rem}h2{font-size:1.25rem;margin:2.2rem 0 .6rem}
p{max-width:46rem}.faint,figcaption{color:var(--faint);font-size:.9rem}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;margin:0 0 1.2rem}
caption{text-align:left;font-weight:600;padding:.3rem 0}
th,td{padding:.2rem .7rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap;font-weight:400}
thead th{font-weight:600;border-bottom-width:2px}
.word{text-align:left}
.grid-of-figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(30rem,100%),1fr));gap:1.5rem}
figure{margin:0}figure img{width:100%;height:auto;border-radius:4px}
)";

std::string table_row(const std::vector<std::string>& cells, std::size_t words, std::string_view word_tag,
                      std::string_view scope) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_word = i < words;
    const bool is_head = is_word || scope == "col";
    html +=
        fmt::format("<{}{}{}>{}</{}>", is_head ? word_tag : "td",
                    is_head ? fmt::format(R"( scope="{}")", scope) : std::string(),
                    is_word ? R"( class="word")" : "", escape_markup(cells[i]), is_head ? word_tag : "td");
  }
  return html + "</tr>\n";
}

std::string table_html(const Table& table, std::string_view caption) {
  std::string html = R"(<div class="wide" tabindex="0"><table>)";
  html += fmt::format("<caption>{}</caption>\n<thead>{}</thead>\n<tbody>\n", escape_markup(caption),
                      table_row(table.head, table.words, "th", "col"));
  for (const auto& row : table.rows) html += table_row(row, table.words, "th", "row");
  return html + "</tbody></table></div>\n";
}

std::string tables_html(const Results& results) {
  std::string html = "<h2>Figures</h2>\n";
  for (const Table& table : tables_of(results)) html += table_html(table, "By " + table.head.front());
  for (const std::string& note : notes_on(results)) html += fmt::format("<p>{}</p>\n", escape_markup(note));
  return html;
}

std::string plots_html(const Results& results) {
  std::string figures;
  std::size_t number = 0;
  for (const Plot& plot : plots_of(results)) {
    const std::string svg = to_svg(plot, fmt::format("plot{}", ++number));
    if (svg.empty()) continue;
    figures += fmt::format("<figure>\n{}<figcaption><b>{}.</b> {}</figcaption></figure>\n", svg,
                           escape_markup(plot.title), escape_markup(plot.about));
  }
  if (figures.empty()) return {};
  return fmt::format("<h2>Plots</h2>\n<div class=\"grid-of-figures\">\n{}</div>\n", figures);
}

std::string gallery_html(const Gallery& gallery) {
  if (gallery.pictures.empty()) return {};
  std::string html = fmt::format("<h2>{}</h2>\n<p>{}</p>\n<div class=\"grid-of-figures\">\n",
                                 escape_markup(gallery.title), escape_markup(gallery.about));
  for (const Picture& picture : gallery.pictures) {
    const std::string caption = escape_markup(picture.caption);
    html += fmt::format(
        "<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
        caption, base64(picture.png), caption);
  }
  return html + "</div>\n";
}

}  // namespace

std::string html_report(const Results& results, const std::vector<Gallery>& galleries, bool times) {
  const std::string title = escape_markup(results.suite.title);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<title>verge: "
      "{}</title>\n<style>\n{}{}</style>\n</head>\n"
      "<body>\n<main>\n<h1>{}</h1>\n<p>{}</p>\n<p class=\"faint\">verge {}, suite {}. Definitions: "
      "docs/evaluation.md.</p>\n",
      title, kStyle, plot_style(), title, escape_markup(results.suite.about), version(), results.suite.name);
  html += tables_html(results) + plots_html(results);
  for (const Gallery& gallery : galleries) html += gallery_html(gallery);
  if (times) html += "<h2>Run time</h2>\n" + table_html(time_table(results), "Milliseconds");
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace verge::study

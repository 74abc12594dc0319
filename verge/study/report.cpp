// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/report.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "verge/core/csv_field.hpp"
#include "verge/core/version.hpp"
#include "verge/study/figures.hpp"
#include "verge/study/figures_json.hpp"
#include "verge/study/table.hpp"

namespace verge::study {
namespace {

using nlohmann::ordered_json;

ordered_json number(const std::optional<double>& value) { return ordered_json::parse(figure_json(value)); }

ordered_json figures_json(const Figures& figures) {
  ordered_json json = ordered_json::object();
  for (const Figure& figure : figures) json[figure.name] = number(figure.value);
  return json;
}

ordered_json boundaries_json(const Tally& tally) {
  ordered_json json = {{"tolerance", ordered_json::parse(cells_json(tally.cells))},
                       {"by_range", ordered_json::array()},
                       {"by_confidence", ordered_json::parse(confidence_json(tally.by_confidence))}};
  for (std::size_t i = 0; i < tally.by_range.bins.size(); ++i) {
    ordered_json entry = {{"from_m", static_cast<double>(i) * tally.by_range.width_m}};
    entry.update(ordered_json::parse(counts_json(tally.by_range.bins[i])));
    if (i < tally.lateral_by_range_m.size())
      entry["lateral_p95_m"] = number(tally.lateral_by_range_m[i].sizes().percentile(95.0));
    json["by_range"].push_back(std::move(entry));
  }
  return json;
}

ordered_json cell_json(const Results& results, std::size_t index) {
  const Cell& cell = results.suite.cells[index];
  ordered_json json = {{"cell", cell.name}};
  if (!cell.condition.empty()) json.update({{"condition", cell.condition}, {"value", number(cell.value)}});
  json["methods"] = ordered_json::array();
  for (std::size_t i = 0; i < results.contestants.size(); ++i) {
    const Tally& tally = results.tally(index, i);
    ordered_json entry = {
        {"method", results.contestants[i].name},
        {"figures", figures_json(figures_of(results.suite, results.contestants[i], tally))}};
    if (!tally.cells.empty()) entry["boundaries"] = boundaries_json(tally);
    json["methods"].push_back(std::move(entry));
  }
  for (const Printed& printed : results.suite.printed) {
    if (printed.cell != cell.name) continue;
    ordered_json figures = ordered_json::object();
    for (const auto& [name, value] : printed.figures) figures[name] = value;
    json["printed"].push_back({{"by", printed.by}, {"figures", figures}});
  }
  return json;
}

ordered_json times_json(const Results& results) {
  ordered_json json = ordered_json::array();
  for (std::size_t i = 0; i < results.contestants.size(); ++i)
    json.push_back(
        {{"method", results.contestants[i].name}, {"figures", figures_json(times_of(all_of(results, i)))}});
  return json;
}

std::string csv_line(const Cell& cell, const std::string& who, const Figures& names, const Figures& figures) {
  std::string line =
      fmt::format("{},{},{},{}", csv_field(cell.name), csv_field(cell.condition),
                  cell.condition.empty() ? std::string() : fmt::format("{:g}", cell.value), csv_field(who));
  for (const Figure& figure : names) {
    const auto value = value_of(figures, figure.name);
    line += ',' + (value ? figure_json(value) : std::string());
  }
  return line + "\r\n";
}

}  // namespace

std::string text_report(const Results& results, bool times) {
  std::string text = fmt::format("{}\n{}\n", results.suite.title, results.suite.about);
  for (const Table& table : tables_of(results)) text += '\n' + to_text(table);
  if (times) text += '\n' + to_text(time_table(results));
  for (const std::string& note : notes_on(results)) text += '\n' + note;
  return notes_on(results).empty() ? text : text + '\n';
}

std::string json_report(const Results& results, bool times) {
  ordered_json json = {{"suite", results.suite.name},
                       {"version", version()},
                       {"cells", ordered_json::array()},
                       {"notes", notes_on(results)}};
  for (std::size_t cell = 0; cell < results.suite.cells.size(); ++cell)
    json["cells"].push_back(cell_json(results, cell));
  if (times) json["times"] = times_json(results);
  return json.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string csv_report(const Results& results) {
  const Suite& suite = results.suite;
  const Figures names =
      suite.cells.empty() ? Figures{} : figures_of(suite, results.contestants[0], results.tally(0, 0));
  std::string text = "cell,condition,value,method";
  for (const Figure& figure : names) text += ',' + figure.name;
  text += "\r\n";
  for (std::size_t cell = 0; cell < suite.cells.size(); ++cell) {
    for (std::size_t i = 0; i < results.contestants.size(); ++i) {
      text += csv_line(suite.cells[cell], results.contestants[i].name, names,
                       figures_of(suite, results.contestants[i], results.tally(cell, i)));
    }
    for (const Printed& printed : suite.printed) {
      if (printed.cell != suite.cells[cell].name) continue;
      Figures figures;
      for (const auto& [name, value] : printed.figures) figures.push_back({name, value});
      text += csv_line(suite.cells[cell], printed.by, names, figures);
    }
  }
  return text;
}

}  // namespace verge::study

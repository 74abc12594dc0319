// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/table.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "verge/study/figures.hpp"

namespace verge::study {
namespace {

std::string text_of(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : std::string("-");
}

std::vector<std::string> row_of(const Suite& suite, std::string cell, std::string who,
                                const Figures& figures) {
  std::vector<std::string> row = {std::move(cell), std::move(who)};
  for (const Column& column : suite.columns)
    row.push_back(text_of(value_of(figures, column.figure), column.digits));
  return row;
}

Figures figures_in(const Printed& printed) {
  Figures figures;
  for (const auto& [name, value] : printed.figures) figures.push_back({name, value});
  return figures;
}

void add_rows(const Results& results, std::size_t index, const std::string& name, Table& table) {
  const Suite& suite = results.suite;
  for (std::size_t i = 0; i < results.contestants.size(); ++i) {
    const Contestant& contestant = results.contestants[i];
    table.rows.push_back(
        row_of(suite, name, contestant.name, figures_of(suite, contestant, results.tally(index, i))));
  }
  for (const Printed& printed : suite.printed) {
    if (printed.cell == suite.cells[index].name)
      table.rows.push_back(row_of(suite, name, printed.by, figures_in(printed)));
  }
}

Table empty_table(const Suite& suite, const std::string& condition) {
  Table table{.title = {}, .head = {condition.empty() ? "case" : condition, "method"}, .rows = {}};
  for (const Column& column : suite.columns) table.head.push_back(column.heading);
  return table;
}

std::string absent_part(std::string_view what, std::string_view who) {
  return fmt::format("{} does not report {}: such figures are \"-\".", who, what);
}

std::size_t damaged_in(const Results& results) {
  std::size_t damaged = 0;
  for (const Tally& tally : results.tallies) damaged = std::max(damaged, tally.damaged);
  return damaged;
}

}  // namespace

std::vector<Table> tables_of(const Results& results) {
  std::vector<Table> tables;
  const Suite& suite = results.suite;
  for (std::size_t i = 0; i < suite.cells.size(); ++i) {
    const Cell& cell = suite.cells[i];
    if (i == 0 || cell.condition != suite.cells[i - 1].condition)
      tables.push_back(empty_table(suite, cell.condition));
    add_rows(results, i, cell.condition.empty() ? cell.name : fmt::format("{:g}", cell.value), tables.back());
  }
  return tables;
}

Tally all_of(const Results& results, std::size_t contestant) {
  Tally all;
  for (std::size_t cell = 0; cell < results.suite.cells.size(); ++cell)
    all += results.tally(cell, contestant);
  return all;
}

Table time_table(const Results& results) {
  Table table{
      .title = "Time for a scan, mount and method, by the clock", .head = {"method"}, .words = 1, .rows = {}};
  for (const Figure& figure : times_of(Tally{})) table.head.push_back(figure.name);
  for (std::size_t i = 0; i < results.contestants.size(); ++i) {
    std::vector<std::string> row = {results.contestants[i].name};
    for (const Figure& figure : times_of(all_of(results, i))) row.push_back(text_of(figure.value, 2));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<std::string> notes_on(const Results& results) {
  std::vector<std::string> notes;
  const Judged& judged = results.suite.judged;
  for (const Contestant& contestant : results.contestants) {
    if (judged.corners && !contestant.says.corners) notes.push_back(absent_part("corners", contestant.name));
    if (judged.objects && !contestant.says.objects) notes.push_back(absent_part("objects", contestant.name));
  }
  for (std::size_t i = 0; i < results.contestants.size(); ++i) {
    if (const std::size_t absent = all_of(results, i).absent; absent > 0)
      notes.push_back(fmt::format("{} says nothing of {} scans (over all rows): nothing was found there.",
                                  results.contestants[i].name, absent));
  }
  if (const std::size_t damaged = damaged_in(results); damaged > 0)
    notes.push_back(fmt::format("{} scans of a set could not be read and count as not found.", damaged));
  return notes;
}

std::string to_text(const Table& table) {
  std::vector<std::size_t> width;
  for (const std::string& head : table.head) width.push_back(head.size());
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += i < table.words ? fmt::format("{:<{}}  ", cells[i], width[i])
                              : fmt::format("{:>{}}  ", cells[i], width[i]);
    text.erase(text.find_last_not_of(' ') + 1);
    return text + '\n';
  };
  std::string text = table.title.empty() ? std::string() : table.title + "\n\n";
  text += line(table.head);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

}  // namespace verge::study

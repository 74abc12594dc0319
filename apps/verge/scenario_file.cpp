// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/scenario_file.hpp"

#include <array>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "apps/verge/toml_file.hpp"
#include "verge/core/field_io.hpp"

namespace verge::app {
namespace {

/// A section of the file: what its tables are in a scenario.
struct Section {
  std::string_view name;
  std::string_view below;  // the list whose last table it belongs to; empty = none
  bool list;
  std::function<void(sim::Scenario&)> begin;  // a new table of a list
  std::function<std::vector<FieldRow>(sim::Scenario&)> rows;
  std::function<void(sim::Scenario&, const TomlEntry&)> set;
};

template <class Get>
Section plain(std::string_view name, const Get& get) {
  return {name,
          {},
          false,
          [](sim::Scenario&) {},
          [get](sim::Scenario& s) { return field_rows(get(s)); },
          [get](sim::Scenario& s, const TomlEntry& entry) { set_field(get(s), entry.key, entry.value); }};
}

// A list: `get` gives the vector whose last element the keys belong to.
template <class Get>
Section listed(std::string_view name, std::string_view below, const Get& get) {
  return {
      name,
      below,
      true,
      [get](sim::Scenario& s) { get(s).emplace_back(); },
      [get](sim::Scenario& s) { return field_rows(get(s).back()); },
      [get](sim::Scenario& s, const TomlEntry& entry) { set_field(get(s).back(), entry.key, entry.value); }};
}

template <class Part>
Section of_road(std::string_view name, std::vector<Part> sim::RoadConfig::*part) {
  return listed(name, "road", [part](sim::Scenario& s) -> auto& { return s.roads.back().*part; });
}

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      plain("ground", [](sim::Scenario& s) -> auto& { return s.ground; }),
      plain("vehicle", [](sim::Scenario& s) -> auto& { return s.course; }),
      listed("vehicle.piece", {}, [](sim::Scenario& s) -> auto& { return s.course.pieces; }),
      plain("mount", [](sim::Scenario& s) -> auto& { return s.stand; }),
      plain("weather", [](sim::Scenario& s) -> auto& { return s.weather; }),
      listed("road", {}, [](sim::Scenario& s) -> auto& { return s.roads; }),
      of_road("road.piece", &sim::RoadConfig::pieces),
      of_road("road.width", &sim::RoadConfig::widths),
      of_road("road.height", &sim::RoadConfig::heights),
      of_road("road.gap", &sim::RoadConfig::gaps),
      of_road("road.bay", &sim::RoadConfig::bays),
      of_road("road.island", &sim::RoadConfig::islands),
      of_road("road.row", &sim::RoadConfig::rows),
      of_road("road.thing", &sim::RoadConfig::items)};
  return all;
}

const Section* section_named(std::string_view name) {
  for (const Section& section : sections()) {
    if (section.name == name) return &section;
  }
  return nullptr;
}

std::string unknown_section(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Section& section : sections()) names.push_back(section.name);
  const std::string_view near = nearest_word(name, names);
  return near.empty() ? fmt::format("unknown section '{}' (known: {})", name, fmt::join(names, ", "))
                      : fmt::format("unknown section '{}' (did you mean '{}'?)", name, near);
}

Error fault(const std::filesystem::path& file, const std::string& where, std::string what) {
  return {ErrorCode::kUsage, file.string(), where, std::move(what), {}, {}};
}

Expected<void> begin_table(sim::Scenario& scenario, const Section& section, const TomlEntry& entry,
                           const std::filesystem::path& file) {
  if (section.below == "road" && scenario.roads.empty()) {
    return Unexpected(
        fault(file, entry.key_where, fmt::format("[[{}]] needs a [[road]] above it", section.name)));
  }
  section.begin(scenario);
  return {};
}

Expected<void> set_key(sim::Scenario& scenario, const Section& section, const TomlEntry& entry,
                       const std::filesystem::path& file) {
  for (const FieldRow& row : section.rows(scenario)) {
    if (row.info.name != entry.key) continue;
    if (auto misfit = kind_misfit(entry, row)) return Unexpected(fault(file, entry.value_where, *misfit));
  }
  try {
    section.set(scenario, entry);
  } catch (const std::invalid_argument& error) {
    const bool known = std::string_view(error.what()).starts_with(entry.key + ":");
    return Unexpected(fault(file, known ? entry.value_where : entry.key_where, error.what()));
  }
  return {};
}

Expected<void> take(sim::Scenario& scenario, const TomlEntry& entry, const std::filesystem::path& file) {
  const std::string_view name = entry.section.empty() ? entry.key : entry.section;
  const Section* section = section_named(name);
  if (section == nullptr) return Unexpected(fault(file, entry.key_where, unknown_section(name)));
  const bool is_table = !entry.section.empty();
  if (!is_table) {
    return Unexpected(fault(file, entry.key_where, fmt::format("'{}' is a section, not a key", name)));
  }
  if (!entry.key.empty()) return set_key(scenario, *section, entry, file);
  return begin_table(scenario, *section, entry, file);
}

void add_table(std::string& text, sim::Scenario scenario, const Section& section) {
  text += fmt::format("{}{}{}\n", section.list ? "[[" : "[", section.name, section.list ? "]]" : "]");
  const std::vector<FieldRow> usual = [&] {
    sim::Scenario fresh;
    if (section.below == "road") fresh.roads.emplace_back();
    section.begin(fresh);
    return section.rows(fresh);
  }();
  const std::vector<FieldRow> rows = section.rows(scenario);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].value == usual[i].value) continue;
    const std::string_view quote = rows[i].type == FieldType::kChoice ? "\"" : "";
    text += fmt::format("{} = {}{}{}\n", rows[i].info.name, quote, rows[i].value, quote);
  }
  text += "\n";
}

// Each element of a list, as the last one of a copy.
template <class Part>
void add_parts(std::string& text, const sim::RoadConfig& road, std::string_view name,
               std::vector<Part> sim::RoadConfig::*part) {
  sim::Scenario one;
  one.roads.emplace_back();
  for (const Part& element : road.*part) {
    (one.roads.back().*part).push_back(element);
    add_table(text, one, *section_named(name));
  }
}

void add_road(std::string& text, const sim::RoadConfig& road) {
  sim::Scenario one;
  one.roads.push_back(road);
  add_table(text, one, *section_named("road"));
  add_parts(text, road, "road.piece", &sim::RoadConfig::pieces);
  add_parts(text, road, "road.width", &sim::RoadConfig::widths);
  add_parts(text, road, "road.height", &sim::RoadConfig::heights);
  add_parts(text, road, "road.gap", &sim::RoadConfig::gaps);
  add_parts(text, road, "road.bay", &sim::RoadConfig::bays);
  add_parts(text, road, "road.island", &sim::RoadConfig::islands);
  add_parts(text, road, "road.row", &sim::RoadConfig::rows);
  add_parts(text, road, "road.thing", &sim::RoadConfig::items);
}

}  // namespace

Expected<sim::Scenario> read_scenario(const std::filesystem::path& file) {
  const auto entries = read_toml_lists(file);
  if (!entries) return Unexpected(entries.error());
  sim::Scenario scenario;
  for (const TomlEntry& entry : *entries) {
    if (auto taken = take(scenario, entry, file); !taken) return Unexpected(taken.error());
  }
  return scenario;
}

std::string to_toml(const sim::Scenario& scenario) {
  std::string text = "# What is left out has its default: verge simulate --keys\n\n";
  for (const std::string_view name : {"ground", "vehicle", "mount", "weather"})
    add_table(text, scenario, *section_named(name));
  sim::Scenario one;
  for (const sim::Piece& piece : scenario.course.pieces) {
    one.course.pieces.push_back(piece);
    add_table(text, one, *section_named("vehicle.piece"));
  }
  for (const sim::RoadConfig& road : scenario.roads) add_road(text, road);
  text.pop_back();
  return text;
}

std::string scenario_keys() {
  std::string text;
  for (const Section& section : sections()) {
    sim::Scenario fresh;
    if (section.below == "road") fresh.roads.emplace_back();
    section.begin(fresh);
    text += fmt::format("{}{}{}\n{}\n", section.list ? "[[" : "[", section.name, section.list ? "]]" : "]",
                        to_table(section.rows(fresh)));
  }
  text.pop_back();
  return text;
}

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/figures_json.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include <nlohmann/json.hpp>

namespace verge::study {
namespace {

using nlohmann::ordered_json;

ordered_json number(const std::optional<double>& figure) {
  constexpr double kWhole = 1e15;  // below it every whole number is a double
  if (!figure || !std::isfinite(*figure)) return nullptr;
  const double rounded = std::round(*figure * 1e6) / 1e6;
  if (rounded == std::floor(rounded) && std::fabs(rounded) < kWhole)
    return static_cast<std::int64_t>(rounded);
  return rounded;
}

ordered_json object_of(const eval::ToleranceCounts& counts) {
  return {{"predicted", counts.predicted},
          {"right", counts.right},
          {"visible", counts.visible},
          {"found_visible", counts.found_visible},
          {"occluded", counts.occluded},
          {"found_occluded", counts.found_occluded},
          {"precision", number(counts.precision())},
          {"recall", number(counts.recall())},
          {"occluded_recall", number(counts.occluded_recall())},
          {"f1", number(counts.f1())}};
}

}  // namespace

std::string figure_json(const std::optional<double>& figure) { return number(figure).dump(); }

std::string counts_json(const eval::ToleranceCounts& counts) { return object_of(counts).dump(); }

std::string cells_json(std::span<const eval::ToleranceCell> cells) {
  ordered_json json = ordered_json::array();
  for (const eval::ToleranceCell& cell : cells) {
    ordered_json entry = {{"range_m", number(cell.range_m)}, {"tolerance_m", number(cell.tolerance_m)}};
    entry.update(object_of(cell.counts));
    entry["macro_f1"] = number(cell.macro_f1());
    json.push_back(std::move(entry));
  }
  return json.dump();
}

std::string confidence_json(std::span<const eval::ConfidencePoint> points) {
  ordered_json json = ordered_json::array();
  for (const eval::ConfidencePoint& point : points) {
    ordered_json entry = {{"least_confidence", number(point.least_confidence)}};
    entry.update(object_of(point.counts));
    json.push_back(std::move(entry));
  }
  return json.dump();
}

}  // namespace verge::study

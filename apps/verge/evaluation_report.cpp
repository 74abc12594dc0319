// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/evaluation_report.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/verge/csv_text.hpp"
#include "apps/verge/metric_report.hpp"
#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"

namespace verge::app {
namespace {

using nlohmann::ordered_json;

/// The scans of one shape of road, or all.
struct Group {
  std::string name;
  eval::BoundarySummary summary;
};

std::vector<Group> groups_of(const eval::Comparison& comparison, double tolerance_m) {
  std::vector<Group> groups;
  for (std::size_t shape = 0; shape < enum_names<eval::RoadShape>.size(); ++shape) {
    std::vector<eval::BoundaryErrors> scans;
    for (const eval::BoundaryErrors& scan : comparison.scans) {
      if (static_cast<std::size_t>(scan.shape) == shape) scans.push_back(scan);
    }
    if (scans.empty()) continue;
    groups.push_back(
        {std::string(enum_names<eval::RoadShape>.at(shape)), eval::summarise(scans, tolerance_m)});
  }
  groups.push_back({"all", eval::summarise(comparison.scans, tolerance_m)});
  return groups;
}

std::string metres(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : std::string("-");
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f}", 100.0 * *share) : std::string("-");
}

std::string row(const Group& group) {
  const eval::BoundarySummary& s = group.summary;
  return fmt::format("{:<10}{:>7}{:>8}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", group.name, s.scans,
                     s.scans_without_prediction, s.predicted_samples, metres(s.median_m),
                     metres(s.percentile_95_m), metres(s.greatest_m), percent(s.share_right),
                     percent(s.share_covered));
}

ordered_json figures(const eval::BoundarySummary& s) {
  return {{"scans", s.scans},
          {"scans_without_prediction", s.scans_without_prediction},
          {"predicted_samples", s.predicted_samples},
          {"truth_samples", s.truth_samples},
          {"median_m", figure(s.median_m)},
          {"percentile_95_m", figure(s.percentile_95_m)},
          {"greatest_m", figure(s.greatest_m)},
          {"share_right", figure(s.share_right)},
          {"share_covered", figure(s.share_covered)}};
}

ordered_json scan_json(const eval::BoundaryErrors& scan, double tolerance_m) {
  ordered_json json = {{"frame", scan.frame}, {"shape", name_of(scan.shape)}, {"predicted", scan.predicted}};
  ordered_json rest = figures(eval::summarise(std::span(&scan, 1), tolerance_m));
  rest.erase("scans");
  rest.erase("scans_without_prediction");
  json.update(rest);
  return json;
}

std::string distance_table(const TruthEvaluation& evaluation) {
  const eval::SceneEvaluationConfig& config = evaluation.config;
  std::string table = fmt::format(
      "Boundaries within {:g} m of the sensor against the truth: distance of each predicted sample (m), and\n"
      "how many of the predicted (right) and of the true samples (covered) lie within {:g} m of the "
      "other{}.\n\n"
      "{:<10}{:>7}{:>8}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n",
      config.range_m, config.tolerance_m, config.any_side ? " (of any side)" : " (of the same side)", "road",
      "scans", "empty", "samples", "median", "95 %", "greatest", "right %", "covered %");
  for (const Group& group : groups_of(evaluation.errors, config.tolerance_m)) table += row(group);
  return table;
}

std::string frame_rows(const TruthEvaluation& evaluation) {
  std::string text = fmt::format("{:<24}{:<10}", "scan", "road");
  for (const double tolerance_m : evaluation.config.tolerances_m)
    text += fmt::format("{:>10}", fmt::format("F1@{:g}", tolerance_m));
  text += '\n';
  for (std::size_t i = 0; i < evaluation.scan_cells.size(); ++i) {
    const eval::BoundaryErrors& scan = evaluation.errors.scans[i];
    text += fmt::format("{:<24}{:<10}", escape_control_bytes(scan.frame), name_of(scan.shape));
    for (const eval::ToleranceCell& cell : evaluation.scan_cells[i]) {
      if (cell.range_m == evaluation.config.range_m) text += fmt::format("{:>10}", metres(cell.counts.f1()));
    }
    text += '\n';
  }
  return text + '\n';
}

std::string csv_rows(std::string_view scope, std::string_view frame,
                     std::span<const eval::ToleranceCell> cells) {
  const auto text = [](const std::optional<double>& share) {
    return share ? fmt::format("{:.6f}", *share) : std::string();
  };
  std::string rows;
  for (const eval::ToleranceCell& cell : cells) {
    const eval::ToleranceCounts& counts = cell.counts;
    rows += csv_row({std::string(scope), std::string(frame), fmt::format("{:g}", cell.range_m),
                     fmt::format("{:g}", cell.tolerance_m), fmt::to_string(counts.predicted),
                     fmt::to_string(counts.right), fmt::to_string(counts.visible),
                     fmt::to_string(counts.found_visible), fmt::to_string(counts.occluded),
                     fmt::to_string(counts.found_occluded), text(counts.precision()), text(counts.recall()),
                     text(counts.occluded_recall()), text(counts.f1()), text(cell.macro_f1())});
  }
  return rows;
}

}  // namespace

std::string truth_table(const TruthEvaluation& evaluation, bool per_frame) {
  return (per_frame ? frame_rows(evaluation) : std::string()) + distance_table(evaluation) +
         metric_tables(evaluation);
}

std::string truth_json(const TruthEvaluation& evaluation) {
  const eval::SceneEvaluationConfig& config = evaluation.config;
  ordered_json json = {{"range_m", config.range_m},
                       {"tolerance_m", config.tolerance_m},
                       {"step_m", eval::BoundaryErrorConfig{}.step_m},
                       {"any_side", config.any_side}};
  for (const Group& group : groups_of(evaluation.errors, config.tolerance_m)) {
    json["groups"][group.name] = figures(group.summary);
  }
  json["metrics"] = metrics_json(evaluation);
  json["scans"] = ordered_json::array();
  for (const eval::BoundaryErrors& scan : evaluation.errors.scans) {
    json["scans"].push_back(scan_json(scan, config.tolerance_m));
  }
  json["frames_without_truth"] = evaluation.errors.frames_without_truth;
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string truth_csv(const TruthEvaluation& evaluation) {
  std::string text =
      csv_row({"scope", "frame", "range_m", "tolerance_m", "predicted", "right", "visible", "found_visible",
               "occluded", "found_occluded", "precision", "recall", "occluded_recall", "f1", "macro_f1"});
  text += csv_rows("all", {}, evaluation.all.cells);
  for (std::size_t i = 0; i < evaluation.scan_cells.size(); ++i)
    text += csv_rows("scan", evaluation.errors.scans[i].frame, evaluation.scan_cells[i]);
  return text;
}

}  // namespace verge::app

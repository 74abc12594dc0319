// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/metric_report.hpp"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "verge/core/angle.hpp"
#include "verge/core/statistics.hpp"
#include "verge/study/figures_json.hpp"

namespace verge::app {
namespace {

using nlohmann::ordered_json;

constexpr double kLateralBin_m = 10.0;

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : std::string("-");
}

std::string degrees(const std::optional<double>& rad) {
  return rad ? fmt::format("{:.2f}", rad_to_deg(*rad)) : std::string("-");
}

std::string cell_row(double first, const eval::ToleranceCell& cell) {
  return fmt::format("{:<10g}{:>11}{:>9}{:>10}{:>9}{:>10}\n", first, text_of(cell.counts.precision()),
                     text_of(cell.counts.recall()), text_of(cell.counts.occluded_recall()),
                     text_of(cell.counts.f1()), text_of(cell.macro_f1()));
}

std::string cell_head(std::string_view first) {
  return fmt::format("{:<10}{:>11}{:>9}{:>10}{:>9}{:>10}\n", first, "precision", "recall", "occluded", "F1",
                     "macro F1");
}

std::string tolerance_tables(const TruthEvaluation& evaluation) {
  const eval::SceneEvaluationConfig& config = evaluation.config;
  std::string by_tolerance =
      fmt::format("\nWithin {:g} m, by tolerance (m):\n\n", config.range_m) + cell_head("tolerance");
  std::string by_range =
      fmt::format("\nAt a tolerance of {:g} m, by range (m):\n\n", config.tolerance_m) + cell_head("range");
  for (const eval::ToleranceCell& cell : evaluation.all.cells) {
    if (cell.range_m == config.range_m) by_tolerance += cell_row(cell.tolerance_m, cell);
    if (cell.tolerance_m == config.tolerance_m) by_range += cell_row(cell.range_m, cell);
  }
  return by_tolerance + by_range;
}

std::string line(std::string_view name, const std::string& text) {
  return fmt::format("{:<18}{}\n", name, text);
}

std::string success_line(std::string_view name, const eval::SuccessCounts& counts) {
  const auto interval = eval::wilson_interval(counts.successes(), counts.scans());
  if (!interval) return {};
  return line(name,
              fmt::format("{} of {} scans ({} with minimum, {} with larger deviation): {:.3f}, 95 % interval "
                          "{:.3f} to {:.3f}",
                          counts.successes(), counts.scans(), counts.minimum, counts.larger, interval->share,
                          interval->low, interval->high));
}

std::string boundary_lines(const eval::SceneEvaluation& all) {
  const eval::StationCounts stations = eval::pooled(all.stations);
  const eval::LateralSummary lateral = eval::summarise(all.lateral);
  std::string text = "\n";
  text += line("stations", fmt::format("precision {}, inside the truth {}, recall {}, mean difference {} m",
                                       text_of(stations.precision()), text_of(stations.precision_inside()),
                                       text_of(stations.recall()), text_of(stations.mean_error_m())));
  text += line("lateral error", fmt::format("median {} m (+ = outward), RMSE {} m, 95 % of sizes {} m",
                                            text_of(lateral.median_m), text_of(lateral.rmse_m),
                                            text_of(lateral.percentile_95_m)));
  text += line("heading error", fmt::format("mean {} deg, 95 % {} deg", degrees(lateral.mean_heading_rad),
                                            degrees(lateral.percentile_95_heading_rad)));
  text += line("line distance", fmt::format("Hausdorff 95 % {} m, Chamfer {} m (means of the scans)",
                                            text_of(mean(all.hausdorff_95_m)), text_of(mean(all.chamfer_m))));
  text += line("detection range", fmt::format("{} m", text_of(eval::detection_range_m(all.by_range))));
  text += success_line("success, straight", all.straight);
  text += success_line("success, curve", all.curve);
  return text;
}

bool has_corners(const eval::CornerScore& corners) {
  return corners.true_corners + corners.false_presented + corners.reports > 0;
}

std::string corner_lines(const eval::CornerScore& corners) {
  if (!has_corners(corners)) return {};
  return line("corners",
              fmt::format("M1 {} ({} of {}), M2 {} ({} of {} false ones), false reports {} ({} of {})",
                          text_of(corners.m1()), corners.detected, corners.true_corners,
                          text_of(corners.m2()), corners.false_reported, corners.false_presented,
                          text_of(corners.false_discovery_rate()), corners.false_reports, corners.reports)) +
         line("",
              fmt::format("median latency {} scans, {} m, {} m ahead ({} late); median position error {} m",
                          text_of(median(corners.latency_scans)), text_of(median(corners.latency_m)),
                          text_of(median(corners.ahead_m)), corners.late,
                          text_of(median(corners.position_error_m))));
}

/// Whether any scan has a junction, true or predicted.
bool has_junctions(const eval::JunctionScore& junctions) {
  eval::JunctionScore none;
  none.confusion.at(eval::JunctionScore::kNone).at(eval::JunctionScore::kNone) =
      junctions.confusion.at(eval::JunctionScore::kNone).at(eval::JunctionScore::kNone);
  return junctions.confusion != none.confusion;
}

std::string junction_lines(const eval::JunctionScore& junctions) {
  if (!has_junctions(junctions)) return {};
  return line(
      "junctions",
      fmt::format("type accuracy {}, macro F1 {}, branch count {}, branch angle {} deg, center {} "
                  "m, to {} m",
                  text_of(junctions.type_accuracy()), text_of(junctions.macro_f1()),
                  text_of(junctions.branch_count_accuracy()), degrees(mean(junctions.branch_error_rad)),
                  text_of(mean(junctions.center_error_m)), text_of(junctions.detection_distance_m())));
}

std::string object_lines(const eval::ObjectScore& objects) {
  if (objects.predicted + objects.truth == 0) return {};
  std::string text = line(
      "objects",
      fmt::format("precision {}, recall {}, {} over- and {} under-segmented, heading {} deg, corners {} m",
                  text_of(objects.precision()), text_of(objects.recall()), objects.over_segmented,
                  objects.under_segmented, degrees(mean(objects.heading_error_rad)),
                  text_of(mean(objects.corner_error_m))));
  std::string classes;
  for (std::size_t i = 0; i < eval::ObjectScore::kClasses; ++i) {
    const auto type = static_cast<ObjectClass>(i);
    if (const auto f1 = objects.class_f1(type)) classes += fmt::format(" {} {:.3f}", name_of(type), *f1);
  }
  return text + line("", "F1 by class:" + classes);
}

ordered_json bins_json(const eval::RangeBins& bins) {
  ordered_json json = ordered_json::array();
  for (std::size_t i = 0; i < bins.bins.size(); ++i) {
    ordered_json entry = {{"from_m", static_cast<double>(i) * bins.width_m},
                          {"to_m", static_cast<double>(i + 1) * bins.width_m}};
    entry.update(ordered_json::parse(study::counts_json(bins.bins[i])));
    json.push_back(std::move(entry));
  }
  return json;
}

ordered_json station_json(const eval::StationCounts& counts) {
  return {{"both_absent", counts.both_absent},
          {"missed", counts.missed},
          {"extra", counts.extra},
          {"right", counts.right},
          {"wrong", counts.wrong},
          {"precision", figure(counts.precision())},
          {"precision_inside", figure(counts.precision_inside())},
          {"recall", figure(counts.recall())},
          {"mean_error_m", figure(counts.mean_error_m())}};
}

ordered_json stations_json(const std::vector<eval::StationCounts>& stations) {
  ordered_json json = {{"all", station_json(eval::pooled(stations))}, {"each", ordered_json::array()}};
  for (std::size_t i = 0; i < stations.size(); ++i) {
    ordered_json entry = {{"x_m", figure(static_cast<double>(i) * eval::StationConfig{}.step_m)}};
    entry.update(station_json(stations[i]));
    json["each"].push_back(std::move(entry));
  }
  return json;
}

ordered_json lateral_json(const eval::LateralSummary& lateral) {
  return {{"samples", lateral.samples},
          {"median_m", figure(lateral.median_m)},
          {"rmse_m", figure(lateral.rmse_m)},
          {"percentile_95_m", figure(lateral.percentile_95_m)},
          {"mean_heading_rad", figure(lateral.mean_heading_rad)},
          {"percentile_95_heading_rad", figure(lateral.percentile_95_heading_rad)}};
}

ordered_json all_lateral_json(const std::vector<eval::LateralError>& errors) {
  ordered_json json = lateral_json(eval::summarise(errors));
  json["by_range"] = ordered_json::array();
  for (const eval::LateralSummary& bin : eval::summarise_by_range(errors, kLateralBin_m))
    json["by_range"].push_back(lateral_json(bin));
  return json;
}

ordered_json success_json(const eval::SuccessCounts& counts) {
  const auto interval = eval::wilson_interval(counts.successes(), counts.scans());
  ordered_json json = {{"scans", counts.scans()},
                       {"minimum", counts.minimum},
                       {"larger", counts.larger},
                       {"failed", counts.failed}};
  if (interval) json["share"] = {figure(interval->share), figure(interval->low), figure(interval->high)};
  return json;
}

ordered_json corners_json(const eval::CornerScore& corners) {
  return {{"true_corners", corners.true_corners},
          {"detected", corners.detected},
          {"late", corners.late},
          {"false_presented", corners.false_presented},
          {"false_reported", corners.false_reported},
          {"reports", corners.reports},
          {"false_reports", corners.false_reports},
          {"m1", figure(corners.m1())},
          {"m2", figure(corners.m2())},
          {"false_discovery_rate", figure(corners.false_discovery_rate())},
          {"median_latency_scans", figure(median(corners.latency_scans))},
          {"median_latency_m", figure(median(corners.latency_m))},
          {"median_ahead_m", figure(median(corners.ahead_m))},
          {"median_position_error_m", figure(median(corners.position_error_m))}};
}

ordered_json junctions_json(const eval::JunctionScore& junctions) {
  return {{"confusion", junctions.confusion},
          {"type_accuracy", figure(junctions.type_accuracy())},
          {"macro_f1", figure(junctions.macro_f1())},
          {"branch_count_accuracy", figure(junctions.branch_count_accuracy())},
          {"mean_branch_error_rad", figure(mean(junctions.branch_error_rad))},
          {"mean_center_error_m", figure(mean(junctions.center_error_m))},
          {"detection_distance_m", figure(junctions.detection_distance_m())}};
}

ordered_json boxes_json(const eval::BoxScore& boxes) {
  return {{"truth", boxes.truth},
          {"mean_overlap", figure(mean(boxes.overlap))},
          {"share_above_0.7", figure(boxes.share_above(0.7))},
          {"percentile_95_heading_error_rad", figure(percentile(boxes.heading_error_rad, 95.0))}};
}

ordered_json objects_json(const eval::ObjectScore& objects) {
  ordered_json json = {
      {"predicted", objects.predicted},
      {"truth", objects.truth},
      {"matched", objects.matched},
      {"precision", figure(objects.precision())},
      {"recall", figure(objects.recall())},
      {"over_segmented", objects.over_segmented},
      {"under_segmented", objects.under_segmented},
      {"mean_heading_error_rad", figure(mean(objects.heading_error_rad))},
      {"percentile_95_heading_error_rad", figure(percentile(objects.heading_error_rad, 95.0))},
      {"mean_corner_error_m", figure(mean(objects.corner_error_m))},
      {"cars", boxes_json(objects.cars)},
      {"two_faced_cars", boxes_json(objects.two_faced_cars)}};
  for (std::size_t i = 0; i < eval::ObjectScore::kClasses; ++i) {
    json["classes"][std::string(enum_names<ObjectClass>.at(i))] = {
        {"predicted", objects.class_predicted.at(i)},
        {"truth", objects.class_truth.at(i)},
        {"matched", objects.class_matched.at(i)},
        {"f1", figure(objects.class_f1(static_cast<ObjectClass>(i)))}};
  }
  return json;
}

}  // namespace

ordered_json figure(const std::optional<double>& value) {
  return ordered_json::parse(study::figure_json(value));
}

std::string metric_tables(const TruthEvaluation& evaluation) {
  const eval::SceneEvaluation& all = evaluation.all;
  return tolerance_tables(evaluation) + boundary_lines(all) + corner_lines(evaluation.corners) +
         junction_lines(all.junctions) + object_lines(all.objects);
}

ordered_json metrics_json(const TruthEvaluation& evaluation) {
  const eval::SceneEvaluation& all = evaluation.all;
  ordered_json json = {
      {"scans", all.scans},
      {"absent", all.absent},
      {"tolerance", ordered_json::parse(study::cells_json(all.cells))},
      {"by_range", bins_json(all.by_range)},
      {"detection_range_m", figure(eval::detection_range_m(all.by_range))},
      {"by_confidence", ordered_json::parse(study::confidence_json(all.by_confidence))},
      {"stations", stations_json(all.stations)},
      {"lateral", all_lateral_json(all.lateral)},
      {"mean_hausdorff_95_m", figure(mean(all.hausdorff_95_m))},
      {"mean_chamfer_m", figure(mean(all.chamfer_m))},
      {"success", {{"straight", success_json(all.straight)}, {"curve", success_json(all.curve)}}}};
  if (has_corners(evaluation.corners)) json["corners"] = corners_json(evaluation.corners);
  if (has_junctions(all.junctions)) json["junctions"] = junctions_json(all.junctions);
  if (all.objects.predicted + all.objects.truth > 0) json["objects"] = objects_json(all.objects);
  return json;
}

}  // namespace verge::app

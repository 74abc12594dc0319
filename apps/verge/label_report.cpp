// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/label_report.hpp"

#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/verge/csv_text.hpp"
#include "apps/verge/metric_report.hpp"
#include "verge/core/error.hpp"

namespace verge::app {
namespace {

using nlohmann::ordered_json;

std::string share_text(const std::optional<double>& share) {
  return share ? fmt::format("{:.3f}", *share) : std::string("-");
}

std::string frame_rows(const LabelEvaluation& evaluation) {
  std::string text = fmt::format("{:<24}{:>8}{:>8}", "scan", "true", "kerb");
  for (const double tolerance_m : evaluation.config.tolerance_m)
    text += fmt::format("{:>10}", fmt::format("F1@{:g}", tolerance_m));
  text += '\n';
  for (const LabelEvaluation::Scan& scan : evaluation.scans) {
    text += fmt::format("{:<24}{:>8}{:>8}", escape_control_bytes(scan.frame), scan.score.true_points,
                        scan.score.kerb_points);
    for (const eval::ToleranceScore& at : scan.score.at)
      text += fmt::format("{:>10.3f}", eval::figures_of(scan.score, at).f1);
    text += '\n';
  }
  return text + '\n';
}

ordered_json tolerance_json(const eval::LabelScore& score, const eval::ToleranceScore& at) {
  const eval::LabelFigures figures = eval::figures_of(score, at);
  return {{"tolerance_m", at.tolerance_m},
          {"precision", figure(figures.precision)},
          {"recall", figure(figures.recall)},
          {"f1", figure(figures.f1)},
          {"macro_f1", figure(figures.macro_f1)},
          {"kerb_recall", figure(figures.kerb_recall)},
          {"rmse_m", figure(figures.rmse_m)},
          {"judged_share", figure(figures.judged)},
          {"found", at.found},
          {"found_kerbs", at.found_kerbs},
          {"judged", at.judged},
          {"right", at.right}};
}

ordered_json score_json(const eval::LabelScore& score) {
  ordered_json json = {{"true_points", score.true_points},
                       {"kerb_points", score.kerb_points},
                       {"samples", score.samples},
                       {"tolerances", ordered_json::array()}};
  for (const eval::ToleranceScore& at : score.at) json["tolerances"].push_back(tolerance_json(score, at));
  return json;
}

std::string csv_rows(std::string_view scope, std::string_view frame, const eval::LabelScore& score) {
  std::string rows;
  for (const eval::ToleranceScore& at : score.at) {
    const eval::LabelFigures figures = eval::figures_of(score, at);
    rows +=
        csv_row({std::string(scope), std::string(frame), fmt::format("{:g}", at.tolerance_m),
                 fmt::to_string(score.scans), fmt::to_string(score.absent), fmt::to_string(score.true_points),
                 fmt::to_string(score.kerb_points), fmt::to_string(score.samples), fmt::to_string(at.found),
                 fmt::to_string(at.found_kerbs), fmt::to_string(at.judged), fmt::to_string(at.right),
                 fmt::format("{:.6f}", figures.precision), fmt::format("{:.6f}", figures.recall),
                 fmt::format("{:.6f}", figures.f1), fmt::format("{:.6f}", figures.macro_f1),
                 figures.kerb_recall ? fmt::format("{:.6f}", *figures.kerb_recall) : std::string(),
                 fmt::format("{:.6f}", figures.rmse_m), fmt::format("{:.6f}", figures.judged)});
  }
  return rows;
}

}  // namespace

std::string label_table(const LabelEvaluation& evaluation, bool per_frame) {
  const eval::LabelScore& all = evaluation.all;
  std::string text = per_frame ? frame_rows(evaluation) : std::string();
  text += fmt::format(
      "Boundaries within {:g} m of the sensor against labels: {} scans ({} without a prediction), {} true "
      "points,\n"
      "{} of them on kerbs of 5 cm or more. F1 over all scans together, macro F1 the mean of the scans' "
      "own.\n\n"
      "{:>9}{:>11}{:>9}{:>9}{:>10}{:>13}{:>9}{:>9}\n",
      evaluation.config.range_m, all.scans, all.absent, all.true_points, all.kerb_points, "tolerance",
      "precision", "recall", "F1", "macro F1", "kerb recall", "RMSE", "judged");
  for (const eval::ToleranceScore& at : all.at) {
    const eval::LabelFigures figures = eval::figures_of(all, at);
    text += fmt::format("{:>9g}{:>11.3f}{:>9.3f}{:>9.3f}{:>10.3f}{:>13}{:>9.3f}{:>9.3f}\n", at.tolerance_m,
                        figures.precision, figures.recall, figures.f1, figures.macro_f1,
                        share_text(figures.kerb_recall), figures.rmse_m, figures.judged);
  }
  return text;
}

std::string label_json(const LabelEvaluation& evaluation) {
  ordered_json json = {{"range_m", evaluation.config.range_m},
                       {"gap_m", evaluation.gap_m},
                       {"scans", evaluation.all.scans},
                       {"absent", evaluation.all.absent}};
  json.update(score_json(evaluation.all));
  json["frames"] = ordered_json::array();
  for (const LabelEvaluation::Scan& scan : evaluation.scans) {
    ordered_json frame = {{"frame", scan.frame}, {"predicted", scan.score.absent == 0}};
    frame.update(score_json(scan.score));
    json["frames"].push_back(frame);
  }
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string label_csv(const LabelEvaluation& evaluation) {
  std::string text =
      csv_row({"scope", "frame", "tolerance_m", "scans", "absent", "true_points", "kerb_points", "samples",
               "found", "found_kerbs", "judged", "right", "precision", "recall", "f1", "macro_f1",
               "kerb_recall", "rmse_m", "judged_share"});
  text += csv_rows("all", {}, evaluation.all);
  for (const LabelEvaluation::Scan& scan : evaluation.scans) text += csv_rows("scan", scan.frame, scan.score);
  return text;
}

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/ground_report.hpp"

#include <cmath>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/verge/csv_text.hpp"
#include "apps/verge/metric_report.hpp"
#include "verge/core/error.hpp"

namespace verge::app {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kProtocols = enum_names<eval::GroundProtocol>.size();

std::string_view protocol_name(std::size_t i) { return enum_names<eval::GroundProtocol>.at(i); }

std::string text_of(const std::optional<double>& figure) {
  return figure ? fmt::format("{:.3f}", *figure) : std::string("-");
}

std::string cell(const std::optional<double>& figure) {
  return figure ? fmt::format("{:.6f}", *figure) : std::string();
}

std::string frame_rows(const GroundEvaluation& evaluation) {
  std::string text = fmt::format("{:<24}", "scan");
  for (std::size_t i = 0; i < kProtocols; ++i)
    text += fmt::format("{:>15}", fmt::format("F1 {}", protocol_name(i)));
  text += fmt::format("{:>15}\n", "height RMSE m");
  for (const GroundEvaluation::Scan& scan : evaluation.scans) {
    text += fmt::format("{:<24}", escape_control_bytes(scan.frame));
    for (const eval::ProtocolScore& score : scan.score.protocols)
      text += fmt::format("{:>15}", text_of(score.counts.f1()));
    text += fmt::format("{:>15}\n", text_of(scan.score.heights.rmse_m()));
  }
  return text + '\n';
}

std::string heading(const GroundEvaluation& evaluation) {
  const std::string where = std::isfinite(evaluation.config.range_m)
                                ? fmt::format(" within {:g} m of the sensor", evaluation.config.range_m)
                                : std::string();
  const std::string how = evaluation.plane ? fmt::format("points within {:g} m of the road's plane",
                                                         evaluation.plane->tolerance_m)
                                           : std::string("the classes of label files");
  return fmt::format(
      "Ground{} by {}, against labels: {} scans ({} without a prediction).\n"
      "Figures of all points together, and (macro) the means of the scans' own.\n\n",
      where, how, evaluation.all.scans, evaluation.all.absent);
}

std::string protocol_row(std::string_view name, const eval::ProtocolScore& score) {
  const eval::GroundCounts& counts = score.counts;
  return fmt::format("{:<13}{:>10}{:>11}{:>9}{:>9}{:>9}{:>10}{:>11}{:>9}{:>9}\n", name, counts.points(),
                     text_of(counts.precision()), text_of(counts.recall()), text_of(counts.f1()),
                     text_of(counts.iou()), text_of(counts.accuracy()), text_of(score.precision.value()),
                     text_of(score.recall.value()), text_of(score.f1.value()));
}

std::string height_line(const eval::HeightErrors& heights) {
  if (heights.points == 0) return {};
  return fmt::format("\nheight of the ground: RMSE {} m, mean {} m (+ = too high) over {} points\n",
                     text_of(heights.rmse_m()), text_of(heights.mean_m()), heights.points);
}

ordered_json score_json(const eval::GroundScore& score) {
  ordered_json json;
  for (std::size_t i = 0; i < kProtocols; ++i) {
    const eval::ProtocolScore& protocol = score.protocols.at(i);
    const eval::GroundCounts& counts = protocol.counts;
    json["protocols"][std::string(protocol_name(i))] = {
        {"true_ground", counts.true_ground},
        {"false_ground", counts.false_ground},
        {"missed_ground", counts.missed_ground},
        {"true_other", counts.true_other},
        {"precision", figure(counts.precision())},
        {"recall", figure(counts.recall())},
        {"f1", figure(counts.f1())},
        {"iou", figure(counts.iou())},
        {"accuracy", figure(counts.accuracy())},
        {"macro_precision", figure(protocol.precision.value())},
        {"macro_recall", figure(protocol.recall.value())},
        {"macro_f1", figure(protocol.f1.value())}};
  }
  json["height"] = {{"points", score.heights.points},
                    {"mean_m", figure(score.heights.mean_m())},
                    {"rmse_m", figure(score.heights.rmse_m())}};
  return json;
}

std::string csv_rows(std::string_view scope, std::string_view frame, const eval::GroundScore& score) {
  std::string rows;
  for (std::size_t i = 0; i < kProtocols; ++i) {
    const eval::ProtocolScore& protocol = score.protocols.at(i);
    const eval::GroundCounts& counts = protocol.counts;
    rows += csv_row({std::string(scope),
                     std::string(frame),
                     std::string(protocol_name(i)),
                     fmt::to_string(score.scans),
                     fmt::to_string(score.absent),
                     fmt::to_string(counts.true_ground),
                     fmt::to_string(counts.false_ground),
                     fmt::to_string(counts.missed_ground),
                     fmt::to_string(counts.true_other),
                     cell(counts.precision()),
                     cell(counts.recall()),
                     cell(counts.f1()),
                     cell(counts.iou()),
                     cell(counts.accuracy()),
                     cell(protocol.precision.value()),
                     cell(protocol.recall.value()),
                     cell(protocol.f1.value()),
                     fmt::to_string(score.heights.points),
                     cell(score.heights.mean_m()),
                     cell(score.heights.rmse_m())});
  }
  return rows;
}

}  // namespace

std::string ground_table(const GroundEvaluation& evaluation, bool per_frame) {
  std::string text = per_frame ? frame_rows(evaluation) : std::string();
  text += heading(evaluation);
  text += fmt::format("{:<13}{:>10}{:>11}{:>9}{:>9}{:>9}{:>10}{:>11}{:>9}{:>9}\n", "protocol", "points",
                      "precision", "recall", "F1", "IoU", "accuracy", "macro prec", "recall", "F1");
  for (std::size_t i = 0; i < kProtocols; ++i)
    text += protocol_row(protocol_name(i), evaluation.all.protocols.at(i));
  return text + height_line(evaluation.all.heights);
}

std::string ground_json(const GroundEvaluation& evaluation) {
  ordered_json json = {{"range_m", figure(evaluation.config.range_m)},
                       {"low_vegetation_z_m", evaluation.config.low_vegetation_z_m},
                       {"plane_tolerance_m", nullptr},
                       {"scans", evaluation.all.scans},
                       {"absent", evaluation.all.absent}};
  if (evaluation.plane) json["plane_tolerance_m"] = figure(evaluation.plane->tolerance_m);
  json.update(score_json(evaluation.all));
  json["frames"] = ordered_json::array();
  for (const GroundEvaluation::Scan& scan : evaluation.scans) {
    ordered_json frame = {{"frame", scan.frame}, {"predicted", scan.score.absent == 0}};
    frame.update(score_json(scan.score));
    json["frames"].push_back(std::move(frame));
  }
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string ground_csv(const GroundEvaluation& evaluation) {
  std::string text =
      csv_row({"scope",        "frame",        "protocol",      "scans",         "absent",
               "true_ground",  "false_ground", "missed_ground", "true_other",    "precision",
               "recall",       "f1",           "iou",           "accuracy",      "macro_precision",
               "macro_recall", "macro_f1",     "height_points", "height_mean_m", "height_rmse_m"});
  text += csv_rows("all", {}, evaluation.all);
  for (const GroundEvaluation::Scan& scan : evaluation.scans)
    text += csv_rows("scan", scan.frame, scan.score);
  return text;
}

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/figures.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "verge/core/angle.hpp"
#include "verge/core/statistics.hpp"
#include "verge/eval/share.hpp"

namespace verge::study {
namespace {

using Value = std::optional<double>;

Value number(std::size_t count) { return static_cast<double>(count); }

Value degrees(Value rad) { return rad ? Value(rad_to_deg(*rad)) : std::nullopt; }

Value success_of(const eval::SuccessCounts& counts) {
  return eval::share_of(counts.successes(), counts.scans());
}

/// Collects figures; those that cannot be said get no value.
class Collector {
 public:
  explicit Collector(Figures& figures, bool said = true) : figures_(figures), said_(said) {}
  void operator()(std::string name, Value value) {
    figures_.push_back({std::move(name), said_ ? value : std::nullopt});
  }

 private:
  Figures& figures_;
  bool said_;
};

void add_tolerances(const Suite& suite, const Tally& tally, Collector& add) {
  const eval::ToleranceCell* headline = headline_of(suite, tally);
  const eval::ToleranceCounts counts = headline != nullptr ? headline->counts : eval::ToleranceCounts{};
  add("precision", counts.precision());
  add("recall", counts.recall());
  add("occluded_recall", counts.occluded_recall());
  add("occluded_share", eval::share_of(counts.occluded, counts.visible + counts.occluded));
  add("f1", counts.f1());
  add("macro_f1", headline != nullptr ? headline->macro_f1() : std::nullopt);
  for (const eval::ToleranceCell& cell : tally.cells) {
    if (cell.range_m == suite.evaluation.range_m)
      add(fmt::format("f1_at_{:g}_m", cell.tolerance_m), cell.counts.f1());
  }
}

void add_success(const eval::SuccessCounts& all, Collector& add) {
  const auto interval = eval::wilson_interval(all.successes(), all.scans());
  add("frames", number(all.scans()));
  add("success", success_of(all));
  add("success_low", interval ? Value(interval->low) : std::nullopt);
  add("success_high", interval ? Value(interval->high) : std::nullopt);
  add("minimum", number(all.minimum));
  add("larger", number(all.larger));
  add("failed", number(all.failed));
}

void add_success_by_shape(const Tally& tally, Collector& add) {
  eval::SuccessCounts all = tally.straight;
  all += tally.curve;
  add_success(all, add);
  add("success_straight", success_of(tally.straight));
  add("success_curve", success_of(tally.curve));
}

void add_lines(const Tally& tally, Collector& add) {
  const Histogram sizes = tally.lateral_m.sizes();
  add("lateral_median_m", tally.lateral_m.percentile(50.0));
  add("lateral_rmse_m", sizes.root_mean_square());
  add("lateral_p95_m", sizes.percentile(95.0));
  const Histogram headings = tally.heading_rad.sizes();
  add("heading_mean_deg", degrees(headings.mean()));
  add("heading_p95_deg", degrees(headings.percentile(95.0)));
  add("detection_range_m", eval::detection_range_m(tally.by_range));
  add("stations_precision", tally.stations.precision());
  add("stations_precision_inside", tally.stations.precision_inside());
  add("stations_recall", tally.stations.recall());
  add("stations_mean_error_m", tally.stations.mean_error_m());
}

void add_corners(const eval::CornerScore& corners, Figures& figures, bool said) {
  Collector known(figures);
  known("true_corners", number(corners.true_corners));
  known("false_presented", number(corners.false_presented));
  known("way_km", 0.001 * corners.way_m);
  Collector add(figures, said);
  add("detected", number(corners.detected));
  add("m1", corners.m1());
  add("late", number(corners.late));
  add("false_reported", number(corners.false_reported));
  add("m2", corners.m2());
  add("reports", number(corners.reports));
  add("false_reports", number(corners.false_reports));
  add("false_discovery_rate", corners.false_discovery_rate());
  add("false_reports_a_km", corners.false_reports_a_km());
  add("latency_scans", median(corners.latency_scans));
  add("latency_m", median(corners.latency_m));
  add("ahead_m", median(corners.ahead_m));
  add("position_error_m", median(corners.position_error_m));
  add("position_error_p95_m", percentile(corners.position_error_m, 95.0));
}

void add_boxes(std::string_view name, const eval::BoxScore& boxes, Collector& add) {
  constexpr double kGood = 0.7;
  add(fmt::format("{}_iou", name), mean(boxes.overlap));
  add(fmt::format("{}_iou_above_{:g}", name, kGood), boxes.share_above(kGood));
  add(fmt::format("{}_heading_p95_deg", name), degrees(percentile(boxes.heading_error_rad, 95.0)));
}

/// `judged`: whether there is truth of objects; `said`: whether the contestant reports any.
void add_objects(const eval::ObjectScore& objects, Figures& figures, bool judged, bool said) {
  Collector known(figures, judged);
  known("objects_true", number(objects.truth));
  known("cars_true", number(objects.cars.truth));
  known("two_faced_cars_true", number(objects.two_faced_cars.truth));
  Collector add(figures, judged && said);
  add("objects_predicted", number(objects.predicted));
  add("objects_precision", objects.precision());
  add("objects_recall", objects.recall());
  add("objects_iou", mean(objects.overlap));
  add("objects_heading_mean_deg", degrees(mean(objects.heading_error_rad)));
  add("objects_heading_p95_deg", degrees(percentile(objects.heading_error_rad, 95.0)));
  add("objects_corner_error_m", mean(objects.corner_error_m));
  add_boxes("cars", objects.cars, add);
  add_boxes("two_faced_cars", objects.two_faced_cars, add);
  add("car_f1", objects.class_f1(ObjectClass::kCar));
  add("person_f1", objects.class_f1(ObjectClass::kPerson));
}

void add_labels(const Suite& suite, const eval::LabelScore& labels, Collector& add) {
  const auto headline =
      std::ranges::find(labels.at, suite.label_tolerance_m, &eval::ToleranceScore::tolerance_m);
  const bool has_any = headline != labels.at.end();
  const eval::LabelFigures figures = has_any ? eval::figures_of(labels, *headline) : eval::LabelFigures{};
  const auto of_any = [has_any](double value) { return has_any ? Value(value) : std::nullopt; };
  add("true_points", number(labels.true_points));
  add("kerb_points", number(labels.kerb_points));
  add("precision", of_any(figures.precision));
  add("recall", of_any(figures.recall));
  add("f1", of_any(figures.f1));
  add("macro_f1", of_any(figures.macro_f1));
  add("kerb_recall", figures.kerb_recall);
  add("rmse_m", of_any(figures.rmse_m));
  add("judged", of_any(figures.judged));
  for (const eval::ToleranceScore& at : labels.at)
    add(fmt::format("f1_at_{:g}_m", at.tolerance_m), eval::figures_of(labels, at).f1);
}

}  // namespace

Figures figures_of(const Suite& suite, const Contestant& contestant, const Tally& tally) {
  Figures figures;
  Collector add(figures);
  add("scans", number(tally.scans));
  add("absent", number(tally.absent));
  add("damaged", number(tally.damaged));
  if (std::ranges::any_of(suite.cells, is_labelled)) {
    add_labels(suite, tally.labels, add);
    add_success(tally.labelled, add);
    const bool has_boxes = tally.labels.scans < tally.scans;
    if (suite.judged.objects) add_objects(tally.objects, figures, has_boxes, contestant.says.objects);
    return figures;
  }
  if (suite.judged.boundaries) {
    add_tolerances(suite, tally, add);
    add_success_by_shape(tally, add);
    add_lines(tally, add);
  }
  if (suite.judged.corners) add_corners(tally.corners, figures, contestant.says.corners);
  if (suite.judged.objects) add_objects(tally.objects, figures, true, contestant.says.objects);
  return figures;
}

Figures times_of(const Tally& tally) {
  const auto ms = [&](double percent) {
    const auto seconds = tally.seconds.percentile(percent);
    return seconds ? Value(1000.0 * *seconds) : std::nullopt;
  };
  return {{"median_ms", ms(50.0)}, {"p95_ms", ms(95.0)}, {"p99_ms", ms(99.0)}, {"greatest_ms", ms(100.0)}};
}

std::optional<double> value_of(const Figures& figures, std::string_view name) {
  const auto found = std::ranges::find(figures, name, &Figure::name);
  return found == figures.end() ? std::nullopt : found->value;
}

const eval::ToleranceCell* headline_of(const Suite& suite, const Tally& tally) {
  const auto found = std::ranges::find_if(tally.cells, [&](const eval::ToleranceCell& cell) {
    return cell.range_m == suite.evaluation.range_m && cell.tolerance_m == suite.evaluation.tolerance_m;
  });
  return found == tally.cells.end() ? nullptr : &*found;
}

bool is_labelled(const Cell& cell) { return std::holds_alternative<LabelledScans>(cell.scans); }

}  // namespace verge::study

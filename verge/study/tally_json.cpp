// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/tally_json.hpp"

#include <cstdint>
#include <utility>

#include <nlohmann/json.hpp>

// Found by the library in the types' own namespaces.

namespace verge::eval {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToleranceCounts, predicted, right, visible, found_visible, occluded,
                                   found_occluded)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToleranceCell, range_m, tolerance_m, counts, f1_sum, scans_with_f1)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RangeBins, width_m, bins)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ConfidencePoint, least_confidence, counts)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StationCounts, both_absent, missed, extra, right, wrong, error_sum_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SuccessCounts, minimum, larger, failed)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoxScore, truth, heading_error_rad, overlap)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ObjectScore, predicted, truth, matched, over_segmented, under_segmented,
                                   heading_error_rad, corner_error_m, overlap, cars, two_faced_cars,
                                   class_predicted, class_truth, class_matched)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CornerScore, true_corners, detected, late, false_presented, false_reported,
                                   reports, false_reports, latency_scans, latency_m, ahead_m,
                                   position_error_m, way_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToleranceScore, tolerance_m, found, found_kerbs, judged, right, squared_m2,
                                   f1_sum)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LabelScore, scans, absent, true_points, kerb_points, samples, at)
}  // namespace verge::eval

namespace verge::study {
namespace {

using nlohmann::json;

}  // namespace

// Static, since lookup by argument passes an unnamed namespace over.
// NOLINTBEGIN(misc-use-anonymous-namespace)
static void to_json(json& out, const Histogram& histogram) {
  out = {{"step", histogram.step()}, {"bins", json::array()}};
  for (const auto& [bin, count] : histogram.bins()) out["bins"].push_back({bin, count});
}

static void from_json(const json& in, Histogram& histogram) {
  Histogram::Bins bins;
  for (const json& pair : in.at("bins"))
    bins[pair.at(0).get<std::int64_t>()] = pair.at(1).get<std::uint64_t>();
  histogram = Histogram(in.at("step").get<double>(), std::move(bins));
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ScanScore, f1, drive, scan, frame)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Tally, scans, absent, damaged, cells, by_range, by_confidence, stations,
                                   straight, curve, lateral_m, lateral_by_range_m, heading_rad, objects,
                                   corners, labels, labelled, seconds, poorest)
// NOLINTEND(misc-use-anonymous-namespace)

std::string to_json(const Tally& tally) {
  return json(tally).dump(-1, ' ', false, json::error_handler_t::replace);
}

Expected<Tally> parse_tally(std::string_view text) {
  try {
    return json::parse(text).get<Tally>();
  } catch (const json::exception& error) {
    return Unexpected(Error{ErrorCode::kUnusable, {}, {}, error.what(), {}, {}});
  }
}

}  // namespace verge::study

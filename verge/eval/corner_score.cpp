// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/corner_score.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "verge/eval/share.hpp"

namespace verge::eval {
namespace {

bool agree(CornerSide a, CornerSide b) { return a == b || a == CornerSide::kBoth || b == CornerSide::kBoth; }

bool is_false(const Corner& corner) { return corner.confidence == 0.0; }

/// The distance of the nearest corner of the scene that agrees with `corner`; none within near_m.
std::optional<double> nearest_agreeing(const Corner& corner, const Scene* scene, double near_m) {
  double least = std::numeric_limits<double>::infinity();
  if (scene != nullptr) {
    for (const Corner& other : scene->corners) {
      if (agree(corner.side, other.side)) least = std::min(least, distance(corner.position, other.position));
    }
  }
  return least <= near_m ? std::optional(least) : std::nullopt;
}

double distance_of(const Corner& corner) { return corner.distance_m.value_or(norm(corner.position)); }

/// A corner of the truth over the scans that have it.
struct Event {
  bool false_corner = false;
  std::size_t first_scan = 0;
  double first_distance_m = 0.0;
  bool detected = false;
};

void follow_event(const Corner& corner, std::size_t scan, const Scene* prediction, double near_m,
                  std::map<int, Event>& events, CornerScore& score) {
  const auto [found, is_new] =
      events.try_emplace(corner.id, Event{is_false(corner), scan, distance_of(corner), false});
  Event& event = found->second;
  if (is_new) ++(event.false_corner ? score.false_presented : score.true_corners);
  const auto error_m = nearest_agreeing(corner, prediction, near_m);
  if (event.detected || !error_m) return;
  event.detected = true;
  ++(event.false_corner ? score.false_reported : score.detected);
  if (event.false_corner) return;
  score.latency_scans.push_back(static_cast<double>(scan - event.first_scan));
  score.latency_m.push_back(event.first_distance_m - distance_of(corner));
  score.ahead_m.push_back(distance_of(corner));
  score.late += distance_of(corner) < 0.0 ? 1U : 0U;
  score.position_error_m.push_back(*error_m);
}

/// An id of the prediction over scans without a gap.
struct Report {
  std::size_t last_scan = 0;
  bool right = false;
};

Scene true_corners_of(const Scene& truth) {
  Scene scene;
  for (const Corner& corner : truth.corners) {
    if (!is_false(corner)) scene.corners.push_back(corner);
  }
  return scene;
}

void end_report(const Report& report, CornerScore& score) {
  ++score.reports;
  score.false_reports += report.right ? 0U : 1U;
}

void follow_reports(const CornerFrame& frame, std::size_t scan, double near_m, std::map<int, Report>& reports,
                    CornerScore& score) {
  if (frame.prediction == nullptr) return;
  const Scene truth = true_corners_of(*frame.truth);
  for (const Corner& corner : frame.prediction->corners) {
    const auto [found, is_new] = reports.try_emplace(corner.id, Report{scan, false});
    Report& report = found->second;
    if (!is_new && report.last_scan + 1 < scan) {
      end_report(report, score);
      report = Report{};
    }
    report.last_scan = scan;
    report.right = report.right || nearest_agreeing(corner, &truth, near_m).has_value();
  }
}

double way_between(const CornerFrame& a, const CornerFrame& b) {
  return a.place && b.place ? distance(*a.place, *b.place) : 0.0;
}

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

CornerScore& CornerScore::operator+=(const CornerScore& more) {
  true_corners += more.true_corners;
  detected += more.detected;
  late += more.late;
  false_presented += more.false_presented;
  false_reported += more.false_reported;
  reports += more.reports;
  false_reports += more.false_reports;
  append(latency_scans, more.latency_scans);
  append(latency_m, more.latency_m);
  append(ahead_m, more.ahead_m);
  append(position_error_m, more.position_error_m);
  way_m += more.way_m;
  return *this;
}

std::optional<double> CornerScore::m1() const { return share_of(detected, true_corners); }
std::optional<double> CornerScore::m2() const { return share_of(false_reported, false_presented); }
std::optional<double> CornerScore::false_discovery_rate() const { return share_of(false_reports, reports); }
std::optional<double> CornerScore::false_reports_a_km() const {
  if (!(way_m > 0.0)) return std::nullopt;
  return 1000.0 * static_cast<double>(false_reports) / way_m;
}

CornerScore score_corners(std::span<const CornerFrame> drive, double near_m) {
  CornerScore score;
  std::map<int, Event> events;
  std::map<int, Report> reports;
  for (std::size_t scan = 0; scan < drive.size(); ++scan) {
    const CornerFrame& frame = drive[scan];
    for (const Corner& corner : frame.truth->corners)
      follow_event(corner, scan, frame.prediction, near_m, events, score);
    follow_reports(frame, scan, near_m, reports, score);
    if (scan > 0) score.way_m += way_between(drive[scan - 1], frame);
  }
  for (const auto& [id, report] : reports) end_report(report, score);
  return score;
}

}  // namespace verge::eval

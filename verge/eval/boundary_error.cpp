// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/boundary_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "verge/core/polyline.hpp"
#include "verge/core/statistics.hpp"
#include "verge/core/vec.hpp"
#include "verge/eval/clip.hpp"
#include "verge/eval/sides.hpp"

namespace verge::eval {
namespace {

using Line = std::vector<Vec2>;

Line in_plane(const Boundary& boundary) {
  Line line;
  line.reserve(boundary.points.size());
  for (const Vec3& p : boundary.points) line.push_back(p.xy());
  return line;
}

// Distance of p from the nearest of the lines.
double distance_to_any(const std::vector<Line>& lines, Vec2 p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Line& line : lines) nearest = std::min(nearest, distance_to(line, p));
  return nearest;
}

// The boundaries that one of that side is compared with.
std::vector<Line> lines_for(Side side, const Scene& scene, bool any_side) {
  std::vector<Line> lines;
  lines.reserve(scene.boundaries.size());
  for (const Boundary& boundary : scene.boundaries) {
    if (any_side || goes_with(boundary.side, side)) lines.push_back(in_plane(boundary));
  }
  return lines;
}

// Distances of the samples of `from` within the range from the boundaries of `to`.
std::vector<double> distances(const Scene& from, const Scene& to, const BoundaryErrorConfig& config) {
  std::vector<double> out;
  for (const Boundary& boundary : from.boundaries) {
    const std::vector<Line> lines = lines_for(boundary.side, to, config.any_side);
    for (const Line& part : clip(in_plane(boundary), config.range_m)) {
      for (const Vec2 p : resample(part, config.step_m)) {
        out.push_back(distance_to_any(lines, p));
      }
    }
  }
  return out;
}

// Greatest distance of the line's points from the straight line through its ends.
double bow(const Line& line) {
  const Vec2 chord = line.back() - line.front();
  double greatest = 0.0;
  for (const Vec2 p : line) greatest = std::max(greatest, std::fabs(cross(chord, p - line.front())));
  return norm(chord) > 0.0 ? greatest / norm(chord) : 0.0;
}

using ByFrame = std::map<std::string_view, const Scene*>;

Expected<ByFrame> by_frame(std::span<const Scene> scenes, const std::string& whose) {
  ByFrame frames;
  for (const Scene& scene : scenes) {
    if (frames.emplace(scene.frame, &scene).second) continue;
    return Unexpected(Error{.code = ErrorCode::kUnusable,
                            .file = {},
                            .where = {},
                            .what = "a frame stands twice in the " + whose,
                            .got = scene.frame,
                            .need = {}});
  }
  return frames;
}

void check(const BoundaryErrorConfig& config) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!positive(config.range_m) || !positive(config.tolerance_m) || !positive(config.step_m)) {
    throw std::invalid_argument("range, tolerance and step of a comparison must be positive");
  }
}

std::optional<double> share_within(const std::vector<double>& values, double limit) {
  if (values.empty()) return std::nullopt;
  const auto count = std::count_if(values.begin(), values.end(), [=](double v) { return v <= limit; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

// As verge::percentile, of values that may be infinite: infinite where an infinite one has a part in it.
std::optional<double> percentile_of(std::vector<double> values, double percent) {
  if (values.empty()) return std::nullopt;
  double greatest_finite = 0.0;
  std::size_t finite = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    greatest_finite = std::max(greatest_finite, value);
    ++finite;
  }
  const double position = static_cast<double>(values.size() - 1) * percent / 100.0;
  if (std::ceil(position) >= static_cast<double>(finite)) return std::numeric_limits<double>::infinity();
  for (double& value : values) value = std::min(value, greatest_finite);  // above all that have a part
  return percentile(values, percent);
}

}  // namespace

BoundaryErrors compare(const Scene& prediction, const Scene& truth, const BoundaryErrorConfig& config) {
  check(config);
  return {.frame = truth.frame,
          .shape = shape_of(truth, config.range_m),
          .predicted = true,
          .to_truth = distances(prediction, truth, config),
          .to_prediction = distances(truth, prediction, config)};
}

RoadShape shape_of(const Scene& truth, double range_m) {
  constexpr double kStraightWithin_m = 0.02;
  RoadShape shape = RoadShape::kUnknown;
  for (const Boundary& boundary : truth.boundaries) {
    for (const Line& part : clip(in_plane(boundary), range_m)) {
      if (bow(part) > kStraightWithin_m) return RoadShape::kCurve;
      shape = RoadShape::kStraight;
    }
  }
  return shape;
}

Expected<Comparison> compare_all(std::span<const Scene> predictions, std::span<const Scene> truths,
                                 const BoundaryErrorConfig& config) {
  check(config);
  auto predicted = by_frame(predictions, "predictions");
  if (!predicted) return Unexpected(std::move(predicted).error());
  const auto known = by_frame(truths, "truth");
  if (!known) return Unexpected(known.error());

  Comparison comparison;
  for (const Scene& truth : truths) {
    const auto prediction = predicted->find(truth.frame);
    const bool found = prediction != predicted->end();
    comparison.scans.push_back(compare(found ? *prediction->second : Scene{}, truth, config));
    comparison.scans.back().predicted = found;
  }
  for (const Scene& prediction : predictions) {
    if (!known->contains(prediction.frame)) comparison.frames_without_truth.push_back(prediction.frame);
  }
  return comparison;
}

BoundarySummary summarise(std::span<const BoundaryErrors> scans, double tolerance_m) {
  BoundarySummary summary;
  std::vector<double> to_truth;
  std::vector<double> to_prediction;
  for (const BoundaryErrors& scan : scans) {
    to_truth.insert(to_truth.end(), scan.to_truth.begin(), scan.to_truth.end());
    to_prediction.insert(to_prediction.end(), scan.to_prediction.begin(), scan.to_prediction.end());
    if (scan.to_truth.empty()) ++summary.scans_without_prediction;
  }
  summary.scans = scans.size();
  summary.predicted_samples = to_truth.size();
  summary.truth_samples = to_prediction.size();
  summary.share_right = share_within(to_truth, tolerance_m);
  summary.share_covered = share_within(to_prediction, tolerance_m);
  summary.median_m = percentile_of(to_truth, 50.0);
  summary.percentile_95_m = percentile_of(to_truth, 95.0);
  summary.greatest_m = percentile_of(to_truth, 100.0);
  return summary;
}

}  // namespace verge::eval

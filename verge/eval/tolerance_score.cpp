// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/tolerance_score.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "verge/eval/share.hpp"

namespace verge::eval {
namespace {

void count_predicted(const MatchedSample& sample, double tolerance_m, ToleranceCounts& counts) {
  ++counts.predicted;
  counts.right += sample.distance_m <= tolerance_m ? 1U : 0U;
}

void count_true(const MatchedSample& sample, double tolerance_m, ToleranceCounts& counts) {
  const bool hidden = sample.state == PointState::kOccluded;
  const std::size_t found = sample.distance_m <= tolerance_m ? 1U : 0U;
  ++(hidden ? counts.occluded : counts.visible);
  (hidden ? counts.found_occluded : counts.found_visible) += found;
}

}  // namespace

ToleranceCounts& ToleranceCounts::operator+=(const ToleranceCounts& more) {
  predicted += more.predicted;
  right += more.right;
  visible += more.visible;
  found_visible += more.found_visible;
  occluded += more.occluded;
  found_occluded += more.found_occluded;
  return *this;
}

std::optional<double> ToleranceCounts::precision() const { return share_of(right, predicted); }
std::optional<double> ToleranceCounts::recall() const { return share_of(found_visible, visible); }
std::optional<double> ToleranceCounts::occluded_recall() const { return share_of(found_occluded, occluded); }

std::optional<double> ToleranceCounts::f1() const {
  if (predicted == 0 && visible == 0) return std::nullopt;
  const double p = precision().value_or(0.0);
  const double r = recall().value_or(0.0);
  return p + r > 0.0 ? 2.0 * p * r / (p + r) : 0.0;
}

ToleranceCounts count_within(const SceneMatch& match, double range_m, double tolerance_m) {
  ToleranceCounts counts;
  for (const MatchedSample& sample : match.predicted) {
    if (sample.range_m < range_m) count_predicted(sample, tolerance_m, counts);
  }
  for (const MatchedSample& sample : match.truth) {
    if (sample.range_m < range_m) count_true(sample, tolerance_m, counts);
  }
  return counts;
}

std::optional<double> ToleranceCell::macro_f1() const {
  if (scans_with_f1 == 0) return std::nullopt;
  return f1_sum / static_cast<double>(scans_with_f1);
}

std::vector<ToleranceCell> tolerance_cells(const SceneMatch& match, std::span<const double> range_m,
                                           std::span<const double> tolerance_m) {
  std::vector<ToleranceCell> cells;
  for (const double range : range_m) {
    for (const double tolerance : tolerance_m) {
      ToleranceCell cell{
          .range_m = range, .tolerance_m = tolerance, .counts = count_within(match, range, tolerance)};
      if (const auto f1 = cell.counts.f1()) {
        cell.f1_sum = *f1;
        cell.scans_with_f1 = 1;
      }
      cells.push_back(cell);
    }
  }
  return cells;
}

void add_cells(std::vector<ToleranceCell>& sum, std::span<const ToleranceCell> more) {
  if (sum.empty()) {
    sum.assign(more.begin(), more.end());
    return;
  }
  assert(sum.size() == more.size());
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i].counts += more[i].counts;
    sum[i].f1_sum += more[i].f1_sum;
    sum[i].scans_with_f1 += more[i].scans_with_f1;
  }
}

RangeBins& RangeBins::operator+=(const RangeBins& more) {
  assert(width_m == more.width_m);
  bins.resize(std::max(bins.size(), more.bins.size()));
  for (std::size_t i = 0; i < more.bins.size(); ++i) bins[i] += more.bins[i];
  return *this;
}

RangeBins count_by_range(const SceneMatch& match, double width_m, double tolerance_m) {
  RangeBins out{.width_m = width_m, .bins = {}};
  const auto bin = [&](const MatchedSample& sample) -> ToleranceCounts& {
    const auto index = static_cast<std::size_t>(sample.range_m / width_m);
    if (index >= out.bins.size()) out.bins.resize(index + 1);
    return out.bins[index];
  };
  for (const MatchedSample& sample : match.predicted) count_predicted(sample, tolerance_m, bin(sample));
  for (const MatchedSample& sample : match.truth) count_true(sample, tolerance_m, bin(sample));
  return out;
}

std::optional<double> detection_range_m(const RangeBins& bins, double least) {
  std::optional<double> reach_m;
  for (std::size_t i = 0; i < bins.bins.size(); ++i) {
    const ToleranceCounts& counts = bins.bins[i];
    const bool fails = counts.recall().value_or(1.0) < least || counts.precision().value_or(1.0) < least;
    if (fails) return reach_m.value_or(0.0);
    if (counts.visible > 0) reach_m = static_cast<double>(i + 1) * bins.width_m;
  }
  return reach_m;
}

std::vector<ConfidencePoint> count_by_confidence(const Scene& prediction, const Scene& truth,
                                                 const MatchConfig& config, double range_m,
                                                 double tolerance_m) {
  constexpr int kSteps = 20;
  std::vector<ConfidencePoint> points;
  Scene sure = prediction;
  ToleranceCounts counts = count_within(match_boundaries(sure, truth, config), range_m, tolerance_m);
  for (int step = 0; step <= kSteps; ++step) {
    const double least = static_cast<double>(step) / kSteps;
    const auto unsure = [&](const Boundary& boundary) { return boundary.confidence < least; };
    if (std::erase_if(sure.boundaries, unsure) > 0)
      counts = count_within(match_boundaries(sure, truth, config), range_m, tolerance_m);
    points.push_back({least, counts});
  }
  return points;
}

void add_points(std::vector<ConfidencePoint>& sum, std::span<const ConfidencePoint> more) {
  if (sum.empty()) {
    sum.assign(more.begin(), more.end());
    return;
  }
  assert(sum.size() == more.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i].counts += more[i].counts;
}

}  // namespace verge::eval

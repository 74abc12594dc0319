// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/ground_score.hpp"

#include <cassert>
#include <cmath>

#include "verge/eval/share.hpp"

namespace verge::eval {
namespace {

/// Whether the point is ground by the protocol; none where it does not count.
std::optional<bool> is_true_ground(GroundClass type, double z, GroundProtocol protocol,
                                   const GroundScoreConfig& config) {
  switch (type) {
    case GroundClass::kGround:
      return true;
    case GroundClass::kOther:
      return false;
    case GroundClass::kVegetation:
      if (protocol == GroundProtocol::kPatchwork) return z < config.low_vegetation_z_m;
      return std::nullopt;
    case GroundClass::kUnlabelled:
      break;
  }
  return std::nullopt;
}

void count(GroundCounts& counts, bool truth, bool predicted) {
  if (truth) {
    ++(predicted ? counts.true_ground : counts.missed_ground);
  } else {
    ++(predicted ? counts.false_ground : counts.true_other);
  }
}

void add_height(HeightErrors& heights, double point_over_ground_m) {
  ++heights.points;
  heights.sum_m -= point_over_ground_m;
  heights.squared_m2 += point_over_ground_m * point_over_ground_m;
}

/// Whether the point is finite and nearer than the range.
bool counts_at_all(const Cloud& cloud, std::size_t i, double range_m) {
  return std::isfinite(cloud.z[i]) && std::isfinite(cloud.x[i]) && std::isfinite(cloud.y[i]) &&
         std::hypot(static_cast<double>(cloud.x[i]), static_cast<double>(cloud.y[i])) < range_m;
}

void add_macro(ProtocolScore& score) {
  score.precision.add(score.counts.precision());
  score.recall.add(score.counts.recall());
  score.f1.add(score.counts.f1());
}

}  // namespace

GroundCounts& GroundCounts::operator+=(const GroundCounts& more) {
  true_ground += more.true_ground;
  false_ground += more.false_ground;
  missed_ground += more.missed_ground;
  true_other += more.true_other;
  return *this;
}

std::size_t GroundCounts::points() const { return true_ground + false_ground + missed_ground + true_other; }
std::optional<double> GroundCounts::precision() const {
  return share_of(true_ground, true_ground + false_ground);
}
std::optional<double> GroundCounts::recall() const {
  return share_of(true_ground, true_ground + missed_ground);
}
std::optional<double> GroundCounts::f1() const {
  return share_of(2 * true_ground, 2 * true_ground + false_ground + missed_ground);
}
std::optional<double> GroundCounts::iou() const {
  return share_of(true_ground, true_ground + false_ground + missed_ground);
}
std::optional<double> GroundCounts::accuracy() const { return share_of(true_ground + true_other, points()); }

MeanFigure& MeanFigure::operator+=(const MeanFigure& more) {
  sum += more.sum;
  scans += more.scans;
  return *this;
}

void MeanFigure::add(const std::optional<double>& figure) {
  if (figure) *this += MeanFigure{*figure, 1};
}

std::optional<double> MeanFigure::value() const {
  if (scans == 0) return std::nullopt;
  return sum / static_cast<double>(scans);
}

ProtocolScore& ProtocolScore::operator+=(const ProtocolScore& more) {
  counts += more.counts;
  precision += more.precision;
  recall += more.recall;
  f1 += more.f1;
  return *this;
}

HeightErrors& HeightErrors::operator+=(const HeightErrors& more) {
  points += more.points;
  sum_m += more.sum_m;
  squared_m2 += more.squared_m2;
  return *this;
}

std::optional<double> HeightErrors::mean_m() const {
  if (points == 0) return std::nullopt;
  return sum_m / static_cast<double>(points);
}

std::optional<double> HeightErrors::rmse_m() const {
  if (points == 0) return std::nullopt;
  return std::sqrt(squared_m2 / static_cast<double>(points));
}

GroundScore& GroundScore::operator+=(const GroundScore& more) {
  scans += more.scans;
  absent += more.absent;
  for (std::size_t i = 0; i < protocols.size(); ++i) protocols.at(i) += more.protocols.at(i);
  heights += more.heights;
  return *this;
}

GroundScore score_ground(const GroundTruth& truth, const GroundPrediction* prediction,
                         const GroundScoreConfig& config) {
  const Cloud& cloud = truth.cloud;
  assert(truth.classes.size() == cloud.x.size());
  assert(prediction == nullptr || prediction->is_ground.size() == cloud.x.size());
  const bool has_heights = prediction != nullptr && !prediction->height_m.empty();
  GroundScore score;
  score.scans = 1;
  score.absent = prediction == nullptr ? 1U : 0U;
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    if (!counts_at_all(cloud, i, config.range_m)) continue;
    const bool predicted = prediction != nullptr && prediction->is_ground[i];
    for (std::size_t k = 0; k < score.protocols.size(); ++k) {
      const auto is_true =
          is_true_ground(truth.classes[i], cloud.z[i], static_cast<GroundProtocol>(k), config);
      if (is_true) count(score.protocols.at(k).counts, *is_true, predicted);
    }
    if (has_heights && truth.classes[i] == GroundClass::kGround)
      add_height(score.heights, prediction->height_m[i]);
  }
  for (ProtocolScore& protocol : score.protocols) add_macro(protocol);
  return score;
}

}  // namespace verge::eval

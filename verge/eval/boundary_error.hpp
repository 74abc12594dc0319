// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/fields.hpp"
#include "verge/model/scene.hpp"

namespace verge::eval {

/// How boundaries are compared.
struct BoundaryErrorConfig {
  double range_m = 15.0;     ///< Samples farther from the sensor (in the plane) do not count.
  double tolerance_m = 0.2;  ///< A sample of one this near to a boundary of the other agrees with it.
  double step_m = 0.1;       ///< Along a boundary, from sample to sample.
  bool any_side = false;     ///< Compare left with right as well: the place counts, the side's name does not.
};

/// What the road does within the range, as the truth has it.
enum class RoadShape : std::uint8_t { kStraight, kCurve, kUnknown };

}  // namespace verge::eval

namespace verge {
template <>
inline constexpr std::array enum_names<eval::RoadShape> =
    std::to_array<std::string_view>({"straight", "curve", "unknown"});
}  // namespace verge

namespace verge::eval {

/// One scan's prediction against its truth. Distances are in the plane, in metres, from a sample of one to
/// the nearest point of the other's boundaries of the same side (left with left, right with right; an island
/// or an unnamed side goes with any, and with `any_side` each with any). Infinity where the other has no such
/// boundary.
struct BoundaryErrors {
  std::string frame;
  RoadShape shape = RoadShape::kUnknown;
  bool predicted = false;             ///< The predictions have this frame at all.
  std::vector<double> to_truth;       ///< Of each sample of the prediction: how wrong it is.
  std::vector<double> to_prediction;  ///< Of each sample of the truth: how well it is covered.
};

/// Samples of both every `step_m`, those within `range_m` of the sensor; both scenes in one sensor frame.
[[nodiscard]] BoundaryErrors compare(const Scene& prediction, const Scene& truth,
                                     const BoundaryErrorConfig& config);

/// kStraight where every boundary of the truth stays, within the range, no more than 2 cm beside the line
/// from its first to its last point there; kUnknown where the truth has no boundary within the range.
[[nodiscard]] RoadShape shape_of(const Scene& truth, double range_m);

/// Predictions and truths put together by frame.
struct Comparison {
  std::vector<BoundaryErrors> scans;              ///< One a truth, in its order.
  std::vector<std::string> frames_without_truth;  ///< Predictions that were left out.
};

/// Compares every truth with the prediction of its frame; a truth without one counts as not covered. Fails
/// with kUnusable where a frame stands twice in the predictions or in the truths. Throws
/// std::invalid_argument where the range, tolerance or step is not positive.
[[nodiscard]] Expected<Comparison> compare_all(std::span<const Scene> predictions,
                                               std::span<const Scene> truths,
                                               const BoundaryErrorConfig& config);

/// Figures over the samples of many scans, pooled. None where there is no sample to tell; infinite where so
/// many samples have nothing to be compared with.
struct BoundarySummary {
  std::size_t scans = 0;
  std::size_t scans_without_prediction = 0;  ///< Scans in which no boundary is predicted within the range.
  std::size_t predicted_samples = 0;
  std::size_t truth_samples = 0;
  std::optional<double> median_m;         ///< Of the predicted samples' distances from the truth.
  std::optional<double> percentile_95_m;  ///< Likewise.
  std::optional<double> greatest_m;       ///< Likewise.
  std::optional<double> share_right;    ///< Predicted samples within the tolerance of the truth (precision).
  std::optional<double> share_covered;  ///< Truth samples within the tolerance of a prediction (recall).
};

[[nodiscard]] BoundarySummary summarise(std::span<const BoundaryErrors> scans, double tolerance_m);

}  // namespace verge::eval

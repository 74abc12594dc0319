// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/eval/label_scheme.hpp"
#include "verge/scan/organise.hpp"

namespace verge::eval {

/// What is true of a scan's points, in the file's order.
struct GroundTruth {
  std::string frame;
  Cloud cloud;
  std::vector<GroundClass> classes;  ///< One a point.
};

/// What someone says of the same points.
struct GroundPrediction {
  std::vector<bool> is_ground;
  /// Height of each point over the ground as predicted, metres; empty where only classes are said.
  std::vector<double> height_m{};
};

/// Whose definition of the truth holds. Points without a label count for none.
enum class GroundProtocol : std::uint8_t {
  kPatchworkpp,  ///< Vegetation does not count (Lee, Lim and Myung 2022, IV-A).
  kPatchwork     ///< Low vegetation is ground, other vegetation is not (Lim, Oh and Myung 2021).
};

struct GroundScoreConfig {
  double range_m =
      std::numeric_limits<double>::infinity();  ///< Points nearer than this count (in the plane).
  double low_vegetation_z_m = -1.3;  ///< Vegetation below this height in the sensor's frame is low.
};

/// Points by what is true and what is predicted of them.
struct GroundCounts {
  std::size_t true_ground = 0;    ///< Ground that was found.
  std::size_t false_ground = 0;   ///< Predicted as ground, and none.
  std::size_t missed_ground = 0;  ///< Ground that was not found.
  std::size_t true_other = 0;

  GroundCounts& operator+=(const GroundCounts& more);
  friend bool operator==(const GroundCounts&, const GroundCounts&) = default;

  [[nodiscard]] std::size_t points() const;
  [[nodiscard]] std::optional<double> precision() const;  ///< None where nothing is predicted as ground.
  [[nodiscard]] std::optional<double> recall() const;     ///< None where there is no ground.
  [[nodiscard]] std::optional<double> f1() const;         ///< None where both are.
  [[nodiscard]] std::optional<double> iou() const;        ///< Intersection over union; none as f1().
  [[nodiscard]] std::optional<double> accuracy() const;   ///< None of no points.
};

/// The mean of figures that scans have; those without one do not count.
struct MeanFigure {
  double sum = 0.0;
  std::size_t scans = 0;

  MeanFigure& operator+=(const MeanFigure& more);
  void add(const std::optional<double>& figure);
  [[nodiscard]] std::optional<double> value() const;
};

/// What scans came to by one protocol: all points together (micro), and the means of the scans' own figures
/// (macro), which is how the protocols are published.
struct ProtocolScore {
  GroundCounts counts;
  MeanFigure precision;
  MeanFigure recall;
  MeanFigure f1;

  ProtocolScore& operator+=(const ProtocolScore& more);
};

/// How far the predicted ground is from points that are labelled as ground, upwards.
struct HeightErrors {
  std::size_t points = 0;
  double sum_m = 0.0;
  double squared_m2 = 0.0;

  HeightErrors& operator+=(const HeightErrors& more);
  [[nodiscard]] std::optional<double> mean_m() const;  ///< Above 0 where the ground is predicted too high.
  [[nodiscard]] std::optional<double> rmse_m() const;
};

/// What scans came to.
struct GroundScore {
  std::size_t scans = 0;
  std::size_t absent = 0;  ///< Scans without a prediction.
  std::array<ProtocolScore, 2> protocols;
  HeightErrors heights;

  [[nodiscard]] const ProtocolScore& by(GroundProtocol protocol) const {
    return protocols.at(static_cast<std::size_t>(protocol));
  }
  GroundScore& operator+=(const GroundScore& more);
};

/// Scores one scan; no prediction counts as absent, and as no point predicted as ground. Points that are not
/// finite do not count. Prediction and truth must be of equally many points.
[[nodiscard]] GroundScore score_ground(const GroundTruth& truth, const GroundPrediction* prediction,
                                       const GroundScoreConfig& config);

}  // namespace verge::eval

namespace verge {
template <>
inline constexpr std::array enum_names<eval::GroundProtocol> =
    std::to_array<std::string_view>({"patchwork++", "patchwork"});
}  // namespace verge

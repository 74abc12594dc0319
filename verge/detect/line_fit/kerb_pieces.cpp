// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/kerb_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace verge::detect::line_fit {
namespace {

constexpr std::size_t kLeast = 3;  // returns of a piece

/// Whether the layer sees something higher right above the point.
bool is_beneath(const LayerPoint& low, std::span<const LayerPoint> layer, const KerbConfig& config) {
  const double aside_rad = config.beneath_m / std::max(low.range_m, config.beneath_m);
  const auto from =
      std::partition_point(layer.begin(), layer.end(), [&](const LayerPoint& p) {  // azimuths fall
        return p.azimuth_rad > low.azimuth_rad + aside_rad;
      });
  for (auto p = from; p != layer.end() && p->azimuth_rad >= low.azimuth_rad - aside_rad; ++p) {
    if (p->place.z > config.kerb_high_m && distance(p->place.xy(), low.place.xy()) <= config.beneath_m)
      return true;
  }
  return false;
}

/// Whether the place is within the object's footprint, or `around_m` from it along either of its axes.
bool is_within(Vec2 place, const Object& object, double around_m) {
  const Vec2 from_center = place - object.center.xy();
  const Vec2 ahead{std::cos(object.yaw_rad), std::sin(object.yaw_rad)};
  return std::fabs(dot(from_center, ahead)) <= 0.5 * object.size.length_m + around_m &&
         std::fabs(cross(ahead, from_center)) <= 0.5 * object.size.width_m + around_m;
}

/// Follows a kerb from return to return.
class Follower {
 public:
  Follower(std::span<const LayerPoint> points, const KerbConfig& config) : points_(points), config_(config) {}

  /// Whether the point goes on along the kerb; then it is part of it.
  bool take(std::size_t i) {
    if (!members_.empty() && !goes_on(points_[i].place.xy())) return false;
    members_.push_back(i);
    places_.push_back(points_[i].place.xy());
    line_ = length_m() >= config_.piece_m ? line_along() : std::nullopt;
    return true;
  }

  /// Without the last returns of the road before the kerb and the first of what lies on top of it.
  [[nodiscard]] std::optional<KerbPiece> piece() const {
    if (members_.size() < kLeast) return std::nullopt;
    const auto fitted = fit::fit_line_robust(places_);
    if (!fitted || !is_along(fitted->line)) return std::nullopt;
    KerbPiece piece{{}, fitted->line};
    std::vector<double> stations;
    for (std::size_t k = 0; k < members_.size(); ++k) {
      if (std::fabs(fitted->residuals.signed_m[k]) > config_.close_m) continue;
      piece.points.push_back(members_[k]);
      stations.push_back(fit::station(fitted->line, places_[k]));
    }
    if (piece.points.size() < kLeast) return std::nullopt;
    const auto [first, last] = std::ranges::minmax(stations);
    return last - first >= config_.piece_m ? std::optional(piece) : std::nullopt;
  }

 private:
  [[nodiscard]] bool is_along(const fit::Line& line) const {
    return std::fabs(line.direction.y) <= config_.slope_max * line.direction.x;
  }

  [[nodiscard]] double length_m() const { return std::fabs(places_.back().x - places_.front().x); }

  [[nodiscard]] std::optional<fit::Line> line_along() const {
    const auto line = fit::orthogonal_line(places_);
    return line && is_along(*line) ? line : std::nullopt;
  }

  /// Near to the line; as long as there is none, not farther aside than a kerb goes.
  [[nodiscard]] bool goes_on(Vec2 place) const {
    constexpr double kFar_m = 4.0;  // from return to return, where it is seen flatly
    if (distance(place, places_.back()) > kFar_m) return false;
    if (line_) return std::fabs(fit::signed_distance(*line_, place)) <= config_.straight_m;
    const Vec2 step = place - places_.front();
    return std::fabs(step.y) <= config_.straight_m + 0.5 * config_.slope_max * std::fabs(step.x);
  }

  std::span<const LayerPoint> points_;
  const KerbConfig& config_;
  std::vector<std::size_t> members_{};
  std::vector<Vec2> places_{};
  std::optional<fit::Line> line_{};
};

/// From the first point on, past up to two low returns that do not belong to it.
std::optional<KerbPiece> follow(std::span<const LayerPoint> points, std::span<const std::size_t> outward,
                                const KerbConfig& config) {
  constexpr std::size_t kStrays = 2;
  Follower follower(points, config);
  std::size_t strays = 0;
  for (const std::size_t i : outward) {
    strays = follower.take(i) ? 0 : strays + 1;
    if (strays > kStrays) break;
  }
  return follower.piece();
}

/// Of the pieces from the first point on or from one of the next the longest: the first ones may still be of
/// the road before the kerb.
std::optional<KerbPiece> best_from(std::span<const LayerPoint> points, std::span<const std::size_t> outward,
                                   const KerbConfig& config) {
  constexpr std::size_t kStarts = 3;
  auto best = follow(points, outward, config);
  if (!best) return best;
  for (std::size_t i = 1; i < std::min(kStarts, outward.size()); ++i) {
    auto piece = follow(points, outward.subspan(i), config);
    if (piece && piece->points.size() > best->points.size()) best = std::move(piece);
  }
  return best;
}

/// The low points of the layer, from straight ahead outward to either side: what hides some of them plays no
/// part, and left and right are alike.
std::array<std::vector<std::size_t>, 2> outward_of(std::span<const LayerPoint> points,
                                                   const std::vector<bool>& low, std::size_t begin,
                                                   std::size_t end) {
  std::array<std::vector<std::size_t>, 2> sides;
  for (std::size_t i = begin; i < end; ++i) {
    if (low[i]) sides.at(points[i].place.y > 0.0 ? 0 : 1).push_back(i);
  }
  std::ranges::reverse(sides[0]);
  return sides;
}

}  // namespace

std::vector<bool> low_points(std::span<const LayerPoint> points, std::span<const Object> objects,
                             const KerbConfig& config) {
  std::vector<bool> low(points.size());
  const auto layers = layers_of(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LayerPoint& p = points[i];
    if (p.place.z < config.kerb_low_m || p.place.z > config.kerb_high_m || p.range_m > config.kerb_range_m)
      continue;
    const auto is_of = [&](const Object& object) { return is_within(p.place.xy(), object, config.around_m); };
    const auto has_above = [&](const auto& layer) {
      return is_beneath(p, points.subspan(layer.first, layer.second - layer.first), config);
    };
    low[i] = std::ranges::none_of(objects, is_of) && std::ranges::none_of(layers, has_above);
  }
  return low;
}

std::vector<KerbPiece> kerb_pieces(std::span<const LayerPoint> points, const std::vector<bool>& low,
                                   const KerbConfig& config) {
  std::vector<KerbPiece> pieces;
  for (const auto& [begin, end] : layers_of(points)) {
    for (const std::vector<std::size_t>& outward : outward_of(points, low, begin, end)) {
      for (std::size_t at = 0; at < outward.size();) {
        auto piece = best_from(points, std::span(outward).subspan(at), config);
        ++at;
        if (!piece) continue;
        while (at < outward.size() && outward[at - 1] != piece->points.back()) ++at;
        pieces.push_back(*std::move(piece));
      }
    }
  }
  return pieces;
}

}  // namespace verge::detect::line_fit

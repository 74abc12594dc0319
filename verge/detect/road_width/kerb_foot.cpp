// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/kerb_foot.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "verge/fit/line.hpp"

namespace verge::detect::road_width {
namespace {

/// Points of one side by their number outward from the edge; negative ones lie on the road.
class AboutEdge {
 public:
  AboutEdge(const LayerLine& line, std::size_t edge, bool left)
      : line_(line), edge_(edge), outward_(left ? -1 : 1) {}

  [[nodiscard]] bool has(std::ptrdiff_t n) const {
    const auto i = static_cast<std::ptrdiff_t>(edge_) + outward_ * n;
    const bool is_beyond_middle = (i - static_cast<std::ptrdiff_t>(line_.middle)) * outward_ < 0;
    return i >= 0 && i < static_cast<std::ptrdiff_t>(line_.level.size()) && !is_beyond_middle;
  }
  [[nodiscard]] Vec3 level(std::ptrdiff_t n) const { return line_.level[index(n)]; }
  /// How much farther out than the edge.
  [[nodiscard]] double outward_m(std::ptrdiff_t n) const {
    return static_cast<double>(outward_) * (line_.points[index(n)].x - line_.points[edge_].x);
  }

 private:
  [[nodiscard]] std::size_t index(std::ptrdiff_t n) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(edge_) + outward_ * n);
  }

  const LayerLine& line_;
  std::size_t edge_;
  std::ptrdiff_t outward_;
};

/// The last half metre or so of the road.
std::vector<Vec3> road_before(const AboutEdge& about) {
  constexpr double kLength_m = 0.6;
  constexpr std::ptrdiff_t kMost = 24;
  std::vector<Vec3> road;
  for (std::ptrdiff_t n = 0; n > -kMost && about.has(n) && about.outward_m(n) > -kLength_m; --n)
    road.push_back(about.level(n));
  return road;
}

/// Heights of the road's points: what lies no higher than `low_m` over their mean may be road.
struct RoadHeight {
  double mean = 0.0;
  double low_m = 0.0;
};

RoadHeight height_of(const std::vector<Vec3>& road) {
  constexpr double kLeastLow_m = 0.015;
  constexpr double kSigmas = 2.0;
  const auto n = static_cast<double>(road.size());
  double mean = 0.0;
  for (const Vec3 p : road) mean += p.z / n;
  double variance = 0.0;
  for (const Vec3 p : road) variance += (p.z - mean) * (p.z - mean) / n;
  return {mean, std::max(kLeastLow_m, kSigmas * std::sqrt(variance))};
}

/// Places of what climbs from the road behind the edge, without the road's and the top's own points. None
/// where it does not climb far enough to be told from the road.
std::vector<Vec2> face_behind(const AboutEdge& about, const RoadHeight& road) {
  constexpr std::ptrdiff_t kMost = 40;
  constexpr double kBehind_m = 0.06;  // a face stands upright or leads back: beyond lies what is on top
  constexpr double kShare = 0.8;      // of the height
  std::vector<Vec3> climb;
  double top = 0.0;
  double foot_m = 0.0;
  for (std::ptrdiff_t n = 1; n <= kMost && about.has(n); ++n) {
    const double height = about.level(n).z - road.mean;
    if (height < road.low_m && top < 2.0 * road.low_m) {  // still road
      foot_m = std::max(foot_m, about.outward_m(n));
      top = 0.0;
      climb.clear();
      continue;
    }
    if (about.outward_m(n) > foot_m + kBehind_m) break;
    top = std::max(top, height);
    climb.push_back(about.level(n));
  }
  std::vector<Vec2> face;
  if (top < 4.0 * road.low_m) return face;
  for (const Vec3 p : climb) {
    const double height = p.z - road.mean;
    if (height > road.low_m && height < kShare * top) face.push_back(p.xy());
  }
  return face;
}

std::optional<Vec2> crossing(const fit::Line& a, const fit::Line& b) {
  constexpr double kParallel = 0.34;  // sine of 20 degrees
  const double sine = cross(a.direction, b.direction);
  if (std::fabs(sine) < kParallel) return std::nullopt;
  return fit::point_at(a, cross(b.centroid - a.centroid, b.direction) / sine);
}

}  // namespace

std::optional<Vec2> kerb_foot(const LayerLine& line, std::size_t edge, bool left) {
  constexpr std::size_t kLeastRoad = 4;
  constexpr std::size_t kLeastFace = 2;
  constexpr double kNear_m = 0.3;
  const AboutEdge about(line, edge, left);
  const std::vector<Vec3> road = road_before(about);
  if (road.size() < kLeastRoad) return std::nullopt;
  const std::vector<Vec2> face = face_behind(about, height_of(road));
  if (face.size() < kLeastFace) return std::nullopt;
  std::vector<Vec2> places(road.size());
  std::ranges::transform(road, places.begin(), [](Vec3 p) { return p.xy(); });
  const auto across = fit::orthogonal_line(places);
  const auto along = fit::orthogonal_line(face);
  if (!across || !along) return std::nullopt;
  const auto foot = crossing(*across, *along);
  return foot && distance(*foot, line.level[edge].xy()) < kNear_m ? foot : std::nullopt;
}

}  // namespace verge::detect::road_width

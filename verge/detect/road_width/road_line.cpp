// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/road_line.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/statistics.hpp"

namespace verge::detect::road_width {
namespace {

/// Points in the order of a search: outward from the middle.
class Outward {
 public:
  Outward(std::span<const PicturePoint> points, std::size_t middle, bool leftward)
      : points_(points), middle_(middle), leftward_(leftward) {}

  /// Points on this side of the middle one.
  [[nodiscard]] std::size_t size() const { return leftward_ ? middle_ : points_.size() - 1 - middle_; }
  /// Index of the point n places outward of the middle one.
  [[nodiscard]] std::size_t index(std::size_t n) const { return leftward_ ? middle_ - n : middle_ + n; }
  [[nodiscard]] const PicturePoint& at(std::size_t n) const { return points_[index(n)]; }

  /// The `count` points outward of the current one, n places from the middle, itself not among them.
  [[nodiscard]] std::vector<PicturePoint> window(std::size_t n, std::size_t count) const {
    std::vector<PicturePoint> window;
    for (std::size_t i = 1; i <= count; ++i) window.push_back(at(n + i));
    return window;
  }

 private:
  std::span<const PicturePoint> points_;
  std::size_t middle_;
  bool leftward_;
};

/// Sums from which the squared deviations of a set that grows and shrinks follow.
struct Spread {
  double sum = 0.0, squares = 0.0, count = 0.0;

  void add(double value, double times = 1.0) {
    sum += times * value;
    squares += times * value * value;
    count += times;
  }
  [[nodiscard]] double deviation() const { return count > 0.0 ? squares - sum * sum / count : 0.0; }
};

double measure(double mean_square, const LineSearch& search) {
  return search.standard ? std::sqrt(mean_square) : mean_square;
}

/// Step 3.
bool shows_edge(std::span<const PicturePoint> window, const LineSearch& search) {
  return measure(msdv_y(window), search) > search.y_thres_m2 &&
         measure(msdv_dx(window), search) < search.x_thres_m2;
}

/// How many points of the window are still road: where it falls best into a line across (y constant) and a
/// face along the road (x constant).
std::size_t road_points(std::span<const PicturePoint> window) {
  Spread road_y;
  Spread face_x;
  for (const PicturePoint& p : window) face_x.add(p.x - window.front().x);
  std::size_t best = 0;
  double least = face_x.deviation();
  for (std::size_t i = 0; i < window.size(); ++i) {
    road_y.add(window[i].y - window.front().y);
    face_x.add(window[i].x - window.front().x, -1.0);
    const double left_over = road_y.deviation() + face_x.deviation();
    if (left_over >= least) continue;
    least = left_over;
    best = i + 1;
  }
  return best;
}

/// How far a point may lie off a line across and still be of it.
double tolerance_m(const LineSearch& search) {
  return search.standard ? search.y_thres_m2 : std::sqrt(search.y_thres_m2);
}

/// Whether at most `bridge` points of the window and of what follows differ from the road, and the line goes
/// on behind them.
bool is_small_matter(const Outward& side, std::size_t n, std::span<const PicturePoint> window,
                     const LineSearch& search) {
  if (search.bridge == 0) return false;
  std::vector<double> y;
  for (const PicturePoint& p : window) y.push_back(p.y);
  const double road = median(y).value_or(0.0);
  const std::size_t last = std::min(n + search.neighbours + search.bridge, side.size());
  std::size_t differ = 0;
  for (std::size_t i = n + 1; i <= last; ++i) {
    if (std::fabs(side.at(i).y - road) > tolerance_m(search)) ++differ;
  }
  return differ <= search.bridge && std::fabs(side.at(last).y - road) <= tolerance_m(search);
}

/// How high the face behind the edge is: over how much of the road its points stretch while they stay on it.
double face_height_m(const Outward& side, std::size_t edge, const LineSearch& search) {
  const double across =
      std::sqrt(search.standard ? search.x_thres_m2 * search.x_thres_m2 : search.x_thres_m2);
  const PicturePoint foot = side.at(std::min(edge + 1, side.size()));
  double stretch = 0.0;
  for (std::size_t n = edge + 1; n <= side.size(); ++n) {
    if (std::fabs(side.at(n).x - foot.x) > across) break;
    stretch = std::max(stretch, std::fabs(side.at(n).y - foot.y));
  }
  return stretch / search.tangent;
}

/// Steps 1 to 6 to one side.
RoadEnd search_side(const Outward& side, const LineSearch& search) {
  for (std::size_t n = 0; side.size() - n >= search.neighbours; ++n) {  // Step 2, and Step 4: outward
    const auto window = side.window(n, search.neighbours);              // Step 3
    if (!shows_edge(window, search)) continue;
    if (is_small_matter(side, n, window, search)) continue;                   // trait (2)
    const std::size_t edge = search.refine ? n + road_points(window) : n;     // Step 5
    const bool high = face_height_m(side, edge, search) > search.obstacle_m;  // trait (1)
    return {high ? LineEnd::kObstacle : LineEnd::kEdge, side.index(n), side.index(edge)};
  }
  return {LineEnd::kOpen, side.index(side.size()), side.index(side.size())};  // Step 6
}

bool is_road_about(std::span<const PicturePoint> points, std::size_t middle, const LineSearch& search) {
  const std::size_t half = search.neighbours / 2;
  const std::size_t begin = middle > half ? middle - half : 0;
  const std::size_t count = std::min(search.neighbours, points.size() - begin);
  return measure(msdv_y(points.subspan(begin, count)), search) <= search.y_thres_m2;
}

}  // namespace

double msdv_y(std::span<const PicturePoint> window) {
  if (window.empty()) return 0.0;
  double mean = 0.0;
  for (const PicturePoint& p : window) mean += p.y;
  const auto count = static_cast<double>(window.size());
  mean /= count;
  double squares = 0.0;
  for (const PicturePoint& p : window) squares += (p.y - mean) * (p.y - mean);
  return squares / count;
}

double msdv_dx(std::span<const PicturePoint> window) {
  if (window.size() < 2) return 0.0;
  const auto count = static_cast<double>(window.size() - 1);
  const double mean = (window.back().x - window.front().x) / count;
  double squares = 0.0;
  for (std::size_t i = 1; i < window.size(); ++i) {
    const double off = window[i].x - window[i - 1].x - mean;
    squares += off * off;
  }
  return squares / count;
}

std::optional<RoadLine> find_road_line(std::span<const PicturePoint> points, std::size_t middle,
                                       const LineSearch& search) {
  if (middle >= points.size()) return std::nullopt;
  return RoadLine{.left = search_side({points, middle, true}, search),
                  .right = search_side({points, middle, false}, search),  // Step 7
                  .middle_is_road = is_road_about(points, middle, search)};
}

double road_length_m(std::span<const PicturePoint> points, const RoadLine& line, double reach_m) {
  const double left = std::max(points[line.left.edge].x, -reach_m);
  const double right = std::min(points[line.right.edge].x, reach_m);
  return std::max(0.0, right - left);
}

}  // namespace verge::detect::road_width

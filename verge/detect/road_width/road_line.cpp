// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/road_line.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/statistics.hpp"

namespace verge::detect::road_width {
namespace {

/// The points of one side in the order of the search: the middle one first, then outward.
struct Side {
  std::vector<PicturePoint> points;
  bool leftward = false;

  /// Points outward of the middle one.
  [[nodiscard]] std::size_t size() const { return points.size() - 1; }
  /// Index in the layer of the point n places outward of the middle one.
  [[nodiscard]] std::size_t index(std::size_t n, std::size_t middle) const {
    return leftward ? middle - n : middle + n;
  }
};

Side side_of(std::span<const PicturePoint> points, std::size_t middle, bool leftward) {
  Side side{{}, leftward};
  if (leftward) {
    const auto from_left = points.first(middle + 1);
    side.points.assign(from_left.rbegin(), from_left.rend());
  } else {
    const auto from_middle = points.subspan(middle);
    side.points.assign(from_middle.begin(), from_middle.end());
  }
  return side;
}

/// Sums from which the squared deviations of a set that grows and shrinks follow.
struct Spread {
  double sum = 0.0, squares = 0.0, count = 0.0;

  void add(double value, double times = 1.0) {
    sum += times * value;
    squares += times * value * value;
    count += times;
  }
  [[nodiscard]] double deviation() const { return count > 0.0 ? squares - sum * sum / count : 0.0; }
  [[nodiscard]] double mean_square() const { return count > 0.0 ? deviation() / count : 0.0; }
};

/// msdv_y and msdv_dx of a window of K points that goes outward, in the same time for any K.
class Window {
 public:
  Window(const std::vector<PicturePoint>& side, std::size_t count) : side_(side), count_(count) {
    for (std::size_t i = 1; i <= count; ++i) y_.add(y(i));
    for (std::size_t i = 2; i <= count; ++i) dx_.add(dx(i));
  }

  /// Step 4, from the window behind point n to that behind the next one.
  void go_on(std::size_t n) {
    y_.add(y(n + 1), -1.0);
    y_.add(y(n + 1 + count_));
    if (count_ < 2) return;
    dx_.add(dx(n + 2), -1.0);
    dx_.add(dx(n + 1 + count_));
  }

  [[nodiscard]] double msdv_y() const { return y_.mean_square(); }
  [[nodiscard]] double msdv_dx() const { return dx_.mean_square(); }

 private:
  // Against the middle point's, so that the sums' differences keep their digits.
  [[nodiscard]] double y(std::size_t i) const { return side_[i].y - side_[0].y; }
  [[nodiscard]] double dx(std::size_t i) const { return side_[i].x - side_[i - 1].x; }

  const std::vector<PicturePoint>& side_;
  std::size_t count_;
  Spread y_, dx_;
};

double measure(double mean_square, const LineSearch& search) {
  return search.standard ? std::sqrt(mean_square) : mean_square;
}

/// Step 3.
bool shows_edge(const Window& window, const LineSearch& search) {
  return measure(window.msdv_y(), search) > search.y_thres_m2 &&
         measure(window.msdv_dx(), search) < search.x_thres_m2;
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
bool is_small_matter(const Side& side, std::size_t n, std::span<const PicturePoint> window,
                     const LineSearch& search) {
  if (search.bridge == 0) return false;
  std::vector<double> y;
  for (const PicturePoint& p : window) y.push_back(p.y);
  const double road = median(y).value_or(0.0);
  const std::size_t last = std::min(n + search.neighbours + search.bridge, side.size());
  std::size_t differ = 0;
  for (std::size_t i = n + 1; i <= last; ++i) {
    if (std::fabs(side.points[i].y - road) > tolerance_m(search)) ++differ;
  }
  return differ <= search.bridge && std::fabs(side.points[last].y - road) <= tolerance_m(search);
}

/// How high the face behind the edge is: over how much of the road its points stretch while they stay on it.
double face_height_m(const Side& side, std::size_t edge, const LineSearch& search) {
  const double across =
      std::sqrt(search.standard ? search.x_thres_m2 * search.x_thres_m2 : search.x_thres_m2);
  const PicturePoint foot = side.points[std::min(edge + 1, side.size())];
  double stretch = 0.0;
  for (std::size_t n = edge + 1; n <= side.size(); ++n) {
    if (std::fabs(side.points[n].x - foot.x) > across) break;
    stretch = std::max(stretch, std::fabs(side.points[n].y - foot.y));
  }
  return stretch / search.tangent;
}

/// Steps 1 to 6 to one side.
RoadEnd search_side(const Side& side, std::size_t middle, const LineSearch& search) {
  const std::size_t count = search.neighbours;
  if (side.size() >= count) {
    Window window(side.points, count);
    for (std::size_t n = 0;; ++n) {      // Step 2, and Step 4: outward
      if (shows_edge(window, search)) {  // Step 3
        const std::span<const PicturePoint> points(side.points.data() + n + 1, count);
        if (!is_small_matter(side, n, points, search)) {                            // trait (2)
          const std::size_t edge = search.refine ? n + road_points(points) : n;     // Step 5
          const bool high = face_height_m(side, edge, search) > search.obstacle_m;  // trait (1)
          return {high ? LineEnd::kObstacle : LineEnd::kEdge, side.index(n, middle),
                  side.index(edge, middle)};
        }
      }
      if (side.size() - n == count) break;
      window.go_on(n);
    }
  }
  const std::size_t outermost = side.index(side.size(), middle);
  return {LineEnd::kOpen, outermost, outermost};  // Step 6
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
  return RoadLine{.left = search_side(side_of(points, middle, true), middle, search),
                  .right = search_side(side_of(points, middle, false), middle, search),  // Step 7
                  .middle_is_road = is_road_about(points, middle, search)};
}

double road_length_m(std::span<const PicturePoint> points, const RoadLine& line, double reach_m) {
  const double left = std::max(points[line.left.edge].x, -reach_m);
  const double right = std::min(points[line.right.edge].x, reach_m);
  return std::max(0.0, right - left);
}

}  // namespace verge::detect::road_width

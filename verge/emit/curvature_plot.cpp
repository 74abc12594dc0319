// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/curvature_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include <fmt/core.h>

#include "verge/core/round_length.hpp"
#include "verge/core/statistics.hpp"
#include "verge/core/vec.hpp"
#include "verge/emit/bev_theme.hpp"
#include "verge/emit/canvas.hpp"
#include "verge/emit/value_axis.hpp"

namespace verge::emit {
namespace {

constexpr PlotArea kArea{.left = 90.0, .top = 84.0, .width = 1080.0, .height = 360.0};
constexpr int kWidth_px = 1200;
constexpr int kHeight_px = 508;
constexpr double kKey_px = 5.0;
constexpr Colour kKey = rgb(0xFF6FB5);

/// The points of a curve that are finite: place along the boundary and curvature.
std::vector<Vec2> finite_points(const CurvatureCurve& curve) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < std::min(curve.s_m.size(), curve.kappa_1_m.size()); ++i) {
    if (std::isfinite(curve.s_m[i]) && std::isfinite(curve.kappa_1_m[i]))
      points.push_back({curve.s_m[i], curve.kappa_1_m[i]});
  }
  return points;
}

/// The mean between the ends, which have no circle.
double threshold_of(std::span<const Vec2> points) {
  std::vector<double> between;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) between.push_back(points[i].y);
  return mean(between).value_or(0.0);
}

double greatest_of(std::span<const Vec2> points) {
  double greatest = 0.0;
  for (const Vec2 p : points) greatest = std::max(greatest, p.y);
  return greatest;
}

/// Draws one picture.
class CurvaturePainter {
 public:
  explicit CurvaturePainter(const CurvatureCurve& curve)
      : points_(finite_points(curve)),
        threshold_(threshold_of(points_)),
        length_m_(points_.empty() || points_.back().x <= 0.0 ? 1.0 : points_.back().x),
        axis_(0.0, greatest_of(points_), kArea),
        canvas_(kWidth_px, kHeight_px, kGround) {
    part_key_points(curve.key_s_m);
  }

  [[nodiscard]] Expected<std::string> png() {
    axis_.draw(canvas_);
    draw_places();
    draw_curve();
    draw_head();
    return canvas_.png();
  }

 private:
  [[nodiscard]] Vec2 at(Vec2 point) const {
    return {kArea.left + kArea.width * point.x / length_m_, axis_.y_of(point.y)};
  }

  void part_key_points(std::span<const double> places) {
    for (const double s : places) {
      const auto point = std::ranges::lower_bound(points_, s, {}, &Vec2::x);
      if (point == points_.end()) continue;
      (point->y >= threshold_ ? reaching_ : other_).push_back(at(*point));
    }
  }

  void draw_curve() {
    std::vector<Vec2> line;
    for (const Vec2 p : points_) line.push_back(at(p));
    canvas_.line(line, {2.5, kPlotCurve, {}});
    const double y = axis_.y_of(threshold_);
    canvas_.line(std::array{Vec2{kArea.left, y}, Vec2{kArea.left + kArea.width, y}},
                 {2.0, kPlotThreshold, {10.0, 8.0}});
    for (const Vec2 place : other_) draw_ring(place);
    canvas_.dots(reaching_, kKey_px + 1.5, kGround);
    canvas_.dots(reaching_, kKey_px, kKey);
  }

  void draw_ring(Vec2 place) {
    canvas_.dots(std::array{place}, kKey_px, kGround);
    canvas_.circle(place, kKey_px - 1.0, {2.0, kKey, {}});
  }

  void draw_places() {
    const double step = round_length(length_m_ / 6.0);
    constexpr double kRounding = 1e-6;  // a tick may lie on the end
    const int ticks = static_cast<int>(std::floor(length_m_ / step + kRounding));
    const double y = kArea.top + kArea.height + 24.0;
    for (int i = 0; i <= ticks; ++i) {
      canvas_.text({at({step * i, 0.0}).x, y}, fmt::format("{:g}", step * i),
                   {.size = 17.0, .colour = kFaintText, .align = Align::kCentre});
    }
    canvas_.text({kArea.left, y + 24.0}, "place along the points in their order, m",
                 {.size = 17.0, .colour = kFaintText});
  }

  void draw_head() {
    const double upper = kArea.top - 50.0;
    const double lower = kArea.top - 20.0;
    canvas_.text({kArea.left, upper}, "curvature 1 / rho, 1/m",
                 {.size = 18.0, .colour = kText, .bold = true});
    double x = kArea.left;
    x = name(x, lower, fmt::format("threshold [k] = k_avg = {:.3g}", threshold_), kPlotThreshold) + 40.0;
    if (reaching_.empty() && other_.empty()) return;
    canvas_.dots(std::array{Vec2{x - 12.0, lower - 6.0}}, kKey_px, kKey);
    x = name(x, lower, fmt::format("key points that reach it ({})", reaching_.size()), kKey) + 40.0;
    draw_ring({x - 12.0, lower - 6.0});
    name(x, lower, fmt::format("others: ends and gaps ({})", other_.size()), kKey);
  }

  /// Returns where the text ends.
  double name(double x, double y, std::string_view text, Colour colour) {
    const TextStyle style{.size = 17.0, .colour = colour};
    canvas_.text({x, y}, text, style);
    return x + canvas_.text_width(text, style);
  }

  std::vector<Vec2> points_;
  double threshold_;
  double length_m_;
  ValueAxis axis_;
  Canvas canvas_;
  std::vector<Vec2> reaching_;  // key points, pixels
  std::vector<Vec2> other_;
};

}  // namespace

std::vector<CurvatureCurve> curvature_curves(const Trace& trace) {
  std::vector<CurvatureCurve> curves;
  for (const Trace::Values& values : trace.values) {
    if (values.name == "s") curves.push_back({values.values, {}, {}});
    if (curves.empty()) continue;
    if (values.name == "kappa") curves.back().kappa_1_m = values.values;
    if (values.name == "key s") curves.back().key_s_m = values.values;
  }
  std::erase_if(curves, [](const CurvatureCurve& curve) {
    return curve.s_m.empty() || curve.s_m.size() != curve.kappa_1_m.size();
  });
  return curves;
}

Expected<std::string> curvature_png(const CurvatureCurve& curve) { return CurvaturePainter(curve).png(); }

}  // namespace verge::emit

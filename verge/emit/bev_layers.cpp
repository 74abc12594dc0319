// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/bev_layers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string_view>

#include <fmt/core.h>

#include "verge/emit/bev_theme.hpp"

namespace verge::emit {
namespace {

constexpr double kScanRadius = 1.3;

/// Points to be drawn in the colour of their height, the higher ones on top, as seen from above.
class HeightDots {
 public:
  HeightDots(const HeightScale& scale, const BevView& view) : scale_(scale), view_(view) {}

  void add(Vec3 p) {
    const Vec2 at = view_.at(p.xy());
    if (view_.shows(at)) places_.push_back({at, scale_.shade(scale_.height(p))});
  }

  void draw(Canvas& canvas, double strength) {
    std::stable_sort(places_.begin(), places_.end(),
                     [](const Place& a, const Place& b) { return a.shade < b.shade; });
    std::vector<Vec2> same;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      same.push_back(places_[i].at);
      const std::size_t shade = places_[i].shade;
      if (i + 1 < places_.size() && places_[i + 1].shade == shade) continue;
      canvas.dots(same, view_.px(kScanRadius), HeightScale::colour(shade).faded(strength));
      same.clear();
    }
  }

 private:
  struct Place {
    Vec2 at;
    std::size_t shade = 0;
  };
  const HeightScale& scale_;
  const BevView& view_;
  std::vector<Place> places_;
};

/// What a layer's dots are coloured by.
enum class Hue { kOwn, kGroup, kHeight };

/// How a layer of the trace is drawn.
struct LayerStyle {
  std::string_view name;
  std::string_view label;
  double radius = 3.0;
  double rim = 0.0;  ///< Width of a dark rim that lifts the dots off what lies below.
  Hue hue = Hue::kOwn;
  Colour colour;
  Depth depth = Depth::kUnder;
};

constexpr std::string_view kGateLayer = "low";

constexpr std::array kPointStyles = std::to_array<LayerStyle>({
    {kGateLayer, "below the height gate", kScanRadius, 0.0, Hue::kHeight, {}, Depth::kUnder},
    {"gradient points", "gradient points", 2.0, 0.8, Hue::kGroup, rgb(0xE6EDF3), Depth::kUnder},
    {"candidates", "candidates", 3.0, 1.2, Hue::kOwn, rgb(0xFFD54A), Depth::kUnder},
    {"clusters", "clusters", 3.4, 1.2, Hue::kGroup, rgb(0xFF6FB5), Depth::kUnder},
    {"key points", "key points", 4.0, 2.0, Hue::kOwn, rgb(0xFFFFFF), Depth::kOver},
    {"centroids", "centroids", 8.0, 3.0, Hue::kOwn, rgb(0xFFFFFF), Depth::kOver},
});
constexpr LayerStyle kOtherPoints{{}, {}, 3.0, 1.0, Hue::kGroup, rgb(0xE6EDF3), Depth::kUnder};

LayerStyle style_of(const Trace::Points& layer) {
  for (const LayerStyle& style : kPointStyles) {
    if (style.name == layer.name) return style;
  }
  LayerStyle style = kOtherPoints;
  style.label = layer.name;
  return style;
}

/// How the lines whose names begin with a prefix are drawn, all with one entry of the legend.
struct LineStyle {
  std::string_view prefix;
  std::string_view label;
  Colour colour;
};

/// Lines that methods of paper 2 put through points: solid, in the paper's colours where it has some.
constexpr std::array kLineStyles = std::to_array<LineStyle>({
    {"least_squares ", "least squares", rgb(0xFF3B3B)},
    {"theil_sen ", "Theil and Sen", rgb(0x2FD651)},
    {"polynomial ", "polynomial", rgb(0xFF5FD2)},
    {"hough segment ", "Hough segments", rgb(0xFFB000)},
});

const LineStyle* style_of(const Trace::Line& layer) {
  const auto* const style = std::ranges::find_if(
      kLineStyles, [&](const LineStyle& one) { return layer.name.starts_with(one.prefix); });
  return style == kLineStyles.end() ? nullptr : &*style;
}

LegendSign sign_of(Hue hue) {
  return hue == Hue::kGroup    ? LegendSign::kGroups
         : hue == Hue::kHeight ? LegendSign::kHeights
                               : LegendSign::kDot;
}

std::vector<Vec2> places_of(const BevView& view, const std::vector<Vec3>& points) {
  std::vector<Vec2> places;
  places.reserve(points.size());
  for (const Vec3 p : points) places.push_back(view.at(p.xy()));
  return places;
}

void draw_groups(Canvas& canvas, const BevView& view, const Trace::Points& layer, double radius) {
  std::map<int, std::vector<Vec2>> places;
  for (std::size_t i = 0; i < layer.points.size(); ++i) {
    places[layer.group[i]].push_back(view.at(layer.points[i].xy()));
  }
  for (const auto& [group, members] : places) canvas.dots(members, radius, group_colour(group));
}

void draw_layer(Canvas& canvas, const BevView& view, const HeightScale& scale, const Trace::Points& layer,
                const LayerStyle& style) {
  const double radius = view.px(style.radius);
  const std::vector<Vec2> places = places_of(view, layer.points);
  if (style.rim > 0.0) canvas.dots(places, radius + view.px(style.rim), kGround.faded(0.8));
  if (style.hue == Hue::kOwn) canvas.dots(places, radius, style.colour);
  if (style.hue == Hue::kGroup) draw_groups(canvas, view, layer, radius);
  if (style.hue == Hue::kHeight) {
    HeightDots dots(scale, view);
    for (const Vec3 p : layer.points) dots.add(p);
    dots.draw(canvas, 1.0);
  }
}

LegendEntry entry_of(const Trace::Points& layer, const LayerStyle& style) {
  const std::string text = fmt::format("{} ({})", style.label, layer.points.size());
  const bool one_group =
      style.hue == Hue::kGroup && std::all_of(layer.group.begin(), layer.group.end(),
                                              [&](int group) { return group == layer.group.front(); });
  if (one_group) return {LegendSign::kDot, group_colour(layer.group.front()), text};
  return {sign_of(style.hue), style.colour, text};
}

/// Lines, dotted where they have no style of their own; one entry of the legend for all of one name or style.
void draw_lines(Canvas& canvas, const BevView& view, const std::vector<Trace::Line>& layers, Legend& legend) {
  for (const Trace::Line& layer : layers) {
    const LineStyle* style = style_of(layer);
    const Stroke stroke = style != nullptr ? Stroke{view.px(4.0), style->colour, {}}
                                           : Stroke{view.px(2.5), kTraceLine, {view.px(0.5), view.px(6.0)}};
    canvas.line(view.line(layer.points), stroke);
    const std::string text(style != nullptr ? style->label : std::string_view(layer.name));
    const bool named = std::ranges::find(legend, text, &LegendEntry::text) != legend.end();
    const LegendSign sign = style != nullptr ? LegendSign::kLine : LegendSign::kDottedLine;
    if (!named) legend.push_back({sign, stroke.colour, text});
  }
}

/// Points of one state, at least two, in one stroke.
struct Stretch {
  PointState state = PointState::kVisible;
  std::vector<Vec3> points;
};

/// A segment is as well known as the worse known of its ends.
std::vector<Stretch> stretches_of(const Boundary& boundary) {
  if (boundary.state.size() != boundary.points.size()) return {{PointState::kVisible, boundary.points}};
  std::vector<Stretch> stretches;
  for (std::size_t i = 1; i < boundary.points.size(); ++i) {
    const PointState state = std::max(boundary.state[i - 1], boundary.state[i]);
    if (stretches.empty() || stretches.back().state != state) {
      stretches.push_back({state, {boundary.points[i - 1]}});
    }
    stretches.back().points.push_back(boundary.points[i]);
  }
  return stretches;
}

std::vector<double> dashes_of(const BevView& view, PointState state) {
  switch (state) {
    case PointState::kVisible:
      return {};
    case PointState::kBridged:
      return {view.px(16.0), view.px(12.0)};
    case PointState::kOccluded:
      return {view.px(0.5), view.px(13.0)};
  }
  return {};
}

/// A boundary of one point (another program's loose points) is a dot.
void draw_single_point(Canvas& canvas, const BevView& view, const Boundary& boundary) {
  const Vec2 at = view.at(boundary.points.front().xy());
  canvas.dots(std::array{at}, view.px(6.0), kGround);
  canvas.dots(std::array{at}, view.px(4.0), side_colour(boundary.side));
}

void draw_boundary(Canvas& canvas, const BevView& view, const Boundary& boundary) {
  if (boundary.points.size() == 1) draw_single_point(canvas, view, boundary);
  if (boundary.points.size() < 2) return;
  canvas.line(view.line(boundary.points), {view.px(13.0), kGround.faded(0.85), {}});
  for (const Stretch& stretch : stretches_of(boundary)) {
    canvas.line(view.line(stretch.points),
                {view.px(7.0), side_colour(boundary.side), dashes_of(view, stretch.state)});
  }
}

std::string_view label_of(Side side) {
  switch (side) {
    case Side::kLeft:
      return "left boundary";
    case Side::kRight:
      return "right boundary";
    case Side::kIsland:
      return "island";
    case Side::kOther:
      return "boundary";
  }
  return {};
}

}  // namespace

Colour side_colour(Side side) {
  switch (side) {
    case Side::kLeft:
      return rgb(0xFF6B35);
    case Side::kRight:
      return rgb(0x4CC9FF);
    case Side::kIsland:
      return rgb(0xD58CFF);
    case Side::kOther:
      return rgb(0xF4F1EA);
  }
  return {};
}

HeightScale::HeightScale(const Scan& scan, const BevPlot::Config& config)
    : level_(scan.mount.value_or(Mount{})), min_m_(config.height_min_m), max_m_(config.height_max_m) {
  if (scan.mount || scan.size() == 0) return;
  std::vector<double> heights(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) heights[i] = height(scan.point(i));
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 20);
  std::nth_element(heights.begin(), low, heights.end());
  zero_m_ = *low;
}

std::size_t HeightScale::shade(double height_m) const {
  if (!(height_m <= max_m_)) return kShades;  // also what is not a number
  const double t = std::max(0.0, (height_m - min_m_) / (max_m_ - min_m_));
  return static_cast<std::size_t>(t * static_cast<double>(kShades - 1) + 0.5);
}

Colour HeightScale::colour(std::size_t shade) {
  return shade >= kShades ? kAboveScale
                          : height_colour(static_cast<double>(shade) / static_cast<double>(kShades - 1));
}

void draw_scan(Canvas& canvas, const BevView& view, const HeightScale& scale, const BevContent& content,
               double ceiling_m) {
  const bool gated = content.trace != nullptr && content.trace->find_points(kGateLayer) != nullptr;
  const Scan& scan = content.scan;
  HeightDots dots(scale, view);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vec3 p = scan.point(i);
    if (scan.range[i] > 0.0F && scale.height(p) <= ceiling_m) dots.add(p);
  }
  dots.draw(canvas, gated ? 0.5 : 1.0);
}

void draw_trace(Canvas& canvas, const BevView& view, const HeightScale& scale, const Trace& trace,
                Depth depth, Legend& legend) {
  for (const Trace::Points& layer : trace.points) {
    LayerStyle style = style_of(layer);
    if (style.depth != depth || layer.points.empty()) continue;
    if (style.hue == Hue::kGroup && layer.group.size() != layer.points.size()) style.hue = Hue::kOwn;
    draw_layer(canvas, view, scale, layer, style);
    legend.push_back(entry_of(layer, style));
  }
  if (depth == Depth::kOver) draw_lines(canvas, view, trace.lines, legend);
}

void draw_boundaries(Canvas& canvas, const BevView& view, const Scene& scene, Legend& legend) {
  std::array<std::size_t, enum_names<Side>.size()> count{};
  for (const Boundary& boundary : scene.boundaries) {
    draw_boundary(canvas, view, boundary);
    ++count[static_cast<std::size_t>(boundary.side)];
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] == 0) continue;
    const auto side = static_cast<Side>(i);
    const std::string many = count[i] > 1 ? fmt::format(" ({})", count[i]) : std::string();
    legend.push_back({LegendSign::kLine, side_colour(side), std::string(label_of(side)) + many});
  }
}

void draw_corners(Canvas& canvas, const BevView& view, const Scene& scene, Legend& legend) {
  for (const Corner& corner : scene.corners) {
    const Vec2 at = view.at(corner.position);
    const Colour colour = side_colour(corner.side == CornerSide::kRight ? Side::kRight : Side::kLeft);
    if (!view.shows(at)) continue;
    canvas.dots(std::array{at}, view.px(12.0), kGround);
    canvas.dots(std::array{at}, view.px(9.0), colour);
    if (corner.sigma_m) {
      canvas.circle(at, view.px(12.0) + *corner.sigma_m * view.pixels_a_metre(), {view.px(2.0), colour, {}});
    }
  }
  if (!scene.corners.empty())
    legend.push_back({LegendSign::kDot, kText, fmt::format("corners ({})", scene.corners.size())});
}

void draw_true_corner(Canvas& canvas, const BevView& view, const Corner& corner) {
  const Vec2 at = view.at(corner.position);
  if (!view.shows(at)) return;
  const double arm = view.px(11.0);
  const Stroke stroke{view.px(3.0), corner.confidence > 0.0 ? kTruth : kTruth.faded(0.45), {}};
  canvas.line(std::array{at - Vec2{arm, arm}, at + Vec2{arm, arm}}, stroke);
  canvas.line(std::array{at - Vec2{arm, -arm}, at + Vec2{arm, -arm}}, stroke);
}

void draw_truth(Canvas& canvas, const BevView& view, const Scene& truth, Legend& legend) {
  for (const Corner& corner : truth.corners) draw_true_corner(canvas, view, corner);
  for (const Boundary& boundary : truth.boundaries) {
    const std::vector<Vec2> line = view.line(boundary.points);
    if (line.size() == 1) canvas.dots(line, view.px(3.0), kTruth);
    if (line.size() > 1) canvas.line(line, {view.px(2.5), kTruth, {view.px(9.0), view.px(9.0)}});
  }
  if (!truth.boundaries.empty()) legend.push_back({LegendSign::kDashedLine, kTruth, "truth"});
  if (!truth.corners.empty()) legend.push_back({LegendSign::kDot, kTruth, "true corners (crosses)"});
}

}  // namespace verge::emit

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/bev_furniture.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "verge/core/round_length.hpp"
#include "verge/emit/bev_theme.hpp"

namespace verge::emit {
namespace {

constexpr double kMargin = 28.0;   // from the picture's edge to a panel
constexpr double kPadding = 18.0;  // from a panel's edge to its text

TextStyle text_style(const BevView& view, double size, Colour colour, Align align = Align::kLeft) {
  return {view.px(size), colour, false, align, {0.0, 0.0, 0.0, 0.0}};
}

void panel(Canvas& canvas, const BevView& view, Vec2 upper_left, Vec2 size) {
  canvas.rounded_box(upper_left, size, view.px(10.0), kPanel, {view.px(1.0), kPanelEdge, {}});
}

/// Distance between range rings, metres: two to five of them on the way to the nearest edge.
double ring_step_m(const BevView& view) {
  return round_length(0.5 * view.size() / view.pixels_a_metre() / 2.0);
}

/// The letters of a text: UTF-8 sequences.
std::vector<std::string> letters_of(std::string_view text) {
  std::vector<std::string> letters;
  for (const char c : text) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
    if (!continues || letters.empty()) letters.emplace_back();
    letters.back().push_back(c);
  }
  return letters;
}

/// `text`, with as many letters in its middle replaced by an ellipsis as it takes to fit: names of recordings
/// differ at their ends.
std::string fitted(const Canvas& canvas, const std::string& text, const TextStyle& style, double width) {
  if (canvas.text_width(text, style) <= width) return text;
  const std::vector<std::string> letters = letters_of(text);
  for (std::size_t kept = letters.size() - 1; kept > 0; --kept) {
    const auto head = letters.begin() + static_cast<std::ptrdiff_t>(kept - kept / 2);
    const auto tail = letters.end() - static_cast<std::ptrdiff_t>(kept / 2);
    const std::string shorter =
        fmt::format("{}…{}", fmt::join(letters.begin(), head, ""), fmt::join(tail, letters.end(), ""));
    if (canvas.text_width(shorter, style) <= width) return shorter;
  }
  return "…";
}

std::vector<std::string> caption_of(const BevContent& content) {
  const std::size_t count = content.scene.boundaries.size();
  std::vector<std::string> lines;
  const std::string found = fmt::format("{} {}", count, count == 1 ? "boundary" : "boundaries");
  const bool is_of_method = !content.scene.method.empty();
  if (is_of_method || count > 0)
    lines.push_back(is_of_method ? content.scene.method + "  ·  " + found : found);
  if (content.scan.mount) {
    lines.push_back(fmt::format("sensor {:.2f} m above the road", content.scan.mount->height_m));
  }
  for (std::string& line : lines) line = escape_control_bytes(line);
  return lines;
}

/// Three dots side by side.
void draw_three_dots(Canvas& canvas, const BevView& view, Vec2 middle, const std::array<Colour, 3>& colours) {
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double x = middle.x + view.px(12.0) * (static_cast<double>(i) - 1.0);
    canvas.dots(std::array{Vec2{x, middle.y}}, view.px(5.0), colours[i]);
  }
}

void draw_sign(Canvas& canvas, const BevView& view, const LegendEntry& entry, Vec2 left) {
  const double width = view.px(34.0);
  const std::array<Vec2, 2> line{left, Vec2{left.x + width, left.y}};
  const Vec2 middle{left.x + 0.5 * width, left.y};
  switch (entry.sign) {
    case LegendSign::kLine:
      return canvas.line(line, {view.px(7.0), entry.colour, {}});
    case LegendSign::kDashedLine:
      return canvas.line(line, {view.px(2.5), entry.colour, {view.px(9.0), view.px(9.0)}});
    case LegendSign::kDottedLine:
      return canvas.line(line, {view.px(2.5), entry.colour, {view.px(0.5), view.px(6.0)}});
    case LegendSign::kDot:
      return canvas.dots(std::array{middle}, view.px(5.0), entry.colour);
    case LegendSign::kGroups:
      return draw_three_dots(canvas, view, middle, {group_colour(0), group_colour(1), group_colour(2)});
    case LegendSign::kHeights:
      return draw_three_dots(canvas, view, middle,
                             {height_colour(0.1), height_colour(0.4), height_colour(0.7)});
  }
}

/// As many entries as leave the picture more room than the legend.
Legend shortened(Legend legend) {
  constexpr std::size_t kMost = 14;
  if (legend.size() <= kMost) return legend;
  const std::size_t left_out = legend.size() - (kMost - 1);
  legend.resize(kMost - 1);
  legend.push_back({LegendSign::kDot, kFaintText, fmt::format("and {} more", left_out)});
  return legend;
}

/// The colour bar's gradient, and right of it what lies above the scale.
void draw_gradient(Canvas& canvas, const BevView& view, Vec2 at, Vec2 size) {
  constexpr int kShades = 128;
  for (int i = 0; i < kShades; ++i) {
    const double left = at.x + size.x * i / kShades;
    const double right = at.x + size.x * (i + 1) / kShades;
    canvas.box({left, at.y}, {right - left + 0.5, size.y}, height_colour((i + 0.5) / kShades));
  }
  canvas.box({at.x + size.x + view.px(26.0), at.y}, {view.px(30.0), size.y}, kAboveScale);
}

void draw_ticks(Canvas& canvas, const BevView& view, const BevPlot::Config& config, Vec2 left, double width) {
  const double span_m = config.height_max_m - config.height_min_m;
  const double step_m = round_length(span_m / 3.0);
  const TextStyle style = text_style(view, 18.0, kFaintText, Align::kCentre);
  const auto first = static_cast<int>(std::ceil(config.height_min_m / step_m - 1e-9));
  const auto last = static_cast<int>(std::floor(config.height_max_m / step_m + 1e-9));
  for (int tick = first; tick <= last; ++tick) {
    const double x = left.x + width * (tick * step_m - config.height_min_m) / span_m;
    canvas.text({x, left.y}, fmt::format("{:.4g}", tick * step_m), style);
  }
}

}  // namespace

void draw_rings(Canvas& canvas, const BevView& view) {
  const double step = view.pixels_a_metre() * ring_step_m(view);
  const int rings = static_cast<int>(1.5 * view.size() / step);
  for (int i = 1; i <= rings; ++i) canvas.circle(view.origin(), i * step, {view.px(1.5), kRing, {}});
}

void draw_ring_labels(Canvas& canvas, const BevView& view) {
  const double step_m = ring_step_m(view);
  TextStyle style = text_style(view, 20.0, kText, Align::kCentre);
  style.halo = kGround.faded(0.8);
  for (int ring = 1;; ++ring) {
    const double y = view.origin().y - view.pixels_a_metre() * step_m * ring;
    if (y < -0.5) return;
    canvas.text({view.origin().x, y + view.px(25.0)}, fmt::format("{:g} m", step_m * ring), style);
  }
}

void draw_vehicle(Canvas& canvas, const BevView& view) {
  const Vec2 o = view.origin();
  const double u = view.px(1.0);
  const std::array<Vec2, 4> arrow{Vec2{o.x, o.y - 24.0 * u}, Vec2{o.x + 16.0 * u, o.y + 18.0 * u},
                                  Vec2{o.x, o.y + 9.0 * u}, Vec2{o.x - 16.0 * u, o.y + 18.0 * u}};
  canvas.polygon(arrow, kText, {view.px(8.0), kGround.faded(0.85), {}});
  canvas.polygon(arrow, kText, {view.px(2.0), kText, {}});
}

void draw_caption(Canvas& canvas, const BevView& view, const BevContent& content) {
  const TextStyle body = text_style(view, 22.0, kFaintText);
  const double room = 0.5 * view.size() - view.px(kMargin + 2.0 * kPadding + 60.0);
  TextStyle title = text_style(view, 34.0, kText);
  title.bold = true;
  const std::string frame = escape_control_bytes(content.scan.frame);
  if (canvas.text_width(frame, title) > room) title.size = view.px(22.0);
  const std::string name = fitted(canvas, frame, title, room);
  double width = canvas.text_width(name, title);
  std::vector<std::string> lines = caption_of(content);
  for (std::string& line : lines) {
    line = fitted(canvas, line, body, room);
    width = std::max(width, canvas.text_width(line, body));
  }
  const double line_height = view.px(32.0);
  const Vec2 at{view.px(kMargin), view.px(kMargin)};
  const double height = view.px(2.0 * kPadding + 30.0) + line_height * static_cast<double>(lines.size());
  panel(canvas, view, at, {width + view.px(2.0 * kPadding), height});
  Vec2 text{at.x + view.px(kPadding), at.y + view.px(kPadding + 27.0)};
  canvas.text(text, name, title);
  for (const std::string& line : lines) {
    text.y += line_height;
    canvas.text(text, line, body);
  }
}

void draw_legend(Canvas& canvas, const BevView& view, Legend legend) {
  if (legend.empty()) return;
  legend = shortened(std::move(legend));
  const TextStyle style = text_style(view, 22.0, kText);
  const double sign = view.px(50.0);
  const double line_height = view.px(33.0);
  const double room = 0.5 * view.size() - view.px(kMargin + 2.0 * kPadding + 60.0) - sign;
  double width = 0.0;
  for (LegendEntry& entry : legend) {
    entry.text = fitted(canvas, escape_control_bytes(entry.text), style, room);
    width = std::max(width, canvas.text_width(entry.text, style));
  }
  const Vec2 size{width + sign + view.px(2.0 * kPadding),
                  line_height * static_cast<double>(legend.size()) + view.px(2.0 * kPadding - 8.0)};
  const Vec2 at{view.size() - view.px(kMargin) - size.x, view.px(kMargin)};
  panel(canvas, view, at, size);
  Vec2 left{at.x + view.px(kPadding), at.y + view.px(kPadding - 4.0) + 0.5 * line_height};
  for (const LegendEntry& entry : legend) {
    draw_sign(canvas, view, entry, left);
    canvas.text({left.x + sign, left.y + view.px(8.0)}, entry.text, style);
    left.y += line_height;
  }
}

void draw_scale_bar(Canvas& canvas, const BevView& view) {
  const double length_m = round_length(0.2 * view.size() / view.pixels_a_metre());
  const double length = length_m * view.pixels_a_metre();
  const Vec2 size{length + view.px(2.0 * kPadding), view.px(76.0)};
  const Vec2 at{view.px(kMargin), view.size() - view.px(kMargin) - size.y};
  panel(canvas, view, at, size);
  const double left = at.x + view.px(kPadding);
  const double low = at.y + size.y - view.px(kPadding);
  const double tick = view.px(10.0);
  const std::array<Vec2, 4> bar{Vec2{left, low - tick}, Vec2{left, low}, Vec2{left + length, low},
                                Vec2{left + length, low - tick}};
  canvas.line(bar, {view.px(3.0), kText, {}});
  canvas.text({left + 0.5 * length, low - view.px(14.0)}, fmt::format("{:g} m", length_m),
              text_style(view, 22.0, kText, Align::kCentre));
}

void draw_colour_bar(Canvas& canvas, const BevView& view, const BevPlot::Config& config, bool above_road) {
  const Vec2 bar{view.px(310.0), view.px(16.0)};
  const Vec2 size{bar.x + view.px(2.0 * kPadding + 74.0), view.px(104.0)};
  const Vec2 at{view.size() - view.px(kMargin) - size.x, view.size() - view.px(kMargin) - size.y};
  panel(canvas, view, at, size);
  const Vec2 gradient{at.x + view.px(kPadding + 10.0), at.y + view.px(kPadding + 28.0)};
  canvas.text({gradient.x, gradient.y - view.px(13.0)},
              above_road ? "height above the road, m" : "height above the lowest points, m",
              text_style(view, 20.0, kText));
  draw_gradient(canvas, view, gradient, bar);
  const double ticks = gradient.y + bar.y + view.px(21.0);
  draw_ticks(canvas, view, config, {gradient.x, ticks}, bar.x);
  canvas.text({gradient.x + bar.x + view.px(41.0), ticks}, "more",
              text_style(view, 18.0, kFaintText, Align::kCentre));
}

}  // namespace verge::emit

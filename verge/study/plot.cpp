// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "verge/core/round_length.hpp"
#include "verge/study/markup.hpp"

namespace verge::study {
namespace {

constexpr double kWidth = 640.0;
constexpr double kHeight = 380.0;
constexpr double kLeft = 62.0;
constexpr double kRight = 16.0;
constexpr double kTop = 14.0;
constexpr double kBelow = 46.0;  // ticks and the label of x
constexpr double kLegendLine = 20.0;
constexpr double kTicks = 4.0;  // at least so many stretches between ticks
constexpr std::size_t kStyles = 6;

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double length() const { return high - low; }
};

bool is_finite(const PlotPoint& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

/// From values to pixels, and the ticks along both.
class Frame {
 public:
  explicit Frame(const Plot& plot) {
    y_.take(plot.y_min);
    for (const Series& series : plot.series) {
      for (const PlotPoint& point : series.points) take(point);
    }
    if (!plot.x_names.empty()) x_ = {-0.5, static_cast<double>(plot.x_names.size()) - 0.5};
    if (plot.x_range) x_ = {plot.x_range->first, plot.x_range->second};
    const double rim = 0.02 * x_.length();  // so that no sign is cut in half
    x_ = {x_.low - rim, x_.high + rim};
    if (!(x_.length() > 0.0)) x_ = {x_.low - 0.5, x_.high + 0.5};
    if (!(y_.length() > 0.0)) y_.high = y_.low + 1.0;
    y_.high = plot.y_max ? *plot.y_max : next_tick(y_);
  }

  [[nodiscard]] double x(double value) const {
    return kLeft + (value - x_.low) / x_.length() * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double y(double value) const {
    return kHeight - kBelow - (value - y_.low) / y_.length() * (kHeight - kBelow - kTop);
  }
  [[nodiscard]] std::vector<double> x_ticks() const { return ticks(x_); }
  [[nodiscard]] std::vector<double> y_ticks() const { return ticks(y_); }

 private:
  void take(const PlotPoint& point) {
    if (!is_finite(point)) return;
    x_.take(point.x);
    y_.take(point.y);
    if (point.between) y_.take(point.between->second);
  }

  /// The end of the span, or the tick above it: what is highest is then read between two ticks.
  [[nodiscard]] static double next_tick(const Span& span) {
    const double step = round_length(span.length() / kTicks);
    return std::ceil(span.high / step) * step;
  }

  [[nodiscard]] static std::vector<double> ticks(const Span& span) {
    const double step = round_length(span.length() / kTicks);
    constexpr double kSlack = 1e-9;  // an end of the span is a tick though it is rounded
    const long first = std::lround(std::ceil(span.low / step - kSlack));
    const long last = std::lround(std::floor(span.high / step + kSlack));
    std::vector<double> values;
    for (long k = first; k <= last; ++k) values.push_back(static_cast<double>(k) * step);
    return values;
  }

  Span x_;
  Span y_;
};

std::string text_at(double x, double y, std::string_view anchor, std::string_view text) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor,
                     escape_markup(text));
}

std::string grid_line(double x1, double y1, double x2, double y2) {
  return fmt::format(R"(<line class="grid" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)", x1, y1, x2,
                     y2);
}

/// A number as short as it is; -0 is 0.
std::string tick_text(double value) { return fmt::format("{:.6g}", std::fabs(value) < 1e-12 ? 0.0 : value); }

/// Whether the names along x stand beside each other; else they are numbered, and stand below.
bool names_fit(const Plot& plot) {
  constexpr double kLetter = 7.5;  // of 13 px
  const double room =
      (kWidth - kLeft - kRight) / static_cast<double>(std::max<std::size_t>(1, plot.x_names.size()));
  return std::ranges::all_of(plot.x_names, [&](const std::string& name) {
    return kLetter * static_cast<double>(name.size()) <= room;
  });
}

std::string x_axis(const Plot& plot, const Frame& frame) {
  std::string svg;
  const double bottom = kHeight - kBelow;
  if (plot.x_names.empty()) {
    for (const double tick : frame.x_ticks()) {
      svg += grid_line(frame.x(tick), kTop, frame.x(tick), bottom);
      svg += text_at(frame.x(tick), bottom + 16.0, "middle", tick_text(tick));
    }
  }
  const bool fit = names_fit(plot);
  for (std::size_t i = 0; i < plot.x_names.size(); ++i) {
    const std::string name = fit ? plot.x_names[i] : std::to_string(i + 1);
    svg += text_at(frame.x(static_cast<double>(i)), bottom + 16.0, "middle", name);
  }
  return svg + text_at(0.5 * (kLeft + kWidth - kRight), kHeight - 8.0, "middle", plot.x_label);
}

std::string y_axis(const Plot& plot, const Frame& frame) {
  std::string svg;
  for (const double tick : frame.y_ticks()) {
    svg += grid_line(kLeft, frame.y(tick), kWidth - kRight, frame.y(tick));
    svg += text_at(kLeft - 6.0, frame.y(tick) + 4.0, "end", tick_text(tick));
  }
  const double middle = 0.5 * (kTop + kHeight - kBelow);
  return svg +
         fmt::format(
             R"svg(<text transform="translate(15 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
             middle, escape_markup(plot.y_label));
}

/// A series' sign: told apart by shape, since not everybody tells colours apart.
std::string sign_at(std::size_t style, double x, double y) {
  constexpr double r = 4.0;
  switch (style) {
    case 0:
      return fmt::format(R"(<circle class="f0" cx="{:.1f}" cy="{:.1f}" r="{}"/>)", x, y, r);
    case 1:
      return fmt::format(R"(<rect class="f1" x="{:.1f}" y="{:.1f}" width="{}" height="{}"/>)", x - r, y - r,
                         2 * r, 2 * r);
    case 2:
      return fmt::format(R"(<path class="f2" d="M{:.1f} {:.1f}l{} {}h{}z"/>)", x, y - r - 1, r + 1, 2 * r + 1,
                         -2 * r - 2);
    case 3:
      return fmt::format(R"(<path class="f3" d="M{:.1f} {:.1f}l{} {} {} {} {} {}z"/>)", x, y - r - 1, r + 1,
                         r + 1, -r - 1, r + 1, -r - 1, -r - 1);
    case 4:
      return fmt::format(R"(<path class="s4" d="M{:.1f} {:.1f}l{} {}m0 {}l{} {}"/>)", x - r, y - r, 2 * r,
                         2 * r, -2 * r, -2 * r, 2 * r);
    default:
      return fmt::format(R"(<path class="s5" d="M{:.1f} {:.1f}v{}m{} {}h{}"/>)", x, y - r, 2 * r, -r, -r,
                         2 * r);
  }
}

std::string drawn_series(const Series& series, std::size_t style, const Frame& frame) {
  std::string line;
  std::string signs;
  for (const PlotPoint& point : series.points) {
    if (!is_finite(point)) continue;
    const double x = frame.x(point.x);
    const double y = frame.y(point.y);
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x, y);
    if (point.between) {
      signs += fmt::format(R"(<path class="s{}" d="M{:.1f} {:.1f}V{:.1f}"/>)", style, x,
                           frame.y(point.between->first), frame.y(point.between->second));
    }
    signs += sign_at(style, x, y);
  }
  if (line.empty()) return {};
  if (!series.joined) return signs;
  return fmt::format(R"(<path class="s{} d{}" d="{}"/>)", style, style, line) + signs;
}

std::size_t legend_lines(const Plot& plot) {
  return plot.series.size() + (names_fit(plot) ? 0 : plot.x_names.size());
}

std::string legend(const Plot& plot) {
  std::string svg;
  const auto y_of = [](std::size_t line) { return kHeight + 12.0 + kLegendLine * static_cast<double>(line); };
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const double y = y_of(i);
    const std::size_t style = i % kStyles;
    if (plot.series[i].joined)
      svg += fmt::format(R"(<path class="s{} d{}" d="M{} {:.1f}h36"/>)", style, style, kLeft, y);
    svg += sign_at(style, kLeft + 18.0, y) + text_at(kLeft + 46.0, y + 4.0, "start", plot.series[i].name);
  }
  if (names_fit(plot)) return svg;
  for (std::size_t i = 0; i < plot.x_names.size(); ++i) {
    const double y = y_of(plot.series.size() + i);
    svg += text_at(kLeft + 18.0, y + 4.0, "middle", std::to_string(i + 1));
    svg += text_at(kLeft + 46.0, y + 4.0, "start", plot.x_names[i]);
  }
  return svg;
}

bool has_points(const Plot& plot) {
  return std::ranges::any_of(
      plot.series, [](const Series& series) { return std::ranges::any_of(series.points, is_finite); });
}

}  // namespace

std::string to_svg(const Plot& plot, const std::string& id) {
  if (!has_points(plot)) return {};
  const Frame frame(plot);
  std::string svg =
      fmt::format(R"(<svg class="plot" role="img" aria-labelledby="{}-title {}-about" viewBox="0 0 {} {}">)"
                  R"(<title id="{}-title">{}</title><desc id="{}-about">{}</desc>)",
                  id, id, kWidth, kHeight + 6.0 + kLegendLine * static_cast<double>(legend_lines(plot)), id,
                  escape_markup(plot.title), id, escape_markup(plot.about));
  svg += x_axis(plot, frame) + y_axis(plot, frame);
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    svg += drawn_series(plot.series[i], i % kStyles, frame);
  return svg + legend(plot) + "</svg>\n";
}

std::string plot_style() {
  // Okabe and Ito's colours, darker on light ground and brighter on dark, so that all stand out by 3 to 1.
  return R"(:root{--s0:#0072b2;--s1:#c04a00;--s2:#00805e;--s3:#a6478a;--s4:#7a5c00;--s5:#37474f;--grid:#d5dbe1}
@media(prefers-color-scheme:dark){:root{--s0:#56b4e9;--s1:#ff8c42;--s2:#2fc69b;--s3:#e59acb;--s4:#e6c84c;--s5:#b8c4ce;--grid:#333d48}}
.plot{width:100%;max-width:40rem;height:auto}
.plot text{font-size:13px;fill:var(--ink)}
.grid{stroke:var(--grid);stroke-width:1}
.s0,.s1,.s2,.s3,.s4,.s5{fill:none;stroke-width:2}
.s0{stroke:var(--s0)}.s1{stroke:var(--s1)}.s2{stroke:var(--s2)}.s3{stroke:var(--s3)}.s4{stroke:var(--s4)}.s5{stroke:var(--s5)}
.f0{fill:var(--s0)}.f1{fill:var(--s1)}.f2{fill:var(--s2)}.f3{fill:var(--s3)}
.d1{stroke-dasharray:8 4}.d2{stroke-dasharray:2 3}.d3{stroke-dasharray:10 3 2 3}.d4{stroke-dasharray:5 3}.d5{stroke-dasharray:1 4}
)";
}

}  // namespace verge::study

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/width_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "verge/core/round_length.hpp"
#include "verge/emit/bev_layers.hpp"
#include "verge/emit/bev_theme.hpp"
#include "verge/emit/canvas.hpp"
#include "verge/emit/value_axis.hpp"

namespace verge::emit {
namespace {

constexpr double kWidth_px = 1200.0;
constexpr double kLeft_px = 90.0;
constexpr double kRight_px = 30.0;
constexpr double kPanel_px = 220.0;
constexpr double kHead_px = 44.0;  // a panel's title
constexpr double kFoot_px = 60.0;
constexpr Colour kCandidate = rgb(0xFFFFFF, 0.12);

/// A curve of a panel: its value at each scan, none where there is none.
struct Curve {
  std::string name;
  Colour colour;
  std::vector<std::optional<double>> values;
  bool dashed = false;
};

struct Panel {
  std::string title;
  std::vector<Curve> curves;
};

std::pair<double, double> range_of(const Panel& panel) {
  double low = 0.0;
  double high = 0.0;
  for (const Curve& curve : panel.curves) {
    for (const auto& value : curve.values) {
      if (!value) continue;
      low = std::min(low, *value);
      high = std::max(high, *value);
    }
  }
  return {low, high};
}

}  // namespace

/// Draws one picture.
class WidthPainter {
 public:
  explicit WidthPainter(const WidthPlot& plot)
      : plot_(plot), panels_(panels_of(plot)), canvas_(static_cast<int>(kWidth_px), height(), kGround) {}

  [[nodiscard]] Expected<std::string> png() {
    for (std::size_t i = 0; i < panels_.size(); ++i) draw(panels_[i], top_of(i), i == 0);
    draw_axis(top_of(panels_.size() - 1) + kPanel_px);
    return canvas_.png();
  }

 private:
  static double top_of(std::size_t panel) {
    return kHead_px + static_cast<double>(panel) * (kPanel_px + kHead_px);
  }
  [[nodiscard]] int height() const {
    return static_cast<int>(top_of(panels_.size() - 1) + kPanel_px + kFoot_px);
  }
  [[nodiscard]] double x_of(std::size_t scan) const {
    const double count = std::max(1.0, static_cast<double>(plot_.size()) - 1.0);
    return kLeft_px + (kWidth_px - kLeft_px - kRight_px) * static_cast<double>(scan) / count;
  }

  static std::vector<Panel> panels_of(const WidthPlot& plot) {
    std::vector<Panel> panels = {lengths_of(plot)};
    const auto add = [&](const std::string& title, const std::string& threshold,
                         std::optional<WidthPlot::Compared> WidthPlot::Row::*what) {
      Panel panel{title, {{title, kPlotCurve, {}}, {threshold, kPlotThreshold, {}, true}}};
      bool any = false;
      for (const auto& row : plot.scans_) {
        const auto& compared = row.*what;
        any = any || compared.has_value();
        panel.curves[0].values.push_back(compared ? std::optional(compared->value) : std::nullopt);
        panel.curves[1].values.push_back(compared ? std::optional(compared->threshold) : std::nullopt);
      }
      if (any) panels.push_back(std::move(panel));
    };
    add("first comparison: first line - last line, m", "DD_thres", &WidthPlot::Row::first);
    add("second comparison: first line - itself h scans before, m", "DS_thres", &WidthPlot::Row::second);
    add("K; shaded: corner-candidate state", "K_thres", &WidthPlot::Row::k);
    return panels;
  }

  static Panel lengths_of(const WidthPlot& plot) {
    Panel panel{"road length, m", {}};
    std::size_t lines = 0;
    for (const auto& row : plot.scans_) lines = std::max(lines, row.lengths_m.size());
    for (std::size_t line = 0; line < lines; ++line) {
      Curve curve{fmt::format("line {}", line + 1), group_colour(static_cast<int>(line)), {}};
      for (const auto& row : plot.scans_)
        curve.values.push_back(line < row.lengths_m.size() ? std::optional(row.lengths_m[line])
                                                           : std::nullopt);
      panel.curves.push_back(std::move(curve));
    }
    return panel;
  }

  void draw(const Panel& panel, double top, bool named) {
    const auto [low, high] = range_of(panel);
    const ValueAxis axis(low, high, {kLeft_px, top, kWidth_px - kLeft_px - kRight_px, kPanel_px});
    draw_states(top);
    axis.draw(canvas_);
    for (const Curve& curve : panel.curves) draw_curve(curve, axis);
    draw_corners(top, named);
    draw_head(panel, top);
  }

  void draw_states(double top) {
    const double half = 0.5 * (x_of(1) - x_of(0));
    for (std::size_t i = 0; i < plot_.size(); ++i) {
      if (plot_.scans_[i].candidate) canvas_.box({x_of(i) - half, top}, {2.0 * half, kPanel_px}, kCandidate);
    }
  }

  void draw_curve(const Curve& curve, const ValueAxis& axis) {
    std::vector<Vec2> line;
    const auto finish = [&] {
      const std::vector<double> dashes =
          curve.dashed ? std::vector<double>{10.0, 8.0} : std::vector<double>{};
      if (line.size() > 1) canvas_.line(line, {curve.dashed ? 2.0 : 2.5, curve.colour, dashes});
      line.clear();
    };
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      if (!curve.values[i]) finish();
      if (curve.values[i]) line.push_back({x_of(i), axis.y_of(*curve.values[i])});
    }
    finish();
  }

  void draw_corners(double top, bool named) {
    constexpr double kName_px = 120.0;
    double named_to = 0.0;
    double lower = 0.0;
    for (std::size_t i = 0; i < plot_.size(); ++i) {
      for (const CornerSide side : plot_.scans_[i].corners) {
        const Colour colour = side_colour(side == CornerSide::kRight ? Side::kRight : Side::kLeft);
        const double x = x_of(i);
        canvas_.line(std::array{Vec2{x, top}, Vec2{x, top + kPanel_px}}, {2.0, colour, {}});
        if (!named) continue;
        lower = x < named_to ? lower + 22.0 : 0.0;  // names that would lie over each other go down
        named_to = x + kName_px;
        const bool late = x > kWidth_px - kRight_px - kName_px;
        canvas_.text({x + (late ? -8.0 : 8.0), top + 20.0 + std::fmod(lower, 110.0)},
                     fmt::format("corner {}", enum_names<CornerSide>[static_cast<std::size_t>(side)]),
                     {.size = 17.0,
                      .colour = colour,
                      .align = late ? Align::kRight : Align::kLeft,
                      .halo = kGround.faded(0.8)});
      }
    }
  }

  void draw_head(const Panel& panel, double top) {
    const TextStyle title{.size = 18.0, .colour = kText, .bold = true};
    canvas_.text({kLeft_px, top - 14.0}, panel.title, title);
    double x = kLeft_px + canvas_.text_width(panel.title, title) + 30.0;
    for (std::size_t i = panel.curves.size() > 2 ? 0 : 1; i < panel.curves.size(); ++i) {
      const Curve& curve = panel.curves[i];
      const TextStyle style{.size = 17.0, .colour = curve.colour};
      canvas_.text({x, top - 14.0}, curve.name, style);
      x += canvas_.text_width(curve.name, style) + 22.0;
    }
  }

  void draw_axis(double bottom) {
    const auto step = static_cast<std::size_t>(
        std::max(1.0, round_length(std::max(1.0, static_cast<double>(plot_.size())) / 6.0)));
    for (std::size_t scan = 0; scan < plot_.size(); scan += step) {
      canvas_.text({x_of(scan), bottom + 24.0}, fmt::format("{}", scan),
                   {.size = 17.0, .colour = kFaintText, .align = Align::kCentre});
    }
    canvas_.text({kLeft_px, bottom + 48.0},
                 fmt::format("scans from {} to {}", plot_.first_frame_, plot_.last_frame_),
                 {.size = 17.0, .colour = kFaintText});
  }

  const WidthPlot& plot_;
  std::vector<Panel> panels_;
  Canvas canvas_;
};

std::optional<WidthPlot::Compared> WidthPlot::compared(const Trace& trace, const char* name) {
  const Trace::Values* values = trace.find_values(name);
  if (values == nullptr || values->values.size() != 2) return std::nullopt;
  return Compared{values->values[0], values->values[1]};
}

void WidthPlot::add(const Scene& scene, const Trace& trace) {
  Row row;
  if (const Trace::Values* lengths = trace.find_values("L")) row.lengths_m = lengths->values;
  row.first = compared(trace, "first comparison");
  row.second = compared(trace, "second comparison");
  row.k = compared(trace, "K");
  const Trace::Values* state = trace.find_values("CCS");
  row.candidate = state != nullptr && !state->values.empty() && state->values[0] != 0.0;
  for (const Corner& corner : scene.corners) {
    if (said_.insert(corner.id).second) row.corners.push_back(corner.side);
  }
  if (scans_.empty()) first_frame_ = scene.frame;
  last_frame_ = scene.frame;
  scans_.push_back(std::move(row));
}

bool WidthPlot::has_lengths() const {
  return std::any_of(scans_.begin(), scans_.end(), [](const Row& row) { return !row.lengths_m.empty(); });
}

void WidthPlot::clear() { scans_.clear(); }

Expected<std::string> WidthPlot::png() const { return WidthPainter(*this).png(); }

}  // namespace verge::emit

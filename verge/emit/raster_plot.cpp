// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/raster_plot.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/core/round_length.hpp"
#include "verge/emit/bev_theme.hpp"
#include "verge/emit/canvas.hpp"
#include "verge/emit/colour.hpp"

namespace verge::emit {
namespace {

constexpr int kLeft_px = 90;
constexpr int kRight_px = 30;
constexpr int kHead_px = 44;
constexpr int kFoot_px = 64;
constexpr int kWidth_px = 1080;      // of the raster
constexpr int kHeight_px = 700;      // where its axes have two units
constexpr int kMaxHeight_px = 1400;  // where they have one
constexpr double kMark_px = 18.0;

struct Size {
  int width = kWidth_px;
  int height = kHeight_px;
};

Size size_of(const Trace::Raster& raster) {
  if (raster.x.unit != raster.y.unit || raster.rows == 0 || raster.cols == 0) return {};
  const double width = std::fabs(raster.x.step) * static_cast<double>(raster.cols);
  const double height = std::fabs(raster.y.step) * static_cast<double>(raster.rows);
  const double scale = std::min(kWidth_px / width, kMaxHeight_px / height);
  return {std::max(1, static_cast<int>(std::lround(scale * width))),
          std::max(1, static_cast<int>(std::lround(scale * height)))};
}

using Palette = std::array<std::uint32_t, 256>;

/// The colours of shares 0, 1/255, ... 1.
Palette palette_of(RasterColours colours) {
  Palette palette{};
  for (std::size_t i = 1; i < palette.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(palette.size() - 1);
    palette.at(i) = hex_of(colours == RasterColours::kGrey ? Colour{share, share, share}
                                                           : height_colour(std::sqrt(share)));
  }
  return palette;
}

/// The cells that fall into pixel i of `pixels`, at least one.
std::pair<std::size_t, std::size_t> cells_under(int i, int pixels, std::size_t cells) {
  const auto from = static_cast<std::size_t>(i) * cells / static_cast<std::size_t>(pixels);
  const auto to = static_cast<std::size_t>(i + 1) * cells / static_cast<std::size_t>(pixels);
  return {from, std::max(to, from + 1)};
}

float greatest_under(const Trace::Raster& raster, std::pair<std::size_t, std::size_t> rows,
                     std::pair<std::size_t, std::size_t> cols) {
  float greatest = 0.0F;  // std::max(g, NaN) is g
  for (std::size_t row = rows.first; row < rows.second; ++row) {
    for (std::size_t col = cols.first; col < cols.second; ++col) {
      greatest = std::max(greatest, raster.values[row * raster.cols + col]);
    }
  }
  return greatest;
}

std::vector<std::uint32_t> pixels_of(const Trace::Raster& raster, Size size, RasterColours colours) {
  const Palette palette = palette_of(colours);
  const float greatest = greatest_under(raster, {0, raster.rows}, {0, raster.cols});
  std::vector<std::uint32_t> pixels;
  if (!(greatest > 0.0F) || std::isinf(greatest)) return pixels;
  pixels.reserve(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float value = greatest_under(raster, cells_under(y, size.height, raster.rows),
                                         cells_under(x, size.width, raster.cols));
      pixels.push_back(palette.at(static_cast<std::size_t>(255.0F * (value / greatest) + 0.5F)));
    }
  }
  return pixels;
}

/// Where a value of an axis lies along the raster, pixels from its upper or left edge.
double place_of(const Trace::Axis& axis, double value, std::size_t cells, int pixels) {
  return ((value - axis.first) / axis.step + 0.5) * pixels / static_cast<double>(cells);
}

std::vector<double> ticks_of(const Trace::Axis& axis, std::size_t cells) {
  std::vector<double> ticks;
  if (cells == 0) return ticks;
  const double last = axis.first + axis.step * static_cast<double>(cells - 1);
  const auto [low, high] = std::minmax(axis.first, last);
  const double step = round_length(std::max(high - low, std::fabs(axis.step)) / 6.0);
  constexpr double kRounding = 1e-6;  // the last tick may lie on the last cell's centre
  const auto first = static_cast<int>(std::ceil(low / step - kRounding));
  const auto count = static_cast<int>(std::floor(high / step + kRounding)) - first + 1;
  for (int i = 0; i < count; ++i) ticks.push_back(step * (first + i));
  return ticks;
}

std::string name_of(const Trace::Axis& axis) {
  return axis.unit.empty() ? axis.name : fmt::format("{}, {}", axis.name, axis.unit);
}

/// Draws one picture.
class RasterPainter {
 public:
  explicit RasterPainter(const Trace::Raster& raster)
      : raster_(raster),
        size_(size_of(raster)),
        canvas_(kLeft_px + kWidth_px + kRight_px, kHead_px + size_.height + kFoot_px, kGround) {}

  void draw(RasterColours colours) {
    canvas_.box({kLeft_px, kHead_px}, {size_.width + 0.0, size_.height + 0.0}, rgb(0x000000));
    canvas_.image(kLeft_px, kHead_px, size_.width, pixels_of(raster_, size_, colours));
    draw_head();
    for (const double value : ticks_of(raster_.x, raster_.cols)) {
      draw_tick({at_x(value), kHead_px + size_.height + 24.0}, value, Align::kCentre);
    }
    for (const double value : ticks_of(raster_.y, raster_.rows)) {
      draw_tick({kLeft_px - 12.0, at_y(value) + 6.0}, value, Align::kRight);
    }
  }

  void mark(Vec2 values) {
    const Vec2 middle{at_x(values.x), at_y(values.y)};
    const bool inside = middle.x >= kLeft_px && middle.x <= kLeft_px + size_.width && middle.y >= kHead_px &&
                        middle.y <= kHead_px + size_.height;
    if (!inside) return;
    const double half = 0.5 * kMark_px;
    canvas_.polygon(std::array{middle + Vec2{-half, -half}, middle + Vec2{half, -half},
                               middle + Vec2{half, half}, middle + Vec2{-half, half}},
                    rgb(0x000000, 0.0), {2.0, kTruth, {}});
  }

  [[nodiscard]] Expected<std::string> png() const { return canvas_.png(); }

 private:
  [[nodiscard]] double at_x(double value) const {
    return kLeft_px + place_of(raster_.x, value, raster_.cols, size_.width);
  }
  [[nodiscard]] double at_y(double value) const {
    return kHead_px + place_of(raster_.y, value, raster_.rows, size_.height);
  }

  void draw_head() {
    const TextStyle title{.size = 18.0, .colour = kText, .bold = true};
    canvas_.text({kLeft_px, kHead_px - 14.0}, raster_.name, title);
    canvas_.text({kLeft_px + canvas_.text_width(raster_.name, title) + 30.0, kHead_px - 14.0},
                 fmt::format("{}; down: {}", name_of(raster_.x), name_of(raster_.y)),
                 {.size = 17.0, .colour = kFaintText});
  }

  void draw_tick(Vec2 at, double value, Align align) {
    canvas_.text(at, fmt::format("{:g}", value), {.size = 17.0, .colour = kFaintText, .align = align});
  }

  const Trace::Raster& raster_;
  Size size_;
  Canvas canvas_;
};

}  // namespace

Expected<std::string> raster_png(const Trace::Raster& raster, RasterColours colours,
                                 std::span<const Vec2> marks) {
  assert(raster.values.size() == raster.rows * raster.cols);
  RasterPainter painter(raster);
  painter.draw(colours);
  for (const Vec2 values : marks) painter.mark(values);
  return painter.png();
}

}  // namespace verge::emit

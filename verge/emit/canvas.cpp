// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include <cairo.h>

#include "verge/model/json_text.hpp"

#ifdef __SANITIZE_ADDRESS__
// Fontconfig keeps a pattern for each font it was asked for and never gives back the last ones: under 2 KiB a
// process, however many pictures are drawn. Here, so that every sanitized program that draws knows of it.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig.so\n"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace verge::emit {
namespace {

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};

void use(cairo_t* cr, Colour c) { cairo_set_source_rgba(cr, c.red, c.green, c.blue, c.alpha); }

void stroke_path(cairo_t* cr, const Stroke& stroke) {
  use(cr, stroke.colour);
  cairo_set_line_width(cr, stroke.width);
  cairo_set_dash(cr, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0.0);
  cairo_stroke(cr);
}

void trace_path(cairo_t* cr, std::span<const Vec2> points) {
  cairo_new_path(cr);
  for (const Vec2 p : points) cairo_line_to(cr, p.x, p.y);
}

void use_font(cairo_t* cr, const TextStyle& style) {
  cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, style.size);
}

double advance(cairo_t* cr, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  return extents.x_advance;
}

/// The pixels of an RGB24 surface: a 32-bit 0x00RRGGBB each, rows `stride` bytes apart.
class Pixels {
 public:
  explicit Pixels(cairo_surface_t* surface)
      : data_(cairo_image_surface_get_data(surface)),
        stride_(cairo_image_surface_get_stride(surface)),
        width_(cairo_image_surface_get_width(surface)),
        height_(cairo_image_surface_get_height(surface)) {}

  /// Pixels outside are left out.
  void set(int x, int y, std::uint32_t rgb) {
    if (x >= 0 && x < width_ && y >= 0 && y < height_) std::memcpy(place_of(x, y), &rgb, sizeof rgb);
  }

  /// A disc whose rim covers pixels by share, so that it moves smoothly with its centre.
  void blend(Vec2 centre, double radius, Colour colour) {
    const double reach = radius + 0.5;
    if (!touches(centre, reach)) return;
    const int x0 = std::max(0, static_cast<int>(std::floor(centre.x - reach)));
    const int x1 = std::min(width_ - 1, static_cast<int>(std::ceil(centre.x + reach)));
    const int y0 = std::max(0, static_cast<int>(std::floor(centre.y - reach)));
    const int y1 = std::min(height_ - 1, static_cast<int>(std::ceil(centre.y + reach)));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec2 off = Vec2{x + 0.5, y + 0.5} - centre;
        const double away2 = dot(off, off);
        if (away2 >= reach * reach) continue;
        mix(x, y, colour, std::min(reach - std::sqrt(away2), 1.0) * colour.alpha);
      }
    }
  }

 private:
  /// False also for a centre that is not finite.
  [[nodiscard]] bool touches(Vec2 p, double reach) const {
    return p.x > -reach && p.x < width_ + reach && p.y > -reach && p.y < height_ + reach;
  }

  [[nodiscard]] unsigned char* place_of(int x, int y) const {
    return data_ + std::ptrdiff_t{y} * stride_ + std::ptrdiff_t{x} * 4;
  }

  void mix(int x, int y, Colour colour, double cover) {
    unsigned char* const at = place_of(x, y);
    std::uint32_t pixel = 0;
    std::memcpy(&pixel, at, sizeof pixel);
    const auto channel = [&](unsigned shift, double to) {
      const double from = static_cast<double>(pixel >> shift & 0xFFU);
      return static_cast<std::uint32_t>(from + (to * 255.0 - from) * cover + 0.5) << shift;
    };
    pixel = channel(16, colour.red) | channel(8, colour.green) | channel(0, colour.blue);
    std::memcpy(at, &pixel, sizeof pixel);
  }

  unsigned char* data_;
  int stride_;
  int width_;
  int height_;
};

/// Lets `work` at the surface's pixels, which cairo must know of; not where memory did not suffice (png()
/// tells).
template <class Work>
void on_pixels(cairo_surface_t* surface, Work work) {
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) return;
  cairo_surface_flush(surface);
  Pixels pixels(surface);
  work(pixels);
  cairo_surface_mark_dirty(surface);
}

cairo_status_t append(void* closure, const unsigned char* bytes, unsigned int count) {
  auto& out = *static_cast<std::string*>(closure);
  for (unsigned int i = 0; i < count; ++i) out.push_back(static_cast<char>(bytes[i]));
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct Canvas::State {
  std::unique_ptr<cairo_surface_t, Destroy> surface;
  std::unique_ptr<cairo_t, Destroy> context;
};

Canvas::Canvas(int width, int height, Colour background) : state_(std::make_unique<State>()) {
  state_->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  state_->context.reset(cairo_create(state_->surface.get()));
  cairo_t* const cr = state_->context.get();
  use(cr, background);
  cairo_paint(cr);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  const std::unique_ptr<cairo_font_options_t, Destroy> options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cr, options.get());
}

Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;
Canvas::~Canvas() = default;

void Canvas::dots(std::span<const Vec2> centres, double radius, Colour colour) {
  on_pixels(state_->surface.get(), [&](Pixels& pixels) {
    for (const Vec2 centre : centres) pixels.blend(centre, radius, colour);
  });
}

void Canvas::image(int x, int y, int width, std::span<const std::uint32_t> rgb) {
  on_pixels(state_->surface.get(), [&](Pixels& pixels) {
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      const int at = static_cast<int>(i);
      pixels.set(x + at % width, y + at / width, rgb[i]);
    }
  });
}

void Canvas::line(std::span<const Vec2> points, const Stroke& stroke) {
  trace_path(state_->context.get(), points);
  stroke_path(state_->context.get(), stroke);
}

void Canvas::polygon(std::span<const Vec2> corners, Colour fill, const Stroke& edge) {
  cairo_t* const cr = state_->context.get();
  trace_path(cr, corners);
  cairo_close_path(cr);
  use(cr, fill);
  cairo_fill_preserve(cr);
  stroke_path(cr, edge);
}

void Canvas::circle(Vec2 centre, double radius, const Stroke& stroke) {
  cairo_t* const cr = state_->context.get();
  cairo_new_path(cr);
  cairo_arc(cr, centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  stroke_path(cr, stroke);
}

void Canvas::box(Vec2 at, Vec2 size, Colour fill) {
  cairo_t* const cr = state_->context.get();
  cairo_new_path(cr);
  cairo_rectangle(cr, at.x, at.y, size.x, size.y);
  use(cr, fill);
  cairo_fill(cr);
}

void Canvas::rounded_box(Vec2 at, Vec2 size, double radius, Colour fill, const Stroke& edge) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  cairo_t* const cr = state_->context.get();
  const double right = at.x + size.x - radius;
  const double low = at.y + size.y - radius;
  cairo_new_path(cr);
  cairo_arc(cr, right, at.y + radius, radius, -kQuarter, 0.0);
  cairo_arc(cr, right, low, radius, 0.0, kQuarter);
  cairo_arc(cr, at.x + radius, low, radius, kQuarter, 2.0 * kQuarter);
  cairo_arc(cr, at.x + radius, at.y + radius, radius, 2.0 * kQuarter, 3.0 * kQuarter);
  cairo_close_path(cr);
  use(cr, fill);
  cairo_fill_preserve(cr);
  stroke_path(cr, edge);
}

void Canvas::text(Vec2 at, std::string_view text, const TextStyle& style) {
  cairo_t* const cr = state_->context.get();
  const std::string shown = model::valid_utf8(text);
  use_font(cr, style);
  const double shift = style.align == Align::kLeft ? 0.0 : style.align == Align::kCentre ? 0.5 : 1.0;
  const Vec2 from{at.x - shift * advance(cr, shown), at.y};
  if (style.halo.alpha > 0.0) {
    cairo_new_path(cr);
    cairo_move_to(cr, from.x, from.y);
    cairo_text_path(cr, shown.c_str());
    stroke_path(cr, {style.size * 0.28, style.halo, {}});
  }
  cairo_new_path(cr);
  cairo_move_to(cr, from.x, from.y);
  use(cr, style.colour);
  cairo_show_text(cr, shown.c_str());
}

double Canvas::text_width(std::string_view text, const TextStyle& style) const {
  cairo_t* const cr = state_->context.get();
  use_font(cr, style);
  return advance(cr, model::valid_utf8(text));
}

Expected<std::string> Canvas::png() const {
  std::string bytes;
  cairo_status_t status = cairo_status(state_->context.get());
  if (status == CAIRO_STATUS_SUCCESS) {
    status = cairo_surface_write_to_png_stream(state_->surface.get(), append, &bytes);
  }
  if (status == CAIRO_STATUS_SUCCESS) return bytes;
  return Unexpected(
      {ErrorCode::kLimit, {}, {}, std::string("cannot draw: ") + cairo_status_to_string(status), {}, {}});
}

}  // namespace verge::emit

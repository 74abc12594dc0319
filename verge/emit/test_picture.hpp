// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include <cairo.h>

namespace verge::emit {

/// A PNG as cairo reads it back.
class Picture {
 public:
  explicit Picture(const std::string& png)
      : rest_(png),
        surface_(cairo_image_surface_create_from_png_stream(read, &rest_), &cairo_surface_destroy) {}

  [[nodiscard]] bool decoded() const { return cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS; }
  [[nodiscard]] int width() const { return cairo_image_surface_get_width(surface_.get()); }
  [[nodiscard]] int height() const { return cairo_image_surface_get_height(surface_.get()); }

  /// 0xRRGGBB at column x and row y.
  [[nodiscard]] std::uint32_t pixel(int x, int y) const {
    const auto stride = std::ptrdiff_t{cairo_image_surface_get_stride(surface_.get())};
    std::uint32_t value = 0;
    std::memcpy(&value, cairo_image_surface_get_data(surface_.get()) + y * stride + std::ptrdiff_t{x} * 4,
                sizeof value);
    return value & 0xFFFFFFU;
  }

 private:
  static cairo_status_t read(void* closure, unsigned char* bytes, unsigned int count) {
    auto& rest = *static_cast<std::string*>(closure);
    if (rest.size() < count) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(bytes, rest.data(), count);
    rest.erase(0, count);
    return CAIRO_STATUS_SUCCESS;
  }

  std::string rest_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
};

}  // namespace verge::emit

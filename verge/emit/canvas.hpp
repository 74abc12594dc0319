// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/vec.hpp"
#include "verge/emit/colour.hpp"

namespace verge::emit {

struct Stroke {
  double width = 1.0;
  Colour colour;
  std::vector<double> dashes;  ///< Lengths on, off, on, ...; empty: a whole line.
};

enum class Align { kLeft, kCentre, kRight };

struct TextStyle {
  double size = 20.0;
  Colour colour;
  bool bold = false;
  Align align = Align::kLeft;
  Colour halo{0.0, 0.0, 0.0, 0.0};  ///< Around the letters, where its alpha is above 0.
};

/// A picture to draw on with cairo, then a PNG. Pixels: x to the right, y down, (0, 0) the upper left corner.
/// What lies outside is cut off. The same calls give the same bytes on one machine (text depends on its
/// fonts; without DejaVu Sans another font stands in, without any font a plain one of cairo's own).
class Canvas {
 public:
  Canvas(int width, int height, Colour background);
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas();

  /// Filled discs of one kind: an order of magnitude faster than a path each.
  void dots(std::span<const Vec2> centres, double radius, Colour colour);
  void line(std::span<const Vec2> points, const Stroke& stroke);
  void polygon(std::span<const Vec2> corners, Colour fill, const Stroke& edge);
  void circle(Vec2 centre, double radius, const Stroke& stroke);
  void box(Vec2 upper_left, Vec2 size, Colour fill);
  void rounded_box(Vec2 upper_left, Vec2 size, double radius, Colour fill, const Stroke& edge);

  /// Pixels as they are: `rgb` holds rows of `width` of them, 0xRRGGBB, the first at column x and row y.
  void image(int x, int y, int width, std::span<const std::uint32_t> rgb);

  /// One line of text on its base line at `at`. Bytes that are not UTF-8 show as U+FFFD.
  void text(Vec2 at, std::string_view text, const TextStyle& style);
  [[nodiscard]] double text_width(std::string_view text, const TextStyle& style) const;

  /// Fails with kLimit where memory did not suffice.
  [[nodiscard]] Expected<std::string> png() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace verge::emit

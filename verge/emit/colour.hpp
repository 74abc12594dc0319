// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace verge::emit {

/// sRGB, each 0..1; alpha 1 = opaque.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;

  [[nodiscard]] constexpr Colour faded(double share) const { return {red, green, blue, alpha * share}; }
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// 0xRRGGBB as a colour.
[[nodiscard]] constexpr Colour rgb(std::uint32_t hex, double alpha = 1.0) {
  return {static_cast<double>(hex >> 16U & 0xFFU) / 255.0, static_cast<double>(hex >> 8U & 0xFFU) / 255.0,
          static_cast<double>(hex & 0xFFU) / 255.0, alpha};
}

/// The opaque colour as 0xRRGGBB, each part rounded.
[[nodiscard]] constexpr std::uint32_t hex_of(Colour colour) {
  const auto byte = [](double part) { return static_cast<std::uint32_t>(255.0 * part + 0.5); };
  return byte(colour.red) << 16U | byte(colour.green) << 8U | byte(colour.blue);
}

/// The colour map viridis (Smith and van der Walt, 2015: perceptually even, readable by the colour-blind) for
/// t in 0..1, linear between ten of its colours, its darkest eighth left out so that it shows on a dark
/// ground. t outside 0..1 takes the nearer end.
[[nodiscard]] Colour height_colour(double t);

/// One of a few colours that tell groups apart, for a group of any number (also a negative one).
[[nodiscard]] Colour group_colour(int group);

}  // namespace verge::emit

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace verge::emit {

Colour height_colour(double t) {
  constexpr std::array<std::uint32_t, 10> kViridis{0x440154, 0x482878, 0x3E4A89, 0x31688E, 0x26828E,
                                                   0x1F9E89, 0x35B779, 0x6DCD59, 0xB4DE2C, 0xFDE725};
  constexpr double kDarkest = 0.125;
  constexpr double kLast = static_cast<double>(kViridis.size() - 1);
  const double at = (kDarkest + (1.0 - kDarkest) * std::clamp(t, 0.0, 1.0)) * kLast;
  const auto below = static_cast<std::size_t>(std::min(std::floor(at), kLast - 1.0));
  const double share = at - static_cast<double>(below);
  const Colour a = rgb(kViridis[below]);
  const Colour b = rgb(kViridis[below + 1]);
  return {std::lerp(a.red, b.red, share), std::lerp(a.green, b.green, share),
          std::lerp(a.blue, b.blue, share)};
}

Colour group_colour(int group) {
  constexpr std::array<std::uint32_t, 8> kGroups{0xFF6FB5, 0xFFE066, 0xB794F6, 0x7CFFB2,
                                                 0xFF9E80, 0x9BE7FF, 0xE6EE9C, 0xF8BBD0};
  constexpr int kCount = static_cast<int>(kGroups.size());
  return rgb(kGroups[static_cast<std::size_t>((group % kCount + kCount) % kCount)]);
}

}  // namespace verge::emit

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/value_axis.hpp"

#include <array>
#include <cmath>

#include <fmt/core.h>

#include "verge/core/round_length.hpp"
#include "verge/emit/bev_theme.hpp"

namespace verge::emit {
namespace {

double above(double least, double greatest) { return greatest > least ? greatest : least + 1.0; }

}  // namespace

ValueAxis::ValueAxis(double least, double greatest, const PlotArea& area)
    : area_(area),
      step_(round_length((above(least, greatest) - least) / 3.0)),
      least_(std::floor(least / step_) * step_),
      most_(std::ceil(above(least, greatest) / step_) * step_) {}

double ValueAxis::y_of(double value) const {
  return area_.top + area_.height * (most_ - value) / (most_ - least_);
}

void ValueAxis::draw(Canvas& canvas) const {
  const int ticks = static_cast<int>(std::round((most_ - least_) / step_));
  for (int i = 0; i <= ticks; ++i) {
    const double value = least_ + step_ * i;
    const double y = y_of(value);
    canvas.line(std::array{Vec2{area_.left, y}, Vec2{area_.left + area_.width, y}}, {1.0, kRing, {}});
    canvas.text({area_.left - 12.0, y + 6.0}, fmt::format("{:g}", std::round(value / step_) * step_),
                {.size = 17.0, .colour = kFaintText, .align = Align::kRight});
  }
}

}  // namespace verge::emit

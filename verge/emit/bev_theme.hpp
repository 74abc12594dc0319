// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/emit/colour.hpp"

namespace verge::emit {

// Dark, since on a projector's dark ground thin bright points and lines stay visible from the last row.
inline constexpr Colour kGround = rgb(0x0B0F14);
inline constexpr Colour kPanel = rgb(0x141A22, 0.88);
inline constexpr Colour kPanelEdge = rgb(0xFFFFFF, 0.14);
inline constexpr Colour kText = rgb(0xF2F5F8);
inline constexpr Colour kFaintText = rgb(0xAEB8C4);
inline constexpr Colour kAboveScale = rgb(0x77818D);
inline constexpr Colour kRing = rgb(0xFFFFFF, 0.20);
inline constexpr Colour kTruth = rgb(0xFFFFFF);
inline constexpr Colour kPlotCurve = rgb(0x4CC9FF);
inline constexpr Colour kPlotThreshold = rgb(0xFFD166);
inline constexpr Colour kTraceLine = rgb(0xF4F1EA, 0.9);

}  // namespace verge::emit

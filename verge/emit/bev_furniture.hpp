// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/emit/bev_layers.hpp"

namespace verge::emit {

/// Under the layers: range rings with their distances.
void draw_rings(Canvas& canvas, const BevView& view);
void draw_ring_labels(Canvas& canvas, const BevView& view);
/// An arrowhead at the sensor, pointing ahead.
void draw_vehicle(Canvas& canvas, const BevView& view);

/// In the corners: frame and method, legend, scale bar, and what the colours mean.
void draw_caption(Canvas& canvas, const BevView& view, const BevContent& content);
void draw_legend(Canvas& canvas, const BevView& view, Legend legend);
void draw_scale_bar(Canvas& canvas, const BevView& view);
void draw_colour_bar(Canvas& canvas, const BevView& view, const BevPlot::Config& config, bool above_road);

}  // namespace verge::emit

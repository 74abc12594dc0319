// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/emit/bev_layers.hpp"
#include "verge/emit/bev_view.hpp"
#include "verge/emit/canvas.hpp"
#include "verge/model/scene.hpp"

namespace verge::emit {

/// The colour of a class: vehicles, people and what stands beside the road can be told apart.
[[nodiscard]] Colour class_colour(ObjectClass type);

/// A box where each object is, in the colour of its class, with the sign of its shape.
void draw_objects(Canvas& canvas, const BevView& view, const Scene& scene, Legend& legend);
/// Dashed boxes; those of confidence 0 (nobody saw them) fainter.
void draw_true_objects(Canvas& canvas, const BevView& view, const Scene& truth, Legend& legend);

}  // namespace verge::emit

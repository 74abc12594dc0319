// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/eval/clip.hpp"
#include "verge/model/scene.hpp"

namespace verge::eval {

/// A place where the labels say that the road ends. Sensor frame, x forward, y left, metres.
struct TruePoint {
  Vec2 place;
  /// Height difference of the ground on its two sides; none where one of them was not seen, or labels do not
  /// tell.
  std::optional<double> step_m;
};

/// What the labels of one scan say about the road's boundary, and where they say nothing; or about objects.
struct LabelledTruth {
  std::string frame;
  std::vector<TruePoint> points;
  std::vector<Segment> segments;  ///< Between neighbouring true points of one boundary.
  /// Stretches along which a boundary may run unseen: what is predicted there is neither right nor wrong.
  std::vector<Segment> hidden;
  /// Points that are labelled as ground, where labels cover the whole scan; none where they cover a part of
  /// it.
  std::optional<std::vector<Vec2>> ground;
  std::vector<Object> objects;  ///< Boxes that were drawn round objects; such labels say nothing else.
};

}  // namespace verge::eval

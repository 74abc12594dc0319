// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "verge/eval/object_score.hpp"
#include "verge/model/scene.hpp"
#include "verge/scan/scan.hpp"

namespace verge::study {

/// How many returns of the scan's four layers, or of the rings that stand in for them (as line_fit chooses
/// them by default), lie in each box. The scan has its mount.
[[nodiscard]] std::vector<std::size_t> returns_in(const std::vector<Object>& boxes, const Scan& scan);

/// Boxes as truth. One that fewer than three of these returns hit was not seen: it gets confidence 0.
[[nodiscard]] Scene boxed_truth(std::vector<Object> boxes, const Scan& scan);

/// How objects within 50 m, line_fit's range gate, were found. Boxes are drawn round what moves and round
/// barriers and cones, not round poles, walls and hedges: a prediction of a class beyond these (pole,
/// roadside, unknown) counts only where it is paired with a box.
[[nodiscard]] eval::ObjectScore score_boxes(const Scene& prediction, const Scene& truth);

}  // namespace verge::study

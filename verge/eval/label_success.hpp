// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "verge/eval/frame_success.hpp"
#include "verge/eval/labelled_truth.hpp"
#include "verge/model/scene.hpp"

namespace verge::eval {

/// How good a prediction of a labelled scan is as a whole, by paper 3's limits and the definitions of
/// label_score.hpp: minimum where at least 90 % of the true points within range_m are at most 0.2 m from the
/// prediction and no sample of it that can be judged is more than 0.5 m off; larger where the same holds of
/// 0.5 m and 1 m. Where only kerb points are labelled, what lies between two of them is unknown, and the
/// first condition alone counts. None where there is no true point. No prediction has found nothing.
[[nodiscard]] std::optional<Deviation> deviation_of(const LabelledTruth& truth, const Scene* prediction,
                                                    double range_m = 20.0);

}  // namespace verge::eval

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/verge/evaluate_request.hpp"
#include "verge/core/error.hpp"

namespace verge::app {

/// Scores which points are ground, by the label files in the folder request.predictions or, where it is
/// empty, by the road's plane, against the labelled scans of request.labels. Fails as the readers of both do,
/// and with kUnusable where no file of the predictions belongs to one of the scans.
[[nodiscard]] Expected<EvaluationOutput> evaluate_ground(const EvaluateRequest& request, Console& console);

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/verge/evaluate_request.hpp"
#include "verge/core/error.hpp"

namespace verge::app {

/// Scores the predictions against the labelled scans of request.labels. Fails as the readers of both do, and
/// with kUnusable where no frame of the predictions is one of the scans.
[[nodiscard]] Expected<EvaluationOutput> evaluate_labels(const EvaluateRequest& request, Console& console);

}  // namespace verge::app

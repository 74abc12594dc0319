// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/verge/evaluate_request.hpp"
#include "verge/core/error.hpp"

namespace verge::app {

/// Compares the predictions with the Scenes of request.truth. Fails as the readers of both do, and with
/// kUnusable where the truth is empty or no frame of the predictions is one of it.
[[nodiscard]] Expected<EvaluationOutput> evaluate_truth(const EvaluateRequest& request, Console& console);

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/verge/evaluate_request.hpp"

namespace verge::app {

/// Runs request.suite, shows how far it is, hands out its table, and writes its report where asked for. A
/// signal ends it after the scans under way; parts that are done stay in the folder.
[[nodiscard]] ExitCode evaluate_suite(const EvaluateRequest& request, Console& console);

}  // namespace verge::app

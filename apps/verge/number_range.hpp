// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace verge::app {

/// Lets a number from `least` to `greatest` pass, and nothing that is not a number at all: CLI::Range lets
/// "nan" through.
[[nodiscard]] CLI::Validator finite_range(double least, double greatest);

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "apps/verge/console.hpp"
#include "apps/verge/exit_code.hpp"
#include "verge/core/error.hpp"
#include "verge/pipeline/summary.hpp"

namespace verge::app {

/// What to make of damage in the input.
struct DamagePolicy {
  bool allow = false;   ///< --allow-damaged: 0 instead of 5.
  bool strict = false;  ///< --strict: 4 instead of 5, and no output.
};

/// How a run ends that came to the end of its input: with the first error's own code where no scan could be
/// used, else by the policy.
[[nodiscard]] ExitCode exit_code_of(const std::optional<Error>& first_error, const pipeline::Counts& counts,
                                    const DamagePolicy& policy);

/// One line where scans could not be used.
void warn_of_damage(const pipeline::Counts& counts, Console& console);

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/damage.hpp"

#include <fmt/core.h>

namespace verge::app {

ExitCode exit_code_of(const std::optional<Error>& first_error, const pipeline::Counts& counts,
                      const DamagePolicy& policy) {
  if (!first_error) return ExitCode::kOk;
  const ExitCode own = exit_code_of(first_error->code);
  if (counts.scans == 0 && own != ExitCode::kDamaged) return own;
  if (policy.strict) return ExitCode::kUnusable;
  return policy.allow ? ExitCode::kOk : ExitCode::kDamaged;
}

void warn_of_damage(const pipeline::Counts& counts, Console& console) {
  if (counts.damaged == 0) return;
  console.warning(
      fmt::format("{} of {} scans could not be used", counts.damaged, counts.scans + counts.damaged));
}

}  // namespace verge::app

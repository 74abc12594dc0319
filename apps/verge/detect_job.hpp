// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "apps/verge/console.hpp"
#include "apps/verge/damage.hpp"
#include "apps/verge/exit_code.hpp"
#include "apps/verge/inputs.hpp"
#include "apps/verge/output.hpp"
#include "apps/verge/settings.hpp"

namespace verge::app {

/// All that `verge detect` was asked for.
struct DetectRequest {
  InputRequest input;
  OutputRequest output;
  SettingsRequest settings;
  Console::Options console;
  DamagePolicy damage;
  std::optional<std::filesystem::path> plot;  ///< --plot FOLDER.
  bool trace = false;                         ///< Each record also has the method's intermediates.
  std::size_t threads = 0;                    ///< 0: as many as the machine has.
  bool dump_config = false;
};

/// Reads scans, finds the road's boundaries and writes them; says on standard error what happened.
[[nodiscard]] ExitCode detect(const DetectRequest& request);

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/verge/console.hpp"
#include "apps/verge/damage.hpp"
#include "apps/verge/inputs.hpp"

namespace CLI {
class App;
}

namespace verge::app {

// Options that several verbs share.
void add_input_options(CLI::App& verb, InputRequest& request);
/// Those of add_input_options() but for the paths.
void add_recording_options(CLI::App& verb, InputRequest& request);
void add_damage_options(CLI::App& verb, DamagePolicy& policy);
void add_console_options(CLI::App& verb, Console::Options& options);

}  // namespace verge::app

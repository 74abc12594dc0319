// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "apps/verge/exit_code.hpp"

namespace CLI {
class App;
}

namespace verge::app {

/// What the command line asked for, ready to be done.
using Action = std::function<ExitCode()>;

// Each adds its verb to the program and sets the action when that verb is chosen.
void add_convert(CLI::App& program, Action& action);
void add_detect(CLI::App& program, Action& action);
void add_evaluate(CLI::App& program, Action& action);
void add_info(CLI::App& program, Action& action);
void add_methods(CLI::App& program, Action& action);
void add_simulate(CLI::App& program, Action& action);
void add_train(CLI::App& program, Action& action);

}  // namespace verge::app

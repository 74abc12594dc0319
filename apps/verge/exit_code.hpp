// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/core/error.hpp"

namespace verge::app {

/// How the program ends; the numbers are a promise to scripts and are never reused.
enum class ExitCode : int {
  kOk = 0,             ///< All input used.
  kBug = 1,            ///< Internal error.
  kUsage = 2,          ///< Wrong command line or configuration.
  kCannotOpen = 3,     ///< Input missing, a folder, no permission.
  kUnusable = 4,       ///< Nothing in the input could be decoded.
  kDamaged = 5,        ///< Part of the input damaged; the rest is written.
  kCannotWrite = 6,    ///< Output cannot be written; an old file is untouched.
  kTimeout = 7,        ///< No data within the time allowed.
  kLimit = 8,          ///< A limit would be exceeded.
  kInterrupted = 130,  ///< SIGINT; what was finished is written.
  kTerminated = 143,   ///< SIGTERM; what was finished is written.
};

/// The code for a run that ends with this error and nothing decoded.
[[nodiscard]] ExitCode exit_code_of(ErrorCode code);

/// The table of codes for help texts.
[[nodiscard]] const char* exit_code_help();

}  // namespace verge::app

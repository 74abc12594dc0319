// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/exit_code.hpp"

namespace verge::app {

ExitCode exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return ExitCode::kUsage;
    case ErrorCode::kCannotOpen:
      return ExitCode::kCannotOpen;
    case ErrorCode::kUnusable:
      return ExitCode::kUnusable;
    case ErrorCode::kDamaged:
      return ExitCode::kDamaged;
    case ErrorCode::kCannotWrite:
      return ExitCode::kCannotWrite;
    case ErrorCode::kReaderGone:
      return ExitCode::kOk;
    case ErrorCode::kTimeout:
      return ExitCode::kTimeout;
    case ErrorCode::kLimit:
      return ExitCode::kLimit;
  }
  return ExitCode::kBug;
}

const char* exit_code_help() {
  return "Exit codes:\n"
         "  0  all input used\n"
         "  2  wrong command line or configuration\n"
         "  3  an input cannot be opened\n"
         "  4  nothing in the input can be decoded\n"
         "  5  part of the input is damaged, the rest is written\n"
         "  6  an output cannot be written; an old file stays as it was\n"
         "  7  no data within the time allowed\n"
         "  8  a limit would be exceeded (memory, points)\n"
         "  130, 143  stopped by Ctrl-C or SIGTERM; what was finished is written\n"
         "  1  a bug in verge: please report it";
}

}  // namespace verge::app

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace verge {

/// What kind of trouble bad data or the machine made; a program maps it to its exit code.
enum class ErrorCode {
  kUsage,  ///< The request itself makes no sense for this input (for example: two formats fit, choose one).
  kCannotOpen,   ///< Missing, a folder where a file is needed, no permission.
  kUnusable,     ///< Opened, but nothing in it can be decoded.
  kDamaged,      ///< A part is damaged; what came before it is good.
  kCannotWrite,  ///< Full, read-only, size limit.
  kReaderGone,   ///< The output is a pipe that nobody reads any more: a program stops and calls it done.
  kTimeout,      ///< No data within the time allowed.
  kLimit,        ///< Would exceed a limit (memory, points, message size).
};

/// Why an input or output failed, where, and what was found against what is needed.
/// Rendered as one line by to_string(): "FILE:WHERE: WHAT (got GOT, need NEED)".
struct Error {
  ErrorCode code = ErrorCode::kUnusable;
  std::string file;   ///< Path as the caller gave it; may be empty where no file is involved.
  std::string where;  ///< Byte offset (binary), "LINE:COL" (text), or empty.
  std::string what;   ///< One sentence, lower case, no full stop.
  std::string got;    ///< What was found; empty if it says nothing more.
  std::string need;   ///< What would have been right; empty if it says nothing more.
};

/// A value, or why there is none. Data errors travel this way; they are never thrown.
template <class T>
using Expected = tl::expected<T, Error>;

using Unexpected = tl::unexpected<Error>;

/// The error's line: at most 280 bytes of UTF-8, escaped as by escape_control_bytes() (paths may hold ESC).
[[nodiscard]] std::string to_string(const Error& error);

/// `text` so that it can stand in one line of a terminal, as valid UTF-8: control characters (below U+0020,
/// U+007F to U+009F), the backslash, and bytes that are no UTF-8 are escaped byte by byte.
[[nodiscard]] std::string escape_control_bytes(std::string_view text);

}  // namespace verge

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "verge/core/bytes.hpp"

namespace verge::io {

/// Where a stream went wrong: the offset of the control byte in the packed bytes.
using LzfFault = std::size_t;

/// Unpacks an LZF stream (as PCD's binary_compressed holds) that has to fill `out` exactly. None: it did.
/// Every read and write is checked, so that any bytes are safe.
///
/// Format: a control byte c below 32 is followed by c + 1 literal bytes; else it copies (c >> 5) + 2 bytes
/// (with 7 << 5: 9 + the next byte) from the distance ((c & 31) << 8 | next byte) + 1 behind.
[[nodiscard]] std::optional<LzfFault> unpack_lzf(Bytes packed, std::span<std::byte> out);

}  // namespace verge::io

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "verge/core/bytes.hpp"

namespace verge::io {

/// How the chunks of a recording are compressed.
enum class Packing : std::uint8_t { kNone, kLz4, kZstd, kBz2 };

/// By the name that MCAP and ROS bags give it: "" or "none", "lz4", "zstd", "bz2".
[[nodiscard]] std::optional<Packing> packing_of(std::string_view name);

/// Whether the bytes begin as a zstd frame does (RFC 8878, section 3.1.1).
[[nodiscard]] bool is_zstd(Bytes bytes);
/// The size that a zstd frame tells of its content, if it does.
[[nodiscard]] std::optional<std::uint64_t> zstd_size(Bytes packed);

/// Unpacks into `out`, which the caller has made as large as the file says. False where the packed bytes are
/// damaged or do not come to exactly that size; they never write behind it. LZ4 is the frame format.
[[nodiscard]] bool unpack(Packing packing, Bytes packed, std::span<std::byte> out);

/// The bytes packed; for one version of the library the same bytes every time. Not for kBz2.
[[nodiscard]] std::string pack(Packing packing, Bytes bytes);

}  // namespace verge::io

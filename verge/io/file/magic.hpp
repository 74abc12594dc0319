// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "verge/core/bytes.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// Where the magic first stands at or behind `from`.
[[nodiscard]] inline std::optional<std::size_t> find_magic(Bytes bytes, std::span<const std::byte> magic,
                                                           std::size_t from = 0) {
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(from, bytes.size()));
  const auto found = std::search(begin, bytes.end(), magic.begin(), magic.end());
  if (found == bytes.end()) return std::nullopt;
  return static_cast<std::size_t>(found - bytes.begin());
}

/// The first 64 KiB, by which a stream of messages is known. Fails with kUnusable where the file is empty.
[[nodiscard]] inline Expected<Bytes> checked_head(Input& input) {
  constexpr std::uint64_t kLook = 64ULL << 10U;
  if (input.size() == 0) return Unexpected(input.error_at(ErrorCode::kUnusable, 0, "is empty"));
  return input.head(kLook);
}

}  // namespace verge::io

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/chunk.hpp"

#include <fmt/core.h>

#include "verge/io/file/packing.hpp"

namespace verge::io {
namespace {

Expected<void> check_sizes(const Input& input, const ChunkPlace& chunk) {
  constexpr std::uint64_t kMostBytes = 1ULL << 30U;
  constexpr std::uint64_t kGreatestRatio = 1024;
  if (chunk.unpacked_bytes > kMostBytes) {
    return Unexpected(input.error_at(ErrorCode::kLimit, chunk.offset, "chunk is too large",
                                     fmt::format("{} B", chunk.unpacked_bytes), "<= 1073741824 B"));
  }
  if (chunk.unpacked_bytes / kGreatestRatio > chunk.packed_bytes) {
    return Unexpected(input.error_at(ErrorCode::kLimit, chunk.offset, "chunk cannot be compressed that much",
                                     fmt::format("{} B from {} B", chunk.unpacked_bytes, chunk.packed_bytes),
                                     "ratio <= 1024"));
  }
  return input.allow(0, chunk.packed_bytes + chunk.unpacked_bytes);
}

Error not_its_size(const Input& input, const ChunkPlace& chunk) {
  return input.error_at(ErrorCode::kDamaged, chunk.offset, "chunk is damaged: it does not unpack to its size",
                        fmt::format("{} B {}", chunk.packed_bytes, chunk.packing),
                        fmt::format("{} B", chunk.unpacked_bytes));
}

}  // namespace

Expected<Bytes> read_chunk(Input& input, const ChunkPlace& chunk, Buffer& buffer) {
  const auto packing = packing_of(chunk.packing);
  if (!packing) {
    return Unexpected(input.error_at(ErrorCode::kDamaged, chunk.offset, "chunk has an unknown compression",
                                     chunk.packing, "none, lz4, zstd or bz2"));
  }
  if (auto sizes = check_sizes(input, chunk); !sizes) return Unexpected(std::move(sizes).error());
  const auto packed = input.read(chunk.offset, chunk.packed_bytes);
  if (!packed) return Unexpected(packed.error());
  if (*packing == Packing::kNone && chunk.packed_bytes == chunk.unpacked_bytes) return *packed;
  const std::span<std::byte> out = buffer.fresh(static_cast<std::size_t>(chunk.unpacked_bytes));
  if (!unpack(*packing, *packed, out)) return Unexpected(not_its_size(input, chunk));
  return Bytes(out);
}

}  // namespace verge::io

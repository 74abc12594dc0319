// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// Where the records of a chunk stand in a file, as its header says.
struct ChunkPlace {
  std::uint64_t offset = 0;  ///< Of the packed bytes; the maker has checked that they lie in the file.
  std::uint64_t packed_bytes = 0;
  std::uint64_t unpacked_bytes = 0;
  std::string packing;  ///< As the file names it.
};

/// The chunk's records: in the input's own buffer where they are not packed, else in `buffer`; valid until
/// either is used again. Fails with kLimit where it would unpack to more than 1 GiB, to more than 1024 times
/// its size or to more than the input is allowed (reliability B2, B1), with kDamaged where it does not unpack
/// to the size that it tells.
[[nodiscard]] Expected<Bytes> read_chunk(Input& input, const ChunkPlace& chunk, Buffer& buffer);

}  // namespace verge::io

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "verge/io/file/bag.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"

namespace verge::io {

/// The messages of an MCAP file with CDR or ROS 1 messages, chunked (none, lz4, zstd) or not, read from the
/// front to the end, one chunk in memory at a time. Indexes are not needed: a file without its summary (the
/// recorder was killed) is read through once before, to know its topics, and its end is an Error kDamaged
/// after its last message. A chunk that is damaged is an Error, and the next chunk is read.
///
/// Fails with kUnusable where the bytes are no MCAP file.
[[nodiscard]] Expected<std::unique_ptr<Bag>> open_mcap_bag(Input input);

/// Its scans; fails as open_mcap_bag() and open_bag() do.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_mcap(Input input, const RecordingOptions& options);

}  // namespace verge::io

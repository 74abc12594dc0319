// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"
#include "verge/sensor/ibeo/framer.hpp"

// What the targets of recordings that are streams of messages share.

namespace verge::fuzz {

/// The bytes as a text, which is what a seed is.
[[nodiscard]] std::string seed_of(const std::vector<std::vector<std::byte>>& parts);

/// Cuts the stream into messages: whole, in pieces of one byte, and in pieces as long as the stream's own
/// bytes say. The same comes out, every byte is accounted for, and no more is held than a message and a
/// piece.
void check_framing(Bytes stream, const sensor::ibeo::FrameLayout& layout);

/// Opens a recording of these bytes.
using OpenRecording = std::function<Expected<std::unique_ptr<io::Recording>>(io::Input)>;

/// Reads the recording to its end: it has one, what is counted adds up, every error says something, points
/// are finite and no more than the bytes can hold, and memory is bounded.
void check_recording(Bytes input, const OpenRecording& open);

}  // namespace verge::fuzz

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz.hpp"
#include "verge/io/file/test_bags.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"

// What the targets of recordings of ROS share.

namespace verge::fuzz {

using OpenRecording = Expected<std::unique_ptr<io::Recording>> (*)(io::Input, const io::RecordingOptions&);

/// Reads the recording to its end, twice: it has an end, the same comes out, no column is shorter than
/// another, and every counter that says what was received is the sum of those that say what became of it.
void check_recording(Bytes input, OpenRecording open);

/// Messages of clouds, transforms and odometry, and a cloud that contradicts itself.
[[nodiscard]] std::vector<testing::TestMessage> seed_messages(io::Wire wire);
/// A message of two packets of a VLP-16.
[[nodiscard]] std::vector<testing::TestMessage> velodyne_messages(io::Wire wire);

}  // namespace verge::fuzz

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>

#include "verge/io/file/bag.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"

namespace verge::io {

/// What a ROS 1 bag begins with; what comes behind it, up to the end of the line, is the version.
inline constexpr std::string_view kRosbag1Magic = "#ROSBAG V";

/// The messages of a ROS 1 bag of version 2.0 (chunks none, bz2, lz4), read from the front to the end, one
/// chunk in memory at a time. The index at its end gives the topics; where it is damaged or missing (a bag
/// that was not closed: .active) the file is read through once before, and its end is an Error kDamaged after
/// its last message. A chunk that is damaged is an Error, and the next chunk is read.
///
/// Fails with kUnusable where the bytes are no such bag.
[[nodiscard]] Expected<std::unique_ptr<Bag>> open_rosbag1_bag(Input input);

/// Its scans; fails as open_rosbag1_bag() and open_bag() do.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_rosbag1(Input input, const RecordingOptions& options);

}  // namespace verge::io

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "verge/io/sink.hpp"

namespace verge::io {

/// A capture of the packets that a Velodyne would have sent to see these scans: options.model or, where none
/// is given, the first scan's own sensor; with the calibration if one is given.
///
/// Scans of that sensor give the same clouds when they are read again. Of others, what the sensor cannot have
/// seen (off its beams, two points of one shot, out of reach) is left out and counted in one warning at the
/// end. Points without times get those of a head that turns evenly; scans without a time follow each other by
/// 0.1 s from 1970. Intensities between 0 and 1 are multiplied by 255. Labels, flags and pulse widths stay
/// behind, as do the sensor's own position packets; with options.position_packets a locked receiver's stand
/// between the data packets, ten a second (of times that these can say). write() fails with kUsage where the
/// model is not known, and with kCannotWrite for scans of before 1970 or after 2106.
[[nodiscard]] Expected<std::unique_ptr<Sink>> create_pcap_sink(const std::filesystem::path& path,
                                                               const SinkOptions& options);

}  // namespace verge::io

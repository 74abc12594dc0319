// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "verge/core/bytes.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"
#include "verge/sensor/ibeo/lux.hpp"

namespace verge::io {

/// Whether the first bytes of a file look like messages of an ibeo LUX or SICK LD-MRS: somewhere in them is a
/// magic with a size and a type that can be.
[[nodiscard]] bool is_ibeo(Bytes head);

/// A LUX whose layers look where the calibration file says (the form of sensor/velodyne/calibration.hpp: each
/// layer is a `laser_id`, 0 = the lowest, with its `vert_correction` in radians, up is positive); without a
/// file, ibeo::lux(). Fails as the file does, with kUsage where it does not have four layers, and with
/// kUnusable where layers do not rise or anything but their elevation is corrected: the messages have no
/// place for it.
[[nodiscard]] Expected<sensor::ibeo::LuxModel> lux_with_layers(
    const std::optional<std::filesystem::path>& calibration);

/// A recording of an ibeo LUX or SICK LD-MRS: the bytes as they came by TCP, or an .idc file, which is the
/// same with the size of the message before in each header, a frame index and a trailer. One scan of the
/// sensor is one scan of the recording; sensor::ibeo::cloud_of() says how its points come about. The frame
/// index is checked and not needed. What the sensor says of its health stands in the notes of the next scan;
/// objects and vehicle states are checked and counted.
///
/// next() fails with kDamaged for bytes that are no message, messages cut short or too large, messages of a
/// known type whose body is wrong, and, once at the end, an .idc file without trailer: its recorder did not
/// close it. Opening fails with kUnusable (empty, or the messages of an ALASCA XT) and kUsage (a model that
/// is neither "lux" nor "ldmrs"), and as lux_with_layers() of the options' calibration.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_ibeo(Input input,
                                                             const RecordingOptions& options = {});

}  // namespace verge::io

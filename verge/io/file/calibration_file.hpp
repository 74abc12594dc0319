// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "verge/core/error.hpp"
#include "verge/sensor/velodyne/calibration.hpp"

namespace verge::io {

/// The calibration in a file: of a Velodyne sensor's lasers, or of a LUX's layers, which have elevations
/// alone. Fails as the file does, and as read_calibration().
[[nodiscard]] Expected<sensor::velodyne::Calibration> read_calibration_file(const std::filesystem::path& path,
                                                                            std::size_t lasers);

}  // namespace verge::io

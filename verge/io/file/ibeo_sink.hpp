// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "verge/io/sink.hpp"

namespace verge::io {

/// An .idc file of a LUX's scans (0x2202; its layers: lux_with_layers() of the options' calibration), closed
/// with frame index and trailer. Scans of a LUX give the same clouds when they are read again, times
/// included; of others, what is off its four layers or beyond the wire is left out and counted in one warning
/// at the end. Intensities and labels stay behind; so do the objects, health and vehicle states of a
/// recording, which are no scans. write() fails with kUsage for another model than "lux" or "ldmrs", and with
/// kCannotWrite where a scan has more than 65535 points or lies before 1970 or after 2036.
[[nodiscard]] Expected<std::unique_ptr<Sink>> create_idc_sink(const std::filesystem::path& path,
                                                              const SinkOptions& options);

/// The messages of an ALASCA XT (type 15), one behind the other. As above; the wire has no times of points,
/// and a scan has at most 8648 of these.
[[nodiscard]] Expected<std::unique_ptr<Sink>> create_alasca_sink(const std::filesystem::path& path,
                                                                 const SinkOptions& options);

}  // namespace verge::io

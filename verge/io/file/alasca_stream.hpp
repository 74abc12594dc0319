// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "verge/core/bytes.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"

namespace verge::io {

/// Whether the first bytes of a file look like messages of an ibeo ALASCA XT: somewhere in them is a magic
/// with a size that can be and a type that is known.
[[nodiscard]] bool is_alasca(Bytes head);

/// A recording of an ibeo ALASCA XT: the bytes as they came by TCP. One compressed scan (type 15) is one scan
/// of the recording; other messages are skipped by their size and counted. The sensor's clock has no epoch
/// that we know, and a scan no times of its points: there is no stamp.
///
/// next() fails with kDamaged for bytes that are no message, messages cut short or too large, and scans whose
/// size is wrong. Opening fails with kUnusable (empty, or the messages of a LUX) and kUsage (a model that is
/// not "alasca_xt").
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_alasca(Input input,
                                                               const RecordingOptions& options = {});

}  // namespace verge::io

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "verge/io/recording.hpp"
#include "verge/io/source.hpp"

namespace verge::io {

/// The scans of a recording, organised, named 000000, 000001, ... by their place in it, the frames asked for.
[[nodiscard]] std::unique_ptr<Source> source_of(std::unique_ptr<Recording> recording, SourceInfo info,
                                                OpenOptions options);

}  // namespace verge::io

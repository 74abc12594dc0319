// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "verge/scan/scan.hpp"

namespace verge::study {

/// The scan without this share of its points (0..1), whatever their range: which ones is a function of the
/// seed, the scan's index and the point's place in the input. Rings stay, also those that lose all points.
[[nodiscard]] Scan thin(Scan scan, double share, std::uint64_t seed, std::uint64_t index);

}  // namespace verge::study

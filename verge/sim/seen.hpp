// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "verge/model/scene.hpp"
#include "verge/scan/scan.hpp"

namespace verge::sim {

/// So many returns make a face, or an object, visible.
inline constexpr std::size_t kSeenReturns = 3;

/// Tells of true objects what the scan, whose labels are those of simulate_scan, saw of them. The shape is
/// J or L where two faces of the box hold kSeenReturns each, else "-": a return belongs to the nearest of the
/// faces that look towards the sensor, if it lies within 0.15 m of it. Objects of fewer returns in all get no
/// shape and the confidence 0: nobody can say them of this scan.
void tell_seen(std::vector<Object>& objects, const Scan& scan);

}  // namespace verge::sim

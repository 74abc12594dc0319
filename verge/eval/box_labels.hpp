// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"

namespace verge::eval {

/// Boxes round the objects of one nuScenes scan, from a file {"boxes": [{"class": "car",
/// "box_xyz_lwh_yaw_lidar": [x, y, z, length, width, height, yaw]}, ...]}: centre and size in metres, yaw
/// from +x in radians, all in nuScenes' lidar frame (x right, y forward). Here they are turned as the scan
/// is, to x forward and y left; ids count from 0, the confidence is 1. Buses, trailers and construction
/// vehicles are trucks, barriers and cones roadside; a class of another name is unknown. What else the file
/// says is passed over.
///
/// Fails as io::Input does, and with kUnusable, at the line and column of what is wrong, where the file is no
/// JSON, a box lacks its class or its seven numbers, or a size is not above 0 and up to 1000 m.
[[nodiscard]] Expected<std::vector<Object>> read_nuscenes_boxes(const std::filesystem::path& path);

}  // namespace verge::eval

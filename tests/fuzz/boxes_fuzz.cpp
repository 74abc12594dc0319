// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/side_files.hpp"
#include "verge/eval/box_labels.hpp"

namespace verge::fuzz {
namespace {

bool is_box(const Object& box) {
  return std::isfinite(box.center.x) && std::isfinite(box.center.y) && std::isfinite(box.center.z) &&
         std::isfinite(box.yaw_rad) && box.size.length_m > 0.0 && box.size.width_m > 0.0 &&
         box.size.height_m > 0.0;
}

}  // namespace

std::vector<std::string> seeds() {
  return {R"({"frame": "a", "boxes": [
 {"class": "car", "box_xyz_lwh_yaw_lidar": [18.4, 59.5, 0.77, 4.5, 1.8, 1.6, 3.1], "velocity": [NaN, -Infinity]},
 {"class": "pedestrian", "box_xyz_lwh_yaw_lidar": [1, 2, 3, 0.6, 0.6, 1.7, 0]}]})",
          R"({"boxes": [{"class": "car", "box_xyz_lwh_yaw_lidar": [1, 2, 3, 0, 0, 0, 1e308]}]})",
          R"({"boxes": [{"class": "\ud800\"NaN", "box_xyz_lwh_yaw_lidar": [NaN]}], "boxes": 1})",
          "\"\\",
          "[[[[[[[[1e999]]]]]]]]",
          "{"};
}

/// Boxes have a place and a size; what cannot be read says where.
void check(Bytes input) {
  static const SideFiles files;
  files.write("a_boxes.json", {reinterpret_cast<const char*>(input.data()), input.size()});
  const auto boxes =
      bounded(input, [&] { return eval::read_nuscenes_boxes(files.folder() / "a_boxes.json"); });
  if (!boxes) {
    require(!boxes.error().what.empty() && !boxes.error().where.empty());
    return;
  }
  for (const Object& box : *boxes) require(is_box(box));
}

}  // namespace verge::fuzz

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verge/model/scene.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/organise.hpp"

// Scans on which the laws are checked, and what may be done to them.

namespace verge::laws {

/// A cloud with its rings known.
struct Subject {
  std::string name;
  Cloud cloud;
};

/// A straight road, one turned against the vehicle, a curve, and a street with houses; deskewed.
[[nodiscard]] std::vector<Subject> simulated_subjects();

/// Up to `count` scans of each real set below `data`, spread evenly over it: HDL-32E, HDL-64E, VLP-16.
[[nodiscard]] std::vector<Subject> real_subjects(const std::filesystem::path& data, std::size_t count);

/// y to -y: what was left is right.
[[nodiscard]] Cloud mirrored_left_right(const Cloud& cloud);
/// x to -x: what was ahead is behind.
[[nodiscard]] Cloud mirrored_front_back(const Cloud& cloud);

/// The cloud and a ceiling: three rings above all others, all around, whose points lie `height_m` over the
/// road.
[[nodiscard]] Cloud with_ceiling(const Cloud& cloud, const Mount& mount, double height_m);

[[nodiscard]] Scene mirrored_left_right(Scene scene);
[[nodiscard]] Scene mirrored_front_back(Scene scene);
[[nodiscard]] Scene turned(Scene scene, double angle_rad);

/// How well two scenes agree in the plane: how many vertices of each one's boundaries lie near a boundary of
/// the same side in the other.
struct Agreement {
  std::size_t vertices = 0;
  std::size_t near = 0;

  [[nodiscard]] double share() const {
    return vertices == 0 ? 1.0 : static_cast<double>(near) / static_cast<double>(vertices);
  }
  Agreement& operator+=(const Agreement& other) {
    vertices += other.vertices;
    near += other.near;
    return *this;
  }
};
[[nodiscard]] Agreement agreement(const Scene& a, const Scene& b, double tolerance_m);

}  // namespace verge::laws

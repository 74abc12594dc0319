// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/layer_geometry.hpp"

#include <cmath>

namespace verge::detect::road_width {

double LayerGeometry::hit_m(int line) const { return height_m * std::tan(nearest_rad + line * step_rad); }

PicturePoint LayerGeometry::hit(int line, double azimuth_rad) const {
  const double pitch_rad = std::numbers::pi / 2.0 - nearest_rad - 0.5 * span_rad;
  const double elevation_rad = -0.5 * span_rad + line * step_rad;
  const double ahead = std::cos(elevation_rad) * std::cos(azimuth_rad);
  const double right = std::cos(elevation_rad) * std::sin(azimuth_rad);
  const double up = std::sin(elevation_rad);
  const double down = ahead * std::sin(pitch_rad) - up * std::cos(pitch_rad);
  const double far = height_m / down;
  return {far * right, far * (ahead * std::cos(pitch_rad) + up * std::sin(pitch_rad))};
}

double LayerGeometry::gap_m(int line, Reading reading) const {
  const double farther = nearest_rad + (line + 1) * step_rad;  // F_{i+1} R O
  const double twice = reading == Reading::kPaper ? step_rad : 0.0;
  return height_m * std::tan(farther + twice) - hit_m(line);  // Eq. (1)
}

double LayerGeometry::first_to_last_m() const {
  return height_m * (std::tan(nearest_rad + span_rad) - std::tan(nearest_rad));
}

double LayerGeometry::guaranteed_speed(double scans_a_second) const {
  return first_to_last_m() * scans_a_second;
}

double LayerGeometry::face_length_m(int line, double face_height_m) const {
  return face_height_m * std::tan(nearest_rad + line * step_rad);
}

}  // namespace verge::detect::road_width

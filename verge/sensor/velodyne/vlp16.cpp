// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/angle.hpp"
#include "verge/sensor/velodyne/facts.hpp"

// Velodyne VLP-16 (Puck): 16 lasers from -15 to +15 degrees, two firings a block.
//
// Sources: VLP-16 User Manual 63-9243, table 9-1 (angles by laser), section 9.4 (2.304 us from laser to
// laser, 55.296 us from firing to firing), section 9.3 (2 mm a count), reach 100 m; the angles and the timing
// agree with the public ROS driver's VLP16db.yaml and with nebula's decoder.
namespace verge::sensor::velodyne {
namespace {

constexpr std::size_t kLasers = 16;
constexpr std::int32_t kLaserToLaserNs = 2304;
constexpr std::int32_t kFiringToFiringNs = 55'296;

}  // namespace

Facts vlp16_facts() {
  Facts facts{.model = Model::kVlp16,
              .product = 0x22,
              .lasers = kLasers,
              .lasers_per_firing = kLasers,
              .step_ns = 2 * kFiringToFiringNs,
              .range_min_m = 0.4};
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    facts.slot_time_ns[slot] = static_cast<std::int32_t>(slot / kLasers) * kFiringToFiringNs +
                               static_cast<std::int32_t>(slot % kLasers) * kLaserToLaserNs;
  }
  // Even lasers are the lower half from -15 degrees, odd ones the upper half from +1, in steps of 2.
  for (int laser = 0; laser < static_cast<int>(kLasers); ++laser) {
    const double elevation_deg = laser % 2 == 0 ? laser - 15.0 : laser;
    facts.calibration.push_back({.elevation_rad = deg_to_rad(elevation_deg)});
  }
  return facts;
}

}  // namespace verge::sensor::velodyne

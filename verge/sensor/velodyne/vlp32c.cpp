// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/angle.hpp"
#include "verge/sensor/velodyne/facts.hpp"

// Velodyne VLP-32C (Ultra Puck): 32 lasers from -25 to +15 degrees, fired two at a time, in four columns.
//
// Sources: VLP-32C User Manual 63-9325, table 9-2 (elevation and azimuth offset by laser), table 9-6 (columns
// of +-1.4 and +-4.2 degrees), section 9.4 (2.304 us from pair to pair, 55.296 us from firing to firing), 4
// mm a count, reach 200 m; the public ROS driver's VeloView-VLP-32C.yaml has the same angles.
namespace verge::sensor::velodyne {
namespace {

struct Aim {
  double elevation_deg;
  double azimuth_deg;
};

constexpr std::array<Aim, kSlotsPerBlock> kAims = {{
    {-25.000, 1.4}, {-1.000, -4.2}, {-1.667, 1.4}, {-15.639, -1.4},  //
    {-11.310, 1.4}, {0.000, -1.4},  {-0.667, 4.2}, {-8.843, -1.4},   //
    {-7.254, 1.4},  {0.333, -4.2},  {-0.333, 1.4}, {-6.148, -1.4},   //
    {-5.333, 4.2},  {1.333, -1.4},  {0.667, 4.2},  {-4.000, -1.4},   //
    {-4.667, 1.4},  {1.667, -4.2},  {1.000, 1.4},  {-3.667, -4.2},   //
    {-3.333, 4.2},  {3.333, -1.4},  {2.333, 1.4},  {-2.667, -1.4},   //
    {-3.000, 1.4},  {7.000, -1.4},  {4.667, 1.4},  {-2.333, -4.2},   //
    {-2.000, 4.2},  {15.000, -1.4}, {10.333, 1.4}, {-1.333, -1.4},   //
}};

constexpr std::int32_t kPairToPairNs = 2304;
constexpr std::int32_t kFiringToFiringNs = 55'296;

}  // namespace

Facts vlp32c_facts() {
  Facts facts{.model = Model::kVlp32c,
              .product = 0x28,
              .step_ns = kFiringToFiringNs,
              .range_step_m = 0.004,
              .range_min_m = 0.4,
              .range_max_m = 200.0};
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    facts.slot_time_ns[slot] = static_cast<std::int32_t>(slot / 2) * kPairToPairNs;
  }
  for (const Aim& aim : kAims) {
    facts.calibration.push_back(
        {.elevation_rad = deg_to_rad(aim.elevation_deg), .azimuth_rad = deg_to_rad(aim.azimuth_deg)});
  }
  return facts;
}

}  // namespace verge::sensor::velodyne

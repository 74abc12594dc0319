// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/angle.hpp"
#include "verge/sensor/velodyne/facts.hpp"

// Velodyne HDL-64E, series S1, S2 (and S2.1) and S3: 64 lasers from -24.33 to +2 degrees in two banks.
//
// Sources. Elevations: HDL-64E S2 and S3 manuals (upper block +2 to -8.33 degrees in steps of 1/3, lower
// block -8.83 to -24.33 in steps of 1/2). Order of the lasers: the calibrations that the public ROS driver
// (64e_utexas, 64e_s2.1-sztaki, 64e_s3-xiesc) and VeloView (HDL-64.xml) publish agree on it, but for the
// places where one sensor's two banks overlap. Azimuths: mean of the two S3 sensors among them, which are
// within 0.2 degrees of each other. Offsets of the beams: the three sensors of S2 and S3. Timing: "Laser
// firing time table" of the S2 manual (48 us from firing to firing) and of the S3 manual (57.6 us), which
// agree with the packet rates of the ROS driver (3472.17/s = 6 x 48 us; 5787.03/s = 3 x 57.6 us with two
// echoes). S1: 2600 packets a second (ROS driver); its manual has no table, so the lasers of a block count as
// simultaneous.
namespace verge::sensor::velodyne {
namespace {

constexpr std::size_t kLasers = 64;
constexpr std::size_t kLowerBlock = 32;

/// Ring of each laser: 0 = lowest.
constexpr std::array<int, kLasers> kRing = {36, 37, 58, 59, 38, 39, 32, 33, 40, 41, 34, 35, 48, 49, 42, 43,
                                            50, 51, 44, 45, 52, 53, 46, 47, 60, 61, 54, 55, 62, 63, 56, 57,
                                            4,  5,  26, 27, 6,  7,  0,  1,  8,  9,  2,  3,  16, 17, 10, 11,
                                            18, 19, 12, 13, 20, 21, 14, 15, 28, 29, 22, 23, 30, 31, 24, 25};

/// Azimuth of each laser against the head's, clockwise.
constexpr std::array<double, kLasers> kAzimuthDeg = {
    4.5, 2.4,  -3.4, -5.6, 0.1,  -2.1, 0.9,  -1.3, -4.1, -6.4, -3.3, -5.6, 4.4, 2.2,  5.2, 3.0,
    0.2, -2.1, 1.0,  -1.3, -4.1, -6.3, -3.3, -5.5, 4.5,  2.2,  5.3,  3.0,  0.2, -2.0, 1.0, -1.3,
    7.4, 3.9,  -5.0, -8.3, 0.4,  -3.0, 1.7,  -1.8, -6.5, -9.9, -5.4, -8.8, 7.2, 3.7,  8.6, 5.0,
    0.4, -2.9, 1.7,  -1.8, -6.2, -9.6, -5.1, -8.5, 7.0,  3.7,  8.3,  4.9,  0.4, -2.8, 1.6, -1.6};

double elevation_deg(int ring) { return ring < 32 ? -24.33 + 0.5 * ring : -8.33 + (ring - 32) / 3.0; }

Calibration nominal(double distance_m) {
  Calibration calibration;
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    calibration.push_back({.elevation_rad = deg_to_rad(elevation_deg(kRing[laser])),
                           .azimuth_rad = deg_to_rad(kAzimuthDeg[laser]),
                           .distance_m = distance_m,
                           .up_m = laser < kLowerBlock ? 0.21 : 0.15,
                           .left_m = laser % 2 == 0 ? 0.026 : -0.026});
  }
  return calibration;
}

/// Four lasers of a bank fire one after the other, then the next four.
struct FiringTable {
  std::int32_t firing_ns;
  std::int32_t four_lasers_ns;
  std::array<std::int32_t, 4> laser_ns;
};
constexpr FiringTable kSeries2 = {48'000, 6'000, {0, 1260, 2460, 3660}};
constexpr FiringTable kSeries3 = {57'600, 7'200, {0, 1300, 2500, 3700}};
constexpr std::int32_t kSeries1BlockNs = 32'051;

void set_timing(Facts& facts, const FiringTable& table) {
  facts.step_ns = table.firing_ns;
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    facts.slot_time_ns[slot] =
        static_cast<std::int32_t>(slot / 4) * table.four_lasers_ns + table.laser_ns[slot % 4];
  }
}

}  // namespace

Facts hdl64e_facts(Model series) {
  Facts facts{.model = series, .lasers = kLasers, .banks = 2, .range_max_m = 120.0};
  facts.banks_share_step = series != Model::kHdl64eS1;
  facts.has_clock = series != Model::kHdl64eS1;
  facts.calibration = nominal(series == Model::kHdl64eS1 ? 0.15 : 1.4);
  if (series == Model::kHdl64eS1) facts.step_ns = kSeries1BlockNs;
  if (series == Model::kHdl64eS2) set_timing(facts, kSeries2);
  if (series == Model::kHdl64eS3) set_timing(facts, kSeries3);
  return facts;
}

}  // namespace verge::sensor::velodyne

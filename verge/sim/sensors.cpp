// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/sensors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verge/core/angle.hpp"
#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sim {
namespace {

namespace velodyne = sensor::velodyne;
namespace ibeo = sensor::ibeo;

// The distance at which 10 % of a matt surface are seen straight on, from that at which asphalt (12 %) is
// still seen by a sensor so high above it.
double reach_from_asphalt(double distance_m, double height_m) {
  constexpr double kAsphaltTenths = 1.2;
  return distance_m * std::sqrt(1.0 / (kAsphaltTenths * height_m / distance_m));
}

// Divergence: VLP-16 and VLS-128 manuals, 3.0 mrad along the rings and 1.5 upright; we take all models' beams
// to be alike. Pulses of 5 ns: ours. Reach: asphalt is seen to 50 m (HDL-64E manual, "50 m range for
// pavement", on a car's roof 1.73 m up); the labelled nuScenes scans of an HDL-32E 1.84 m up end at 50 m too.
Optics velodyne_optics() {
  return {.across_rad = 3.0e-3, .up_rad = 1.5e-3, .pulse_m = 0.75, .reach_m = reach_from_asphalt(50.0, 1.73)};
}

// Divergence: SICK LD-MRS data sheet, 0.08 degrees along a layer; upright 0.8 degrees, so that its layers
// touch. Reach: the same, 50 m at 10 % remission. Pulses of 5 ns: ours.
Optics ibeo_optics(double layer_step_deg) {
  return {
      .across_rad = deg_to_rad(0.08), .up_rad = deg_to_rad(layer_step_deg), .pulse_m = 0.75, .reach_m = 50.0};
}

template <velodyne::Model kModel>
LidarModel make_velodyne(double rate_hz) {
  sensor::BeamModel facts = velodyne::beam_model(velodyne::facts_of(kModel));
  facts.rate_hz = rate_hz;
  return spinning_lidar(std::move(facts), velodyne_optics());
}

LidarModel make_lux(double rate_hz) {
  const bool can_focus = rate_hz == 12.5;
  return lux_lidar(ibeo::lux(), rate_hz, can_focus ? ibeo::focused_zones() : ibeo::constant_zones(rate_hz),
                   ibeo_optics(0.8));
}

LidarModel make_lux_constant(double rate_hz) {
  return lux_lidar(ibeo::lux(), rate_hz, ibeo::constant_zones(rate_hz), ibeo_optics(0.8));
}

LidarModel make_alasca(double /*rate_hz*/) { return alasca_lidar(ibeo::alasca_xt(), ibeo_optics(3.2 / 3.0)); }

LidarModel make_coarse_alasca(double /*rate_hz*/) {
  ibeo::AlascaModel facts = ibeo::alasca_xt();
  facts.step_rad = deg_to_rad(0.5);
  return alasca_lidar(std::move(facts), ibeo_optics(3.2 / 3.0));
}

constexpr std::array kSpins = {5.0, 20.0};
constexpr std::array kSweeps = {12.5, 25.0, 50.0};
constexpr std::array kTwentyHertz = {20.0};

SensorEntry spinning(std::string_view name, std::string_view about, LidarModel (*make)(double)) {
  return {name, about, 10.0, kSpins, true, make};
}

bool can_turn_at(const SensorEntry& entry, double rate_hz) {
  if (entry.even) return rate_hz >= entry.rates_hz.front() && rate_hz <= entry.rates_hz.back();
  return std::find(entry.rates_hz.begin(), entry.rates_hz.end(), rate_hz) != entry.rates_hz.end();
}

}  // namespace

std::span<const SensorEntry> sensors() {
  using velodyne::Model;
  static const std::array kSensors = {
      spinning("hdl32e", "Velodyne HDL-32E: 32 rings", make_velodyne<Model::kHdl32e>),
      spinning("vlp16", "Velodyne VLP-16: 16 rings", make_velodyne<Model::kVlp16>),
      spinning("vlp32c", "Velodyne VLP-32C: 32 rings", make_velodyne<Model::kVlp32c>),
      spinning("hdl64e", "Velodyne HDL-64E, series S2: 64 rings", make_velodyne<Model::kHdl64eS2>),
      spinning("hdl64e-s1", "its series S1", make_velodyne<Model::kHdl64eS1>),
      spinning("hdl64e-s3", "its series S3", make_velodyne<Model::kHdl64eS3>),
      SensorEntry{"lux", "ibeo LUX: 4 layers, three echoes, finest ahead (at 12.5 Hz)", 12.5, kSweeps, false,
                  make_lux},
      SensorEntry{"lux-constant", "the same with equal steps", 12.5, kSweeps, false, make_lux_constant},
      SensorEntry{"alasca_xt", "ibeo ALASCA XT: 4 layers, three echoes, steps of 0.25 degrees", 20.0,
                  kTwentyHertz, false, make_alasca},
      SensorEntry{"alasca_xt-coarse", "the same with steps of 0.5 degrees", 20.0, kTwentyHertz, false,
                  make_coarse_alasca}};
  return kSensors;
}

LidarModel sensor_named(std::string_view name, std::optional<double> rate_hz) {
  std::vector<std::string_view> names;
  for (const SensorEntry& entry : sensors()) {
    names.push_back(entry.name);
    if (entry.name != name) continue;
    const double rate = rate_hz.value_or(entry.usual_rate_hz);
    if (can_turn_at(entry, rate)) return entry.make(rate);
    throw std::invalid_argument(fmt::format("a {} does not make {} scans a second (but {})", name, rate,
                                            fmt::join(entry.rates_hz, entry.even ? " to " : ", ")));
  }
  throw std::invalid_argument(fmt::format("unknown sensor '{}' (known: {})", name, fmt::join(names, ", ")));
}

}  // namespace verge::sim

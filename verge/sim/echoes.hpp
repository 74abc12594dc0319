// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/sim/caster.hpp"
#include "verge/sim/lidar_model.hpp"
#include "verge/sim/noise.hpp"
#include "verge/sim/weather.hpp"

namespace verge::sim {

/// How a real sensor departs from a perfect one.
struct NoiseConfig {
  std::uint64_t seed = 1;
  double range_sigma_m = 0.02;
  double dropout_at_range_max = 0.3;
  double reach = 1.0;
  double fading_db = 2.0;
  std::int64_t beam_rays = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.range_sigma_m, {"range_sigma_m", "m", 0.0, 1.0,
                               "deviation of the Gaussian noise of each range", "HDL-32E manual: 2 cm"});
    visit(self.dropout_at_range_max, {"dropout_at_range_max", "1", 0.0, 1.0,
                                      "share of returns lost for no other reason at the sensor's greatest "
                                      "range; it grows with the square of the range",
                                      "ours"});
    visit(self.reach,
          {"reach", "1", 0.0, 10.0,
           "of the sensor's reach, beyond which too little comes back from dark or grazing surfaces; 0 = "
           "everything that is hit is seen",
           "ours"});
    visit(self.fading_db, {"fading_db", "dB", 0.0, 10.0, "deviation of what comes back", "ours"});
    visit(self.beam_rays,
          {"beam_rays", "1", 1, 9,
           "rays along each side of a beam's cross-section; 1 = a beam is a line, more = mixed "
           "ranges or several echoes at edges",
           "ours"});
  }
};

/// What a sensor reports of one echo of a shot.
struct Return {
  double range_m = 0.0;      ///< From the beam's origin.
  float intensity = 0.0F;    ///< Per cent; above 100: retro-reflectors, up to 255.
  float pulse_width = 0.0F;  ///< In the sensor's unit.
  std::uint32_t flags = 0;
  std::uint32_t label = 0;  ///< label_of() what most of the light came back from.
  std::uint8_t echo = 0;    ///< 0 = the nearest.
};

/// The label of a point: the Surface in the lower 16 bits, the object (1, 2, ...; 0 = none) in the upper
/// ones, as SemanticKITTI puts class and instance.
[[nodiscard]] std::uint32_t label_of(Surface surface, std::uint32_t object);

/// Makes of what the rays of a beam hit what the sensor reports.
///
/// Light: a surface of reflectivity r at a distance d, hit at an angle, sends back r / 10 % x cos(angle) x
/// (reach / d)^2 of what suffices for a return, weakened by rain, times a lognormal fading. A
/// retro-reflector sends back ten times what it catches, up to 60 degrees. Water on a road keeps its share
/// of the matt return and mirrors what Schlick's formula (refractive index 1.33) says. What is nearer
/// together than a pulse is one echo at the mean distance, weighted by the light. Several echoes: the first
/// ones; one: the strongest.
class Receiver {
 public:
  Receiver(const Caster& world, const LidarModel& model, const NoiseConfig& noise, const Weather& weather)
      : world_(world), model_(model), noise_(noise), weather_(weather) {}

  /// Puts the echoes of one shot behind `out`, nearest first. `rays` and `hits`: of the beam's cross-section,
  /// in the world; `beside`: what rays hit that pass beside the beam, for blooming.
  void receive(const Shot& shot, std::span<const Ray> rays, std::span<const std::optional<Hit>> hits,
               std::span<const std::optional<Hit>> beside, const RayKey& key, std::vector<Return>& out);

 private:
  struct Light {  // that comes back from one distance
    double distance_m = 0.0;
    double power = 0.0;
    double reflectivity = 0.0;
    std::uint32_t label = 0;
    std::uint32_t flags = 0;
    double nearest_m = 0.0;  // of what was merged
    double strongest = 0.0;
  };

  [[nodiscard]] double straight_back(double distance_m) const;
  void add_surface(const Ray& ray, const Hit& hit, double share);
  void add_mirrored(const Ray& ray, const Hit& hit, double share);
  void add_drop(const RayKey& key);
  void add_dirt();
  void gather(std::span<const Ray> rays, std::span<const std::optional<Hit>> hits,
              std::span<const std::optional<Hit>> beside, const RayKey& key);
  void weaken();
  void merge();
  void report_first(const RayKey& key, std::vector<Return>& out) const;
  void report_strongest(const RayKey& key, std::vector<Return>& out) const;
  [[nodiscard]] bool is_dirty(const Shot& shot) const;
  [[nodiscard]] bool is_seen(const Light& light, const RayKey& key, std::uint64_t index) const;
  [[nodiscard]] std::optional<Return> measure(const Light& light, const RayKey& key,
                                              std::uint64_t index) const;

  const Caster& world_;
  const LidarModel& model_;
  const NoiseConfig& noise_;
  const Weather& weather_;
  std::vector<Light> lights_;  // of the shot at hand
};

}  // namespace verge::sim

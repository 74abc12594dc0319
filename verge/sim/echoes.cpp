// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/echoes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "verge/core/angle.hpp"

namespace verge::sim {
namespace {

// Reflectivity in per cent of dry, clean surfaces: asphalt, concrete, paving, grass, plaster, galvanised
// steel, leaves, paint, clothes, orange plastic, retro-reflecting sheet, nothing.
double reflectivity(Surface surface) {
  static constexpr std::array<double, enum_names<Surface>.size()> kPercent = {
      12.0, 35.0, 28.0, 45.0, 60.0, 55.0, 50.0, 40.0, 30.0, 70.0, 1000.0, 0.0};
  return kPercent.at(static_cast<std::size_t>(surface));
}

bool is_wettable(Surface surface) { return surface == Surface::kRoad; }

// Share of the light that water mirrors (Schlick 1994, refractive index 1.33).
double mirrored_share(double cos_incidence) {
  constexpr double kStraight = 0.02;
  return kStraight + (1.0 - kStraight) * std::pow(1.0 - cos_incidence, 5.0);
}

// Extinction of rain, per metre and one way: 1.076 x rain^0.67 dB/km (ITU-R P.1814).
double extinction_per_m(double rain_mmph) {
  constexpr double kDbPerNeper = 4.342944819;
  return 1.076e-3 * std::pow(rain_mmph, 0.67) / kDbPerNeper;
}

// Whether a direction lies between two others, counter-clockwise from the first.
bool is_between(double angle_rad, double from_rad, double to_rad) {
  if (from_rad > to_rad) return angle_rad >= from_rad || angle_rad <= to_rad;  // over the rear
  return angle_rad >= from_rad && angle_rad <= to_rad;
}

constexpr std::uint32_t kNoThing = 0;

}  // namespace

std::uint32_t label_of(Surface surface, std::uint32_t object) {
  return (object << 16U) | static_cast<std::uint32_t>(surface);
}

// Of a surface of 10 % that is hit straight on.
double Receiver::straight_back(double distance_m) const {
  const double reach_m = noise_.reach > 0.0 ? noise_.reach * model_.optics.reach_m : 1.0;
  const double ratio = reach_m / distance_m;
  return ratio * ratio;
}

void Receiver::add_surface(const Ray& ray, const Hit& hit, double share) {
  if (!(hit.distance_m > 0.0)) return;
  constexpr double kTenth = 10.0;
  constexpr double kReflectorCosMin = 0.5;
  const double percent = reflectivity(hit.surface);
  const bool straight = hit.surface == Surface::kReflector && hit.cos_incidence > kReflectorCosMin;
  double power =
      share * percent / kTenth * (straight ? 1.0 : hit.cos_incidence) * straight_back(hit.distance_m);
  if (weather_.wet_road > 0.0 && is_wettable(hit.surface)) {
    add_mirrored(ray, hit, share * weather_.wet_road * mirrored_share(hit.cos_incidence));
    power *= 1.0 - weather_.wet_road;
  }
  lights_.push_back(
      {hit.distance_m, power, percent, label_of(hit.surface, hit.object), 0, hit.distance_m, power});
}

// What is seen in the mirror: there and back over the water, so that it loses twice. It appears behind the
// mirror, as far as the light went.
void Receiver::add_mirrored(const Ray& ray, const Hit& hit, double share) {
  constexpr double kOffSurface_m = 1e-3;
  const Vec3 direction = ray.direction - (2.0 * dot(ray.direction, hit.normal)) * hit.normal;
  const Vec3 origin = ray.origin + hit.distance_m * ray.direction + kOffSurface_m * direction;
  const auto image = world_.cast(origin, direction);
  if (!image || is_wettable(image->surface)) return;
  constexpr double kTenth = 10.0;
  const double distance = hit.distance_m + kOffSurface_m + image->distance_m;
  const double percent = reflectivity(image->surface);
  const double power = share * mirrored_share(hit.cos_incidence) * weather_.wet_road * percent / kTenth *
                       image->cos_incidence * straight_back(distance);
  lights_.push_back({distance, power, percent, label_of(Surface::kNone, kNoThing), 0, distance, power});
}

// A drop near by: mostly within a few metres, where even a little light is enough.
void Receiver::add_drop(const RayKey& key) {
  constexpr double kUsualRain_mmph = 10.0;
  constexpr double kMeanDistance_m = 4.0;
  constexpr double kMeanPower = 3.0;
  const double share = weather_.rain_echoes * weather_.rain_mmph / kUsualRain_mmph;
  if (!(uniform(key, Draw::kDrop) < share)) return;
  const double distance = -kMeanDistance_m * std::log(1.0 - uniform(key, Draw::kDropRange));
  const double power = kMeanPower * std::exp(0.5 * gaussian(key, Draw::kDropFading));
  lights_.push_back(
      {distance, power, 1.0, label_of(Surface::kNone, kNoThing), model_.reports.rain_flag, distance, power});
}

void Receiver::weaken() {
  if (!(weather_.rain_mmph > 0.0)) return;
  const double there_and_back = 2.0 * extinction_per_m(weather_.rain_mmph);
  for (Light& light : lights_) {
    const double left = std::exp(-there_and_back * light.distance_m);
    light.power *= left;
    light.strongest *= left;
  }
}

// Lights nearer together than a pulse become one; nearest first.
void Receiver::merge() {
  if (lights_.size() < 2) return;
  std::stable_sort(lights_.begin(), lights_.end(),
                   [](const Light& a, const Light& b) { return a.distance_m < b.distance_m; });
  std::size_t last = 0;
  double end_m = lights_[0].distance_m;  // of the last one's lights
  for (std::size_t i = 1; i < lights_.size(); ++i) {
    const Light& next = lights_[i];
    Light& one = lights_[last];
    if (next.distance_m - end_m < model_.optics.pulse_m) {
      end_m = next.distance_m;
      const double power = one.power + next.power;
      if (power > 0.0) {
        const double share = next.power / power;
        one.distance_m += share * (next.distance_m - one.distance_m);
        one.reflectivity += share * (next.reflectivity - one.reflectivity);
      }
      one.power = power;
      if (next.strongest > one.strongest) {
        one.strongest = next.strongest;
        one.label = next.label;
        one.flags = next.flags;
      }
    } else {
      lights_[++last] = next;
      end_m = next.distance_m;
    }
  }
  lights_.resize(last + 1);
}

// Dirt sticks: the same patches in every scan.
bool Receiver::is_dirty(const Shot& shot) const {
  if (!(weather_.dirt > 0.0)) return false;
  constexpr double kPatchDeg = 2.0;
  const double azimuth = std::atan2(shot.direction.y, shot.direction.x);
  if (!is_between(azimuth, deg_to_rad(weather_.dirt_from_deg), deg_to_rad(weather_.dirt_to_deg)))
    return false;
  const double elevation = std::asin(std::clamp(shot.direction.z, -1.0, 1.0));
  const auto cell = [](double angle_rad) {
    return static_cast<std::uint64_t>(std::floor((rad_to_deg(angle_rad) + 180.0) / kPatchDeg));
  };
  return uniform({noise_.seed, cell(azimuth), cell(elevation)}, Draw::kDirt) < weather_.dirt;
}

bool Receiver::is_seen(const Light& light, const RayKey& key, std::uint64_t index) const {
  const double share = light.distance_m / model_.range_max_m;
  if (uniform(key, Draw::kDropout, index) < noise_.dropout_at_range_max * share * share) return false;
  if (!(noise_.reach > 0.0)) return true;
  constexpr double kNeperPerDb = 0.2302585093;
  constexpr double kSurelyEnough = 1e3;  // no fading comes near
  if (light.power > kSurelyEnough && noise_.fading_db <= 3.0) return true;
  const double fading_db =
      noise_.fading_db > 0.0 ? noise_.fading_db * gaussian(key, Draw::kFading, index) : 0.0;
  return light.power * std::exp(kNeperPerDb * fading_db) >= 1.0;
}

std::optional<Return> Receiver::measure(const Light& light, const RayKey& key, std::uint64_t index) const {
  double range = light.distance_m;
  if (noise_.range_sigma_m > 0.0) range += noise_.range_sigma_m * gaussian(key, Draw::kRangeNoise, index);
  const double step = model_.range_resolution_m;
  if (step > 0.0) range = step * std::round(range / step);
  if (range <= 0.0 || range < model_.range_min_m || range > model_.range_max_m) return std::nullopt;
  constexpr double kBrightest = 255.0;
  constexpr double kWiderTenfold = 0.25;  // of a pulse, for ten times the light: ours
  const double brighter = kWiderTenfold * std::log10(std::max(1.0, light.power));
  const double width = model_.optics.pulse_m * (1.0 + brighter) + 2.0 * (light.distance_m - light.nearest_m);
  return Return{.range_m = range,
                .intensity = static_cast<float>(std::min(kBrightest, light.reflectivity)),
                .pulse_width = static_cast<float>(model_.reports.pulse_units_per_m * width),
                .flags = light.flags,
                .label = light.label};
}

// What comes back, apart from each other, nearest first.
void Receiver::gather(std::span<const Ray> rays, std::span<const std::optional<Hit>> hits,
                      std::span<const std::optional<Hit>> beside, const RayKey& key) {
  constexpr double kBloomShare = 1e-3;  // of the light, that falls beside the beam
  const double share = 1.0 / static_cast<double>(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i]) add_surface(rays[i], *hits[i], share);
  }
  for (const auto& hit : beside) {
    if (hit && hit->surface == Surface::kReflector) add_surface({}, *hit, kBloomShare);
  }
  if (weather_.rain_mmph > 0.0) add_drop(key);
  weaken();
  merge();
}

// Dirt answers at once, and lets nothing else through.
void Receiver::add_dirt() {
  constexpr double kBright = 1e6;
  if (model_.reports.dirt_flag == 0) return;
  const double distance = model_.range_min_m + 0.1;
  lights_.push_back({distance, kBright, 1.0, label_of(Surface::kNone, kNoThing), model_.reports.dirt_flag,
                     distance, kBright});
}

void Receiver::report_first(const RayKey& key, std::vector<Return>& out) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < lights_.size() && count < model_.echoes; ++i) {
    if (!is_seen(lights_[i], key, i)) continue;
    auto one = measure(lights_[i], key, i);
    if (!one) continue;
    one->echo = static_cast<std::uint8_t>(count++);
    out.push_back(*one);
  }
}

void Receiver::report_strongest(const RayKey& key, std::vector<Return>& out) const {
  std::optional<std::size_t> strongest;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (!is_seen(lights_[i], key, i)) continue;
    if (!strongest || lights_[i].power > lights_[*strongest].power) strongest = i;
  }
  if (!strongest) return;
  if (const auto one = measure(lights_[*strongest], key, *strongest)) out.push_back(*one);
}

void Receiver::receive(const Shot& shot, std::span<const Ray> rays, std::span<const std::optional<Hit>> hits,
                       std::span<const std::optional<Hit>> beside, const RayKey& key,
                       std::vector<Return>& out) {
  lights_.clear();
  if (is_dirty(shot)) {
    add_dirt();
  } else {
    gather(rays, hits, beside, key);
  }
  if (model_.echoes > 1) {
    report_first(key, out);
  } else {
    report_strongest(key, out);
  }
}

}  // namespace verge::sim

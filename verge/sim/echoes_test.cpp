// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/echoes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/sim/lidar.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/sim/test_worlds.hpp"

namespace verge::sim {
namespace {

constexpr double kHeight_m = 1.9;

// Everything that is hit is seen, exactly.
const NoiseConfig kClean{.range_sigma_m = 0.0, .dropout_at_range_max = 0.0, .reach = 0.0};

Trajectory standing() {
  return [](std::int64_t) { return Pose{{}, {0.0, 0.0, kHeight_m}}; };
}

/// The sensor with ranges as exact as a double.
LidarModel exact(std::string_view name) {
  LidarModel model = sensor_named(name);
  model.range_resolution_m = 0.0;
  return model;
}

// Two walls across the way ahead: the near one on the left, the far one behind it.
Caster edge_before(double near_m, double far_m) {
  World world;
  add_quad(world, {near_m, 0.0, -50}, {near_m, 90, -50}, {near_m, 90, 50}, {near_m, 0.0, 50}, Surface::kWall);
  add_quad(world, {far_m, -90, -50}, {far_m, 90, -50}, {far_m, 90, 50}, {far_m, -90, 50}, Surface::kWall);
  return Caster(std::move(world));
}

bool is_none(const Scan& scan, std::size_t i) {
  return (scan.label[i] & 0xFFFFU) == static_cast<std::uint32_t>(Surface::kNone);
}

std::size_t count(const Scan& scan, const std::function<bool(std::size_t)>& holds) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) n += holds(i) ? 1U : 0U;
  return n;
}

double normal_share_below(double deviations) { return 0.5 * std::erfc(-deviations / std::numbers::sqrt2); }

TEST(Beam, OnAnEdgeOfWallsNearerThanAPulseARangeIsMixed) {
  NoiseConfig wide = kClean;
  wide.beam_rays = 5;
  const auto mixed = [&](const NoiseConfig& noise, double far_m) {
    const Scan scan = simulate_scan(edge_before(10.0, far_m), exact("hdl32e"), standing(), 0, noise);
    return count(scan, [&](std::size_t i) {
      const Vec3 p = scan.point(i);
      return std::abs(p.y) < 1.0 && p.x > 10.02 && p.x < far_m - 0.02;
    });
  };
  EXPECT_EQ(mixed(kClean, 10.5), 0U);
  EXPECT_GT(mixed(wide, 10.5), 16U);  // of 32 rings, in most one shot meets both
  EXPECT_EQ(mixed(wide, 12.0), 0U);   // farther apart than a pulse: two echoes, of which the stronger counts
}

TEST(Beam, OnAnEdgeAScannerWithEchoesSeesBothWalls) {
  NoiseConfig wide = kClean;
  wide.beam_rays = 9;
  const Scan scan = simulate_scan(edge_before(10.0, 12.0), exact("lux"), standing(), 0, wide);
  std::vector<std::size_t> echoes(3);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    ++echoes[scan.echo[i]];
    if (scan.echo[i] == 0) continue;
    EXPECT_NEAR(static_cast<double>(scan.x[i]), 12.0, 0.05);  // the mean of its part of the beam
    EXPECT_NEAR(static_cast<double>(scan.y[i]), 0.0, 0.05);
  }
  EXPECT_GE(echoes[1], 1U);
  EXPECT_EQ(echoes[2], 0U);
  EXPECT_EQ(simulate_scan(edge_before(10.0, 12.0), exact("lux"), standing(), 0, kClean).size(), echoes[0]);
}

// Matt ground sends back 45 % x cos(angle) x (reach / d)^2 of a tenth, fading by 2 dB: the share that
// suffices is a value of the normal distribution. Rain takes its part both ways.
TEST(Receiver, TheShareOfReturnsIsThatOfTheLightThatSuffices) {
  LidarModel model = exact("hdl32e");
  model.optics.reach_m = 20.0;
  model.range_max_m = 500.0;
  NoiseConfig fading = kClean;
  fading.reach = 1.0;
  const Caster ground = testing::flat_ground();
  const Scan all = simulate_scan(ground, model, standing(), 0, kClean);
  for (const double rain_mmph : {0.0, 100.0}) {
    const Scan seen =
        simulate_scan(ground, model, standing(), 0, fading, {.rain_mmph = rain_mmph, .rain_echoes = 0.0});
    int between = 0;
    for (std::size_t ring = 0; ring < std::min(seen.ring_count(), all.ring_count()); ++ring) {
      const double shots = static_cast<double>(all.ring(ring).second - all.ring(ring).first);
      const double returns = static_cast<double>(seen.ring(ring).second - seen.ring(ring).first);
      const double d = norm(all.point(all.ring(ring).first));
      const double rain_db = 2.0 * 1.076e-3 * std::pow(rain_mmph, 0.67) * d;
      const double power_db = 10.0 * std::log10(4.5 * kHeight_m / d * (20.0 / d) * (20.0 / d)) - rain_db;
      const double share = normal_share_below(power_db / 2.0);
      EXPECT_NEAR(returns / shots, share, 4.0 * std::sqrt(share * (1.0 - share) / shots) + 1e-3)
          << "ring " << ring;
      between += share > 0.01 && share < 0.99 ? 1 : 0;
    }
    EXPECT_GE(between, 2);
  }
}

TEST(Rain, DropsAnswerAsOftenAsAskedAndAreMarked) {
  const Weather rain{.rain_mmph = 20.0, .rain_echoes = 0.05};
  const Caster nothing{World{}};
  for (const auto& [name, flag] : {std::pair{"lux", 0x02U}, {"alasca_xt", 2U}, {"hdl32e", 0U}}) {
    const LidarModel model = exact(name);
    const double shots = static_cast<double>(model.shots(0).shots.size());
    std::size_t drops = 0;
    constexpr int kScans = 5;
    for (std::uint64_t scan = 0; scan < kScans; ++scan) {
      const Scan seen = simulate_scan(nothing, model, standing(), scan, kClean, rain);
      drops += seen.size();
      for (std::size_t i = 0; i < seen.size(); ++i) {
        ASSERT_TRUE(is_none(seen, i));
        if (flag != 0) {
          ASSERT_EQ(seen.flags[i], flag);
        }
      }
    }
    const double share = 0.1 * std::exp(-model.range_min_m / 4.0);  // what is nearer is not reported
    EXPECT_NEAR(static_cast<double>(drops) / (kScans * shots), share,
                4.0 * std::sqrt(share / (kScans * shots)))
        << name;
  }
}

// A wet road before a wall: the wall stands on its head under the road, and less of the road is seen.
TEST(WetRoad, ShowsMirrorImagesWhereTheyMustBe) {
  World world;
  add_ground(world, {0.0, 0.0, 0.0}, 300.0, Surface::kRoad);
  add_quad(world, {20, -99, 0}, {20, 99, 0}, {20, 99, 30}, {20, -99, 30}, Surface::kWall);
  const Caster caster(std::move(world));
  const LidarModel model = exact("hdl32e");
  NoiseConfig noise = kClean;
  noise.reach = 1.0;
  const auto images_of = [&](double wet) {
    const Scan scan = simulate_scan(caster, model, standing(), 0, noise, {.wet_road = wet});
    return count(scan, [&](std::size_t i) {
      if (!is_none(scan, i)) return false;
      EXPECT_NEAR(static_cast<double>(scan.x[i]), 20.0, 1e-4);
      EXPECT_LT(static_cast<double>(scan.z[i]), -kHeight_m);
      return true;
    });
  };
  const auto road_of = [&](double wet) {
    const Scan scan = simulate_scan(caster, model, standing(), 0, noise, {.wet_road = wet});
    return count(scan, [&](std::size_t i) { return (scan.label[i] & 0xFFFFU) == 0; });
  };
  EXPECT_EQ(images_of(0.0), 0U);
  EXPECT_GT(images_of(1.0), 100U);
  EXPECT_EQ(road_of(1.0), 0U);  // a pure mirror sends nothing straight back
  EXPECT_LT(road_of(0.9), road_of(0.0));
}

TEST(Dirt, TakesItsShareOfItsSectorAndNothingElse) {
  World world;
  add_box(world, {{0.0, 0.0, -50.0}, {60.0, 60.0, 100.0}, 0.0}, Surface::kWall);
  const Caster room(std::move(world));
  const Weather dirt{.dirt = 0.4, .dirt_from_deg = -30.0, .dirt_to_deg = 150.0};
  const auto in_sector = [](const Scan& scan, std::size_t i) {
    const double azimuth = rad_to_deg(static_cast<double>(scan.azimuth[i]));
    return azimuth >= -30.0 && azimuth <= 150.0;
  };
  const Scan clean = simulate_scan(room, exact("hdl32e"), standing(), 0, kClean);
  const Scan dirty = simulate_scan(room, exact("hdl32e"), standing(), 0, kClean, dirt);
  const auto left = [&](const Scan& scan) {
    return count(scan, [&](std::size_t i) { return in_sector(scan, i); });
  };
  EXPECT_EQ(dirty.size() - left(dirty), clean.size() - left(clean));
  const double share = 1.0 - static_cast<double>(left(dirty)) / static_cast<double>(left(clean));
  EXPECT_NEAR(share, 0.4, 4.0 * std::sqrt(0.4 * 0.6 / (90.0 * 21.0)));  // so many patches
  const Scan lux = simulate_scan(room, exact("lux"), standing(), 0, kClean, dirt);
  EXPECT_GT(count(lux, [&](std::size_t i) { return lux.flags[i] == 0x08U; }), 20U);
}

TEST(Reflectors, BloomBesideThemselves) {
  World world;
  add_quad(world, {20, -0.3, 1}, {20, 0.3, 1}, {20, 0.3, 3}, {20, -0.3, 3}, Surface::kReflector);
  const Caster caster(std::move(world));
  NoiseConfig noise = kClean;
  noise.reach = 1.0;
  const auto half_width = [&](double bloom_mrad) {
    const Scan scan =
        simulate_scan(caster, exact("hdl32e"), standing(), 0, noise, {.bloom_mrad = bloom_mrad});
    double most = 0.0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      EXPECT_EQ(scan.intensity[i], 255.0F);
      EXPECT_NEAR(norm(scan.point(i)), 20.0, 0.2);
      most = std::max(most, std::abs(static_cast<double>(scan.y[i])));
    }
    return most;
  };
  EXPECT_LE(half_width(0.0), 0.3);
  EXPECT_NEAR(half_width(20.0), 0.3 + 0.4, 0.06);  // a step of azimuth is 6 cm there
}

}  // namespace
}  // namespace verge::sim

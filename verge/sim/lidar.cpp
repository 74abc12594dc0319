// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/lidar.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "verge/core/field_io.hpp"
#include "verge/scan/organise.hpp"
#include "verge/sim/noise.hpp"

namespace verge::sim {
namespace {

constexpr std::size_t kShotsAtATime = 32;  // whatever the number of threads

/// An echo and the shot that it is of.
struct ReturnOfShot {
  Return echo;
  std::size_t shot = 0;
};

/// Offsets of the rays of a beam from its middle, as tangents across and up.
std::vector<Vec2> cross_section(const Optics& optics, std::int64_t rays) {
  std::vector<Vec2> offsets;
  const auto place = [&](std::int64_t i) {
    return (static_cast<double>(i) + 0.5) / static_cast<double>(rays) - 0.5;
  };
  for (std::int64_t row = 0; row < rays; ++row) {
    for (std::int64_t column = 0; column < rays; ++column) {
      offsets.push_back({optics.across_rad * place(column), optics.up_rad * place(row)});
    }
  }
  return offsets;
}

// Two rays each to the left, to the right, above and below, one of them half as far.
std::vector<Vec2> around(double bloom_rad) {
  std::vector<Vec2> offsets;
  if (!(bloom_rad > 0.0)) return offsets;
  for (const double far : {0.5 * bloom_rad, bloom_rad}) {
    for (const Vec2 way : {Vec2{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}})
      offsets.push_back(far * way);
  }
  return offsets;
}

/// A direction turned by small angles to the side and up.
class Turned {
 public:
  explicit Turned(Vec3 direction) : ahead_(direction) {
    const double level = norm(direction.xy());
    if (level > 0.0) across_ = {-direction.y / level, direction.x / level, 0.0};
    up_ = cross(ahead_, across_);
  }
  [[nodiscard]] Vec3 by(Vec2 offset) const {
    if (offset.x == 0.0 && offset.y == 0.0) return ahead_;
    const Vec3 turned = ahead_ + offset.x * across_ + offset.y * up_;
    return (1.0 / norm(turned)) * turned;
  }

 private:
  Vec3 ahead_;
  Vec3 across_{0.0, 1.0, 0.0};
  Vec3 up_;
};

/// What the shots of a scan need to know.
struct Shooter {
  const Caster& world;
  const LidarModel& model;
  const Trajectory& T_world_sensor_at;
  const NoiseConfig& noise;
  const Weather& weather;
  std::uint64_t index;
  std::vector<Vec2> section;
  std::vector<Vec2> beside;

  // Shots [begin, end) of the plan, each from where the sensor stands at its own time.
  [[nodiscard]] std::vector<ReturnOfShot> fire(const ShotPlan& plan, std::size_t begin,
                                               std::size_t end) const {
    const std::vector<Ray> rays = rays_of(plan, begin, end, section);
    const std::vector<Ray> rays_beside = rays_of(plan, begin, end, beside);
    std::vector<std::optional<Hit>> hits(rays.size());
    std::vector<std::optional<Hit>> hits_beside(rays_beside.size());
    world.cast(rays, hits);
    world.cast(rays_beside, hits_beside);
    Receiver receiver(world, model, noise, weather);
    std::vector<Return> echoes;
    std::vector<ReturnOfShot> returns;
    for (std::size_t shot = begin; shot < end; ++shot) {
      const std::size_t i = shot - begin;
      echoes.clear();
      receiver.receive(plan.shots[shot], std::span(rays).subspan(i * section.size(), section.size()),
                       std::span(hits).subspan(i * section.size(), section.size()),
                       std::span(hits_beside).subspan(i * beside.size(), beside.size()),
                       {noise.seed, index, shot}, echoes);
      for (const Return& echo : echoes) returns.push_back({echo, shot});
    }
    return returns;
  }

  [[nodiscard]] std::vector<Ray> rays_of(const ShotPlan& plan, std::size_t begin, std::size_t end,
                                         const std::vector<Vec2>& offsets) const {
    std::vector<Ray> rays;
    rays.reserve((end - begin) * offsets.size());
    for (std::size_t i = begin; i < end && !offsets.empty(); ++i) {
      const Shot& shot = plan.shots[i];
      const Pose T_world_sensor = T_world_sensor_at(shot.time_ns);
      const Turned turned(shot.direction);
      for (const Vec2 offset : offsets) {
        rays.push_back({T_world_sensor * shot.origin, rotate(T_world_sensor.rotation, turned.by(offset))});
      }
    }
    return rays;
  }
};

// The returns of all shots, in their order; each block of shots fills its own list.
std::vector<ReturnOfShot> shoot_all(const Shooter& shooter, const ShotPlan& plan) {
  const std::size_t blocks = (plan.shots.size() + kShotsAtATime - 1) / kShotsAtATime;
  std::vector<std::vector<ReturnOfShot>> of_block(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t begin = block * kShotsAtATime;
    of_block[block] = shooter.fire(plan, begin, std::min(begin + kShotsAtATime, plan.shots.size()));
  });
  std::vector<ReturnOfShot> all;
  for (const auto& returns : of_block) all.insert(all.end(), returns.begin(), returns.end());
  return all;
}

/// A cloud in the order of the shots, and the exact time of each of its points.
struct TimedCloud {
  Cloud cloud;
  std::vector<std::uint32_t> time_offset_ns;
};

TimedCloud collect(const std::vector<ReturnOfShot>& returns, const ShotPlan& plan, const LidarModel& model) {
  TimedCloud out;
  Cloud& cloud = out.cloud;
  for (const auto& [echo, number] : returns) {
    const Shot& shot = plan.shots[number];
    const Vec3 p = shot.origin + echo.range_m * shot.direction;
    cloud.x.push_back(static_cast<float>(p.x));
    cloud.y.push_back(static_cast<float>(p.y));
    cloud.z.push_back(static_cast<float>(p.z));
    cloud.ring.push_back(shot.ring);
    cloud.label.push_back(echo.label);
    if (model.reports.intensity) cloud.intensity.push_back(echo.intensity);
    if (model.echoes > 1) cloud.echo.push_back(echo.echo);
    if (model.reports.pulse_units_per_m > 0.0) {
      cloud.pulse_width.push_back(echo.pulse_width);
      cloud.flags.push_back(echo.flags);
    }
    out.time_offset_ns.push_back(static_cast<std::uint32_t>(shot.time_ns - plan.begin_ns));
  }
  return out;
}

Scan to_scan(TimedCloud timed) {
  Scan scan = organise(std::move(timed.cloud)).scan;
  scan.time_offset_ns.clear();
  for (const std::uint32_t i : scan.input_index) scan.time_offset_ns.push_back(timed.time_offset_ns[i]);
  return scan;
}

}  // namespace

Scan simulate_scan(const Caster& world, const LidarModel& model, const Trajectory& T_world_sensor_at,
                   std::uint64_t index, const NoiseConfig& noise, const Weather& weather) {
  check_fields(noise);
  check_fields(weather);
  constexpr double kMilli = 1e-3;
  const Shooter shooter{.world = world,
                        .model = model,
                        .T_world_sensor_at = T_world_sensor_at,
                        .noise = noise,
                        .weather = weather,
                        .index = index,
                        .section = cross_section(model.optics, noise.beam_rays),
                        .beside = around(kMilli * weather.bloom_mrad)};
  const ShotPlan plan = model.shots(index);
  Scan scan = to_scan(collect(shoot_all(shooter, plan), plan, model));
  scan.frame = fmt::format("{:06}", index);
  scan.sensor = model.name;
  scan.stamp_ns = plan.begin_ns;
  scan.motion =
      Motion{T_world_sensor_at(plan.begin_ns), T_world_sensor_at(plan.end_ns), plan.end_ns - plan.begin_ns};
  scan.T_world_sensor = scan.motion->T_world_sensor_begin;
  return scan;
}

}  // namespace verge::sim

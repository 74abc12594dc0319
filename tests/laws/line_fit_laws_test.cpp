// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Laws that detect/line_fit must keep on scans of a LUX between parked cars.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/laws/law_scans.hpp"
#include "verge/core/angle.hpp"
#include "verge/detect/line_fit/line_fit.hpp"
#include "verge/emit/scene_json.hpp"
#include "verge/scan/test_clouds.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"

namespace verge::laws {
namespace {

constexpr double kTolerance_m = 0.05;

/// Points of a street and how the sensor stands over it.
struct Street {
  Cloud cloud;
  Mount mount;
};

const std::vector<Street>& streets() {
  static const std::vector<Street> all = [] {
    std::vector<Street> streets;
    const sim::Drive drive({.scenario = sim::ready_scenario("paper2"),
                            .sensor = sim::sensor_named("lux", 12.5),
                            .noise = {.seed = 3, .range_sigma_m = 0.03}});
    for (const std::uint64_t index : {0U, 15U, 30U, 45U, 60U, 75U, 90U, 105U}) {
      sim::Simulated simulated = drive.scan(index);
      const Scan scan = deskew(std::move(simulated.scan));
      Street street{{}, simulated.mount};
      for (std::size_t ring = 0; ring < scan.ring_count(); ++ring) {
        for (auto [i, end] = scan.ring(ring); i < end; ++i) {
          street.cloud.x.push_back(scan.x[i]);
          street.cloud.y.push_back(scan.y[i]);
          street.cloud.z.push_back(scan.z[i]);
          street.cloud.ring.push_back(static_cast<std::int64_t>(ring));
        }
      }
      streets.push_back(std::move(street));
    }
    return streets;
  }();
  return all;
}

Scene detect(const Cloud& cloud, const Mount& mount) {
  Scan scan = organise(cloud).scan;
  scan.frame = "law";
  scan.mount = mount;
  return detect::LineFit{}.process(scan);
}

std::string text_of(const Cloud& cloud, const Mount& mount) {
  return emit::to_json_line(detect(cloud, mount));
}

/// Of the objects of one scene, how many have one of the other's class, place and sign in the place where
/// they should be.
std::size_t found_again(const std::vector<Object>& objects, const std::vector<Object>& others) {
  return static_cast<std::size_t>(std::ranges::count_if(objects, [&](const Object& object) {
    return std::ranges::any_of(others, [&](const Object& other) {
      return distance(object.center.xy(), other.center.xy()) < 2.0 * kTolerance_m &&
             object.type == other.type && object.shape == other.shape;
    });
  }));
}

/// y to -y, of objects too: what showed its right flank shows its left one.
std::vector<Object> mirrored(std::vector<Object> objects) {
  for (Object& object : objects) {
    object.center.y = -object.center.y;
    if (object.shape == ObjectShape::kJ) {
      object.shape = ObjectShape::kL;
    } else if (object.shape == ObjectShape::kL) {
      object.shape = ObjectShape::kJ;
    }
  }
  return objects;
}

}  // namespace

TEST(LineFitLaws, ShufflingThePointsChangesNothing) {
  for (const Street& street : streets())
    EXPECT_EQ(text_of(testing::shuffled(street.cloud, 5), street.mount), text_of(street.cloud, street.mount));
}

TEST(LineFitLaws, PointsBeyondTheGateChangeNothing) {
  for (const Street& street : streets()) {
    Cloud more = street.cloud;
    for (int i = 0; i < 100; ++i) {
      more.x.push_back(70.0F);
      more.y.push_back(static_cast<float>(i - 50));
      more.z.push_back(0.0F);
      more.ring.push_back(3);
    }
    EXPECT_EQ(text_of(more, street.mount), text_of(street.cloud, street.mount));
  }
}

TEST(LineFitLaws, MirroringLeftAndRightMirrorsTheResult) {
  Agreement edges;
  std::size_t objects = 0;
  std::size_t again = 0;
  for (const Street& street : streets()) {
    const Scene usual = detect(street.cloud, street.mount);
    const Scene changed = detect(mirrored_left_right(street.cloud), street.mount);
    edges += agreement(changed, mirrored_left_right(usual), kTolerance_m);
    objects += usual.objects.size();
    again += found_again(mirrored(usual.objects), changed.objects);
  }
  EXPECT_GT(edges.vertices, 100U);
  EXPECT_GE(edges.share(), 0.95);
  EXPECT_GT(objects, 30U);
  EXPECT_GE(static_cast<double>(again), 0.95 * static_cast<double>(objects));
}

TEST(LineFitLaws, TurningTheSensorOnItsMountTurnsTheResult) {
  for (const double angle_deg : {-7.0, 12.5}) {
    const double angle = deg_to_rad(angle_deg);
    Agreement edges;
    for (const Street& street : streets()) {
      // About the level frame's z: the cloud is levelled first, and the mount has nothing left to level.
      const LevelFrame frame(street.mount);
      Cloud level = street.cloud;
      for (std::size_t i = 0; i < level.x.size(); ++i) {
        const Vec3 p = frame.to_level({level.x[i], level.y[i], level.z[i]});
        level.x[i] = static_cast<float>(p.x);
        level.y[i] = static_cast<float>(p.y);
        level.z[i] = static_cast<float>(p.z - street.mount.height_m);
      }
      const Mount straight{.height_m = street.mount.height_m};
      Mount turned_mount = straight;
      turned_mount.forward_rad = angle;
      edges += agreement(detect(testing::turned(level, angle), turned_mount),
                         turned(detect(level, straight), angle), kTolerance_m);
    }
    EXPECT_GT(edges.vertices, 100U);
    EXPECT_EQ(edges.near, edges.vertices) << angle_deg;
  }
}

}  // namespace verge::laws

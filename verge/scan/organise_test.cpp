// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/organise.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/scan/test_clouds.hpp"

namespace verge {
namespace {

using testing::plan;
using testing::shuffled;
using testing::simulate;

// Coordinates that meet often, so that azimuths tie, and all the odd ones that a file may hold.
float odd_float() {
  constexpr std::array kOdd{0.0F,
                            -0.0F,
                            1.0F,
                            -1.0F,
                            1e-42F,
                            -1e-30F,
                            9e4F,
                            2e5F,
                            3e38F,
                            std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN()};
  const int pick = *rc::gen::inRange(0, 40);
  if (pick < static_cast<int>(kOdd.size())) return kOdd[static_cast<std::size_t>(pick)];
  return 0.25F * static_cast<float>(*rc::gen::inRange(-8, 9));
}

float even_float() { return 0.25F * static_cast<float>(*rc::gen::inRange(-8, 9)); }

template <class T, class Make>
std::vector<T> column(std::size_t n, Make make) {
  std::vector<T> values(n);
  std::generate(values.begin(), values.end(), make);
  return values;
}

// Every column may be there or not, but for x, y, z.
template <class Make>
Cloud random_cloud(Make coordinate, bool ring) {
  const auto n = *rc::gen::inRange<std::size_t>(0, 120);
  const auto there = [n] { return *rc::gen::inRange(0, 2) == 1 ? n : std::size_t{0}; };
  const auto few = [] { return static_cast<std::uint8_t>(*rc::gen::inRange(0, 3)); };
  Cloud cloud;
  cloud.x = column<float>(n, coordinate);
  cloud.y = column<float>(n, coordinate);
  cloud.z = column<float>(n, coordinate);
  cloud.intensity = column<float>(there(), coordinate);
  cloud.ring = column<std::int64_t>(ring ? n : 0, [] { return *rc::gen::inRange(-2, 4); });
  cloud.time_s = column<double>(there(), [&] { return 0.025 * few(); });
  cloud.echo = column<std::uint8_t>(there(), few);
  cloud.pulse_width = column<float>(there(), coordinate);
  cloud.flags = column<std::uint32_t>(there(), few);
  cloud.label = column<std::uint32_t>(there(), few);
  return cloud;
}

bool is_usable(const Cloud& cloud, std::size_t i) {
  const double x = cloud.x[i];
  const double y = cloud.y[i];
  const double z = cloud.z[i];
  return std::sqrt(x * x + y * y + z * z) <= 1e5;  // false for NaN
}

Cloud usable_part(const Cloud& cloud) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    if (is_usable(cloud, i)) kept.push_back(i);
  }
  return testing::reordered(cloud, kept);
}

std::vector<std::uint32_t> bits(const std::vector<float>& values) {
  std::vector<std::uint32_t> result;
  for (const float value : values) result.push_back(std::bit_cast<std::uint32_t>(value));
  return result;
}

// All columns but input_index, as bits.
auto contents(const Scan& s) {
  return std::make_tuple(s.ring_begin, bits(s.azimuth), bits(s.range), bits(s.x), bits(s.y), bits(s.z),
                         bits(s.intensity), s.time_offset_ns, s.echo, bits(s.pulse_width), s.flags, s.label);
}

std::vector<std::int64_t> ring_of_input(const Scan& scan) { return flatten(scan).ring; }

// Whether two numberings part the points in the same way, in the same or any order of the numbers.
bool same_parting(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b) {
  if (a.size() != b.size()) return false;
  std::map<std::int64_t, std::int64_t> there;
  std::map<std::int64_t, std::int64_t> back;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (there.try_emplace(a[i], b[i]).first->second != b[i]) return false;
    if (back.try_emplace(b[i], a[i]).first->second != a[i]) return false;
  }
  return true;
}

// The same cloud without its ring field.
Cloud ringless(Cloud cloud) {
  cloud.ring.clear();
  return cloud;
}

// Elevations that wander by more than the rings are apart, as those of a sensor with offsets do.
Cloud blurred(Cloud cloud) {
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const float range = std::hypot(cloud.x[i], cloud.y[i]);
    cloud.z[i] += 0.012F * range * std::sin(3.0F * std::atan2(cloud.y[i], cloud.x[i]));
  }
  return cloud;
}

}  // namespace

TEST(Organise, EmptyCloudGivesEmptyScan) {
  const Organised organised = organise({});
  EXPECT_EQ(organised.scan.size(), 0U);
  EXPECT_EQ(organised.scan.ring_count(), 0U);
  EXPECT_EQ(organised.note, "0 rings from the elevation");
}

TEST(Organise, OnePointIsOneRing) {
  const Organised organised = organise({.x = {1.0F}, .y = {-1.0F}, .z = {0.5F}});
  ASSERT_EQ(organised.scan.ring_begin, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_NEAR(organised.scan.azimuth[0], -std::numbers::pi / 4, 1e-6);
  EXPECT_FLOAT_EQ(organised.scan.range[0], 1.5F);
  EXPECT_EQ(organised.scan.input_index[0], 0U);
}

TEST(Organise, PointsOfRangeZeroStay) {
  const Cloud zeros{.x = {0, 0, 0}, .y = {0, 0, 0}, .z = {0, 0, 0}};
  EXPECT_EQ(organise(zeros).scan.ring_begin, (std::vector<std::uint32_t>{0, 3}));
  Cloud with_field = zeros;
  with_field.ring = {7, 5, 7};
  EXPECT_EQ(organise(with_field).scan.ring_begin, (std::vector<std::uint32_t>{0, 1, 3}));
}

TEST(Organise, PointsThatAreNotFiniteAreDroppedAndCounted) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Organised organised = organise({.x = {1, kNan, 3, 1}, .y = {0, 0, 2e5F, 1}, .z = {0, 0, 0, 0}});
  EXPECT_EQ(organised.scan.dropped, 2U);
  EXPECT_EQ(organised.scan.input_index, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(organised.note, "1 ring from the elevation, 2 of 4 points dropped (not finite or beyond 100 km)");
  EXPECT_EQ(organise({.x = {kNan}, .y = {0}, .z = {0}}).scan.ring_count(), 0U);
}

TEST(Organise, RingsRunFromLowestToHighestWhateverTheFieldSays) {
  // Lasers numbered in firing order, as a field of an HDL-32E driver: two interleaved banks.
  const Organised organised = organise({.x = {10, 10, 10, 10},
                                        .y = {0, 0, 0, 0},
                                        .z = {-5.0F, -1.0F, -4.0F, 0.0F},
                                        .intensity = {0, 1, 2, 3},
                                        .ring = {0, 1, 2, 3}});
  EXPECT_EQ(organised.scan.intensity, (std::vector<float>{0, 2, 1, 3}));
  EXPECT_EQ(organised.source, RingSource::kField);
  EXPECT_EQ(organised.note, "4 rings from the ring field");
}

TEST(Organise, RingWithoutReturnsStaysBesideItsNeighbour) {
  // Numbered downward, as Ouster does; ring 0 looks into the sky, ring 2 is dead.
  const Cloud downward{.x = {0, 10, 0, 10, 10},
                       .y = {0, 0, 0, 0, 0},
                       .z = {0, 3, 0, 1, -2},
                       .intensity = {0, 1, 2, 3, 4},
                       .ring = {0, 1, 2, 3, 4}};
  EXPECT_EQ(organise(downward).scan.intensity, (std::vector<float>{4, 3, 2, 1, 0}));
}

TEST(Organise, AbsoluteTimesGiveStampAndOffsets) {
  const Cloud cloud{
      .x = {1, 1}, .y = {1, 0}, .z = {0, 0}, .ring = {0, 0}, .time_s = {1.7e9 + 0.05, 1.7e9 - 0.025}};
  const Scan scan = organise(cloud).scan;
  ASSERT_TRUE(scan.stamp_ns.has_value());
  EXPECT_NEAR(static_cast<double>(*scan.stamp_ns - 1'700'000'000'000'000'000), -0.025e9, 1e3);
  EXPECT_EQ(scan.time_offset_ns[0], 0U);
  EXPECT_NEAR(scan.time_offset_ns[1], 0.075e9, 1e3);
}

TEST(Organise, RelativeTimesCountFromTheFirst) {
  // Velodyne's driver counts back from the end of the scan.
  const Cloud cloud{
      .x = {1, 1}, .y = {1, 0}, .z = {0, 0}, .intensity = {}, .ring = {0, 0}, .time_s = {0.0, -0.1}};
  const Scan scan = organise(cloud).scan;
  EXPECT_FALSE(scan.stamp_ns.has_value());
  EXPECT_EQ(scan.time_offset_ns, (std::vector<std::uint32_t>{0, 100'000'000}));
}

TEST(Organise, TimesThatFitNoScanAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& times : {std::vector<double>{0.0, 5.0}, {0.0, kNan}, {1.7e18, 1.7e18}}) {
    const Organised organised = organise({.x = {1, 1}, .y = {1, 0}, .z = {0, 0}, .time_s = times});
    EXPECT_TRUE(organised.scan.time_offset_ns.empty());
    EXPECT_FALSE(organised.scan.stamp_ns.has_value());
    EXPECT_EQ(organised.note,
              "1 ring from the elevation, times left out (not finite or more than 4 s apart)");
  }
}

RC_GTEST_PROP(Organise, FlatteningGivesEveryPointBackBitForBitOnce, (bool ring)) {
  const Cloud cloud = random_cloud(odd_float, ring);
  const Cloud kept = usable_part(cloud);
  const Scan scan = organise(cloud).scan;
  const Cloud back = flatten(scan);
  RC_ASSERT(bits(back.x) == bits(kept.x));
  RC_ASSERT(bits(back.y) == bits(kept.y));
  RC_ASSERT(bits(back.z) == bits(kept.z));
  RC_ASSERT(bits(back.intensity) == bits(kept.intensity));
  RC_ASSERT(back.echo == kept.echo);
  RC_ASSERT(bits(back.pulse_width) == bits(kept.pulse_width));
  RC_ASSERT(back.flags == kept.flags);
  RC_ASSERT(back.label == kept.label);
  RC_ASSERT(back.time_s.size() == kept.time_s.size());
  if (ring) RC_ASSERT(same_parting(back.ring, kept.ring));
  RC_ASSERT(scan.dropped + scan.size() == cloud.x.size());
}

RC_GTEST_PROP(Organise, RingsAreInOrderOfAzimuthAndColumnsInStep, (bool ring)) {
  const Scan scan = organise(random_cloud(odd_float, ring)).scan;
  RC_ASSERT(scan.ring_begin.front() == 0U);
  RC_ASSERT(scan.ring_begin.back() == scan.size());
  for (std::size_t r = 0; r < scan.ring_count(); ++r) {
    const auto [begin, end] = scan.ring(r);
    RC_ASSERT(begin < end);
    for (std::size_t i = begin + 1; i < end; ++i) RC_ASSERT(scan.azimuth[i - 1] <= scan.azimuth[i]);
  }
  for (std::size_t i = 0; i < scan.size(); ++i) {
    RC_ASSERT(scan.azimuth[i] == fast_atan2(scan.y[i], scan.x[i]));
    const float exact = static_cast<float>(norm(scan.point(i)));
    RC_ASSERT(std::fabs(scan.range[i] - exact) <= 1e-6F * exact + 1e-18F);
    RC_ASSERT((scan.range[i] == 0.0F) == (scan.point(i) == Vec3{}));
  }
}

RC_GTEST_PROP(Organise, ShufflingChangesNothingWhereRingsAreKnown, (unsigned seed)) {
  const Cloud cloud = random_cloud(even_float, true);
  RC_ASSERT(contents(organise(cloud).scan) == contents(organise(shuffled(cloud, seed)).scan));
}

RC_GTEST_PROP(Organise, NumbersOfTheFieldDoNotMatter, ()) {
  const Cloud cloud = simulate(plan(8, -15.0, 10.0, 24));
  const auto numbers = *rc::gen::unique<std::vector<std::int64_t>>(8, rc::gen::arbitrary<std::int64_t>());
  Cloud renumbered = cloud;
  for (std::int64_t& ring : renumbered.ring) ring = numbers[static_cast<std::size_t>(ring)];
  RC_ASSERT(contents(organise(cloud).scan) == contents(organise(renumbered).scan));
}

TEST(Organise, ExtremeNumbersOfTheFieldAreJustNumbers) {
  Cloud cloud = simulate(plan(2, -15.0, 10.0, 24));
  const auto expected = contents(organise(cloud).scan);
  for (std::int64_t& ring : cloud.ring) {
    ring = ring == 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
  }
  EXPECT_EQ(contents(organise(cloud).scan), expected);
}

RC_GTEST_PROP(Organise, TurningTheCloudTurnsTheAzimuthsRingByRing, ()) {
  const double angle = 1e-3 * *rc::gen::inRange(-3141, 3142);
  const Cloud cloud = simulate(plan(4, -12.0, 3.0, 40));
  const Scan scan = organise(cloud).scan;
  const Scan turned = organise(testing::turned(cloud, angle)).scan;
  RC_ASSERT(turned.ring_begin == scan.ring_begin);
  std::vector<double> azimuth(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) azimuth[scan.input_index[i]] = scan.azimuth[i];
  for (std::size_t i = 0; i < turned.size(); ++i) {
    RC_ASSERT(std::fabs(wrap_pi(static_cast<double>(turned.azimuth[i]) - azimuth[turned.input_index[i]] -
                                angle)) < 2e-6);
  }
  RC_ASSERT(ring_of_input(turned) == ring_of_input(scan));
}

// Oracle: one sort of everything by everything.
TEST(Organise, LongShuffledRingIsSortedAsByPlainComparison) {
  const Cloud cloud = shuffled(simulate(plan(1, -10.0, -10.0, 5000)), 3);
  const Scan scan = organise(cloud).scan;
  std::vector<std::uint32_t> order(cloud.x.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&cloud](std::uint32_t a, std::uint32_t b) {
    return std::make_tuple(fast_atan2(cloud.y[a], cloud.x[a]), cloud.z[a], cloud.x[a]) <
           std::make_tuple(fast_atan2(cloud.y[b], cloud.x[b]), cloud.z[b], cloud.x[b]);
  });
  EXPECT_EQ(scan.input_index, order);
}

TEST(Organise, PointsStandingRingByRingKeepTheirRings) {
  for (const bool clockwise : {false, true}) {
    for (const double angle : {0.0, std::numbers::pi}) {
      auto sensor = plan(64, -24.8, 2.0, 900);
      sensor.clockwise = clockwise;
      const Cloud cloud = blurred(testing::turned(simulate(sensor), angle));
      const Organised organised = organise(ringless(cloud));
      EXPECT_EQ(organised.source, RingSource::kKittiOrder);
      EXPECT_EQ(organised.note, "64 rings from the order of the points");
      EXPECT_TRUE(same_parting(ring_of_input(organised.scan), cloud.ring));
    }
  }
}

TEST(Organise, RingsThatStartAtAnUnusualAzimuthAreFoundToAPoint) {
  const Cloud cloud = blurred(testing::turned(simulate(plan(64, -24.8, 2.0, 900)), 1.0));
  const Organised organised = organise(ringless(cloud));
  EXPECT_EQ(organised.source, RingSource::kKittiOrder);
  ASSERT_EQ(organised.scan.ring_count(), 64U);
  const std::vector<std::int64_t> ring = ring_of_input(organised.scan);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) differ += ring[i] != cloud.ring[i] ? 1U : 0U;
  EXPECT_LT(differ, 2U * 64U);
}

TEST(Organise, GapsOfRingsThatStandOneByOneDoNotMoveTheirEnds) {
  const Cloud whole = blurred(simulate(plan(64, -24.8, 2.0, 900)));
  std::vector<std::size_t> kept;  // what a car's own roof hides ahead, and a sky without returns
  for (std::size_t i = 0; i < whole.x.size(); ++i) {
    const double azimuth = std::atan2(whole.y[i], whole.x[i]);
    const bool roof = whole.ring[i] < 8 && std::fabs(azimuth) < 0.3;
    const bool sky = whole.ring[i] > 60 && azimuth > -2.0 && azimuth < 1.5;
    if (!roof && !sky) kept.push_back(i);
  }
  const Cloud cloud = testing::reordered(whole, kept);
  const Organised organised = organise(ringless(cloud));
  EXPECT_EQ(organised.source, RingSource::kKittiOrder);
  EXPECT_TRUE(same_parting(ring_of_input(organised.scan), cloud.ring)) << organised.note;
}

TEST(Organise, OtherOrdersAreNotMistakenForRingByRing) {
  const Cloud cloud = simulate(plan(32, -30.67, 10.67, 1085));
  std::vector<std::size_t> by_x(cloud.x.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::sort(by_x.begin(), by_x.end(),
            [&cloud](std::size_t a, std::size_t b) { return cloud.x[a] < cloud.x[b]; });
  for (const Cloud& other :
       {shuffled(cloud, 7), testing::column_major(cloud), testing::reordered(cloud, by_x)}) {
    EXPECT_EQ(organise(ringless(other)).source, RingSource::kElevation);
    EXPECT_EQ(organise(ringless(blurred(other))).source, RingSource::kElevation);
  }
}

TEST(Organise, ElevationsThatStandApartGiveTheRingsBack) {
  for (const auto& sensor :
       {plan(4, -1.2, 1.2, 500), plan(16, -15.0, 15.0, 1800), plan(32, -30.67, 10.67, 1085),
        plan(64, -24.8, 2.0, 1000), plan(128, -22.5, 22.5, 512)}) {
    const Cloud cloud = shuffled(simulate(sensor), 5);
    const Organised organised = organise(ringless(cloud));
    EXPECT_EQ(organised.source, RingSource::kElevation);
    EXPECT_EQ(ring_of_input(organised.scan), cloud.ring) << organised.note;
  }
}

TEST(Organise, ShufflingChangesNothingWhereRingsComeFromElevation) {
  const Cloud cloud = ringless(simulate(plan(16, -15.0, 15.0, 300)));
  EXPECT_EQ(contents(organise(shuffled(cloud, 1)).scan), contents(organise(shuffled(cloud, 2)).scan));
}

TEST(Organise, CloudThatIsNoScanIsCutInBands) {
  Cloud map;  // a floor of points around the origin: every elevation from steep to flat
  for (int i = -150; i < 150; ++i) {
    for (int j = -150; j < 150; ++j) {
      map.x.push_back(0.1F * static_cast<float>(i) + 0.013F);
      map.y.push_back(0.1F * static_cast<float>(j) + 0.037F);
      map.z.push_back(-3.0F);
    }
  }
  const Organised organised = organise(map);
  EXPECT_EQ(organised.source, RingSource::kElevation);
  EXPECT_GT(organised.scan.ring_count(), 100U);
  EXPECT_THAT(organised.note, ::testing::HasSubstr("no rings can be told apart: bands of 0.4 degrees"));
}

TEST(Organise, OneRingFieldForAllIsOneRing) {
  Cloud cloud = simulate(plan(16, -15.0, 15.0, 50));
  std::fill(cloud.ring.begin(), cloud.ring.end(), 9);
  EXPECT_EQ(organise(cloud).note, "1 ring from the ring field");
}

}  // namespace verge

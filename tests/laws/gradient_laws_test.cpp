// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Laws that detect/gradient must keep on every scan. No truth is needed: each scan is held against itself.
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/laws/law_scans.hpp"
#include "verge/core/angle.hpp"
#include "verge/detect/gradient/gradient.hpp"
#include "verge/emit/scene_json.hpp"
#include "verge/pipeline/run.hpp"
#include "verge/scan/test_clouds.hpp"

namespace verge::laws {
namespace {

constexpr double kTolerance_m = 0.05;
constexpr std::size_t kRealScans = 3;  // of each set

Scan scan_of(const Cloud& cloud) {
  Scan scan = organise(cloud).scan;
  scan.frame = "law";
  return scan;
}

Scene detect(const Cloud& cloud) { return detect::Gradient{}.process(scan_of(cloud)); }

// All that is said, to the last digit that is written.
std::string text_of(const Scene& scene) { return emit::to_json_line(scene); }

// What one law says of one scan: how well the result of the changed scan agrees with the changed result.
using Law = std::function<Agreement(const Cloud&)>;

// Every vertex must agree.
void check(const Law& law, const std::vector<Subject>& subjects) {
  for (const Subject& subject : subjects) {
    const Agreement found = law(subject.cloud);
    EXPECT_GT(found.vertices, 30U) << subject.name << ": the law would hold of nothing";
    EXPECT_EQ(found.near, found.vertices) << subject.name;
  }
}

void check_on_simulated(const Law& law) { check(law, simulated_subjects()); }

void check_on_real(const Law& law) {
  const auto data = testing::data_folder();
  if (!data) GTEST_SKIP() << "VERGE_DATA is not set: no real scans";
  check(law, real_subjects(*data, kRealScans));
}

// All or nothing: the same text, to the last digit.
Agreement exact_agreement(const Scene& a, const Scene& b) {
  Agreement result = agreement(a, b, kTolerance_m);
  result.near = text_of(a) == text_of(b) ? result.vertices : 0;
  return result;
}

Agreement shuffled_is_same(const Cloud& cloud) {
  return exact_agreement(detect(testing::shuffled(cloud, 5)), detect(cloud));
}

Agreement left_right_is_mirrored(const Cloud& cloud) {
  return agreement(detect(mirrored_left_right(cloud)), mirrored_left_right(detect(cloud)), kTolerance_m);
}

Agreement front_back_is_mirrored(const Cloud& cloud) {
  return agreement(detect(mirrored_front_back(cloud)), mirrored_front_back(detect(cloud)), kTolerance_m);
}

Agreement turned_is_turned(const Cloud& cloud) {
  const Scene straight = detect(cloud);
  Agreement all;
  for (const double angle_deg : {-10.0, -3.7, 4.45, 9.3}) {
    const double angle = deg_to_rad(angle_deg);
    all += agreement(detect(testing::turned(cloud, angle)), turned(straight, angle), kTolerance_m);
  }
  return all;
}

Agreement ceiling_is_not_seen(const Cloud& cloud) {
  const Mount mount = estimate_mount(scan_of(cloud)).mount;
  const double height = detect::Gradient::Config{}.height_max_m + 2.0;
  return exact_agreement(detect(with_ceiling(cloud, mount, height)), detect(cloud));
}

// The records of all scans, one after the other, as a run with so many threads writes them.
std::string records_of(const std::vector<Scan>& scans, std::size_t threads) {
  std::string records;
  std::size_t next = 0;
  const pipeline::Ends ends{
      .read = [&]() -> Expected<std::optional<Scan>> {
        if (next == scans.size()) return std::optional<Scan>{};
        return std::optional<Scan>{scans[next++]};
      },
      .render = [](const pipeline::Frame& frame) -> Expected<std::string> { return text_of(frame.scene); },
      .write = [&](const pipeline::Frame&, std::string&& record) -> Expected<void> {
        records += record + "\n";
        return {};
      },
      .skip = [](std::size_t, const Error& error) { ADD_FAILURE() << to_string(error); }};
  detect::Gradient detector;
  pipeline::Options options;
  options.threads = threads;
  const std::atomic<bool> stop{false};
  EXPECT_TRUE(pipeline::run(ends, detector, options, stop).has_value());
  return records;
}

void expect_same_bytes(const std::vector<Subject>& subjects) {
  std::vector<Scan> scans;
  for (const Subject& subject : subjects) {
    for (int copy = 0; copy < 3; ++copy) scans.push_back(scan_of(subject.cloud));
  }
  const std::string once = records_of(scans, 1);
  EXPECT_GT(once.size(), 100U * scans.size());
  EXPECT_EQ(records_of(scans, 1), once);
  EXPECT_EQ(records_of(scans, 2), once);
  EXPECT_EQ(records_of(scans, 7), once);
}

}  // namespace

TEST(GradientLawsSimulated, ShufflingThePointsChangesNothing) { check_on_simulated(shuffled_is_same); }
TEST(GradientLawsReal, ShufflingThePointsChangesNothing) { check_on_real(shuffled_is_same); }

TEST(GradientLawsSimulated, MirroringLeftAndRightMirrorsTheResult) {
  check_on_simulated(left_right_is_mirrored);
}
TEST(GradientLawsReal, MirroringLeftAndRightMirrorsTheResult) { check_on_real(left_right_is_mirrored); }

TEST(GradientLawsSimulated, MirroringFrontAndBackMirrorsTheResult) {
  check_on_simulated(front_back_is_mirrored);
}
TEST(GradientLawsReal, MirroringFrontAndBackMirrorsTheResult) { check_on_real(front_back_is_mirrored); }

TEST(GradientLawsSimulated, TurningTheVehicleTurnsTheResultAlong) { check_on_simulated(turned_is_turned); }
TEST(GradientLawsReal, TurningTheVehicleTurnsTheResultAlong) { check_on_real(turned_is_turned); }

TEST(GradientLawsSimulated, PointsAboveTheGateChangeNothing) { check_on_simulated(ceiling_is_not_seen); }
TEST(GradientLawsReal, PointsAboveTheGateChangeNothing) { check_on_real(ceiling_is_not_seen); }

TEST(GradientLawsSimulated, SameBytesTwiceAndWithAnyNumberOfThreads) {
  expect_same_bytes(simulated_subjects());
}
TEST(GradientLawsReal, SameBytesTwiceAndWithAnyNumberOfThreads) {
  const auto data = testing::data_folder();
  if (!data) GTEST_SKIP() << "VERGE_DATA is not set: no real scans";
  expect_same_bytes(real_subjects(*data, 1));
}

}  // namespace verge::laws

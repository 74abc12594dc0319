// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
//
// From every format that is written to every other and back: what both hold is the same to the last bit, or
// within the step of a format that rounds.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/io/formats.hpp"
#include "verge/io/sink.hpp"
#include "verge/io/test_files.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

namespace fs = std::filesystem;

/// What a format holds of a scan, by the names of the columns.
struct Holds {
  std::string_view
      columns;              ///< i intensity, r ring, t time, s stamp, e echo, w pulse width, f flags, l label
  double step_m = 0.0;      ///< Of coordinates; 0: every bit.
  bool keeps_order = true;  ///< Of the points.
};

const std::map<Format, Holds>& table() {
  static const std::map<Format, Holds> all{{Format::kKitti, {"is", 0.0, false}},
                                           {Format::kNuscenes, {"ir", 0.0, true}},
                                           {Format::kPcd, {"irtSewfl", 0.0, true}},
                                           {Format::kPly, {"irtsewfl", 0.0, true}},
                                           {Format::kCsv, {"irtSewfl", 0.0, true}},
                                           {Format::kMcap, {"irtsewfl", 0.0, true}},
                                           {Format::kLas, {"rtsel", 1e-4, false}},
                                           {Format::kIbeo, {"rtsewf", 0.0, true}},
                                           // Its pulse widths are whole numbers in a unit of its own.
                                           {Format::kAlasca, {"ref", 0.01, true}},
                                           {Format::kPcap, {"irts", 0.0, true}}};
  return all;
}

bool holds(Format format, char column) {
  return table().at(format).columns.find(column) != std::string_view::npos;
}

/// A scan that all formats can say: four rings that are a LUX's layers, from the left to the right, at whole
/// ticks and centimetres.
Scan scan_of_everything() {
  constexpr std::int64_t kStamp = 1'700'000'000'123'456'000;
  constexpr double kTick = 2.0 * 3.14159265358979323846 / 11'520.0;
  Cloud cloud;
  for (int i = 0; i < 160; ++i) {
    const int layer = i % 4;
    const int ticks = 1600 - 8 * (i / 4);
    const double range = 5.0 + 0.01 * (i * 37 % 900);
    const double up = deg_to_rad(-1.2 + 0.8 * layer);
    cloud.x.push_back(static_cast<float>(range * std::cos(up) * std::cos(ticks * kTick)));
    cloud.y.push_back(static_cast<float>(range * std::cos(up) * std::sin(ticks * kTick)));
    cloud.z.push_back(static_cast<float>(range * std::sin(up)));
    cloud.intensity.push_back(static_cast<float>(i * 7 % 256));
    cloud.ring.push_back(layer);
    cloud.time_s.push_back(1e-9 * 50'000.0 * (i / 4));
    cloud.echo.push_back(static_cast<std::uint8_t>(i % 3));
    cloud.pulse_width.push_back(static_cast<float>(0.01 * (i + 1)));
    cloud.flags.push_back(static_cast<std::uint32_t>(i % 5 == 1 ? 0 : i % 5));
    cloud.label.push_back(static_cast<std::uint32_t>(40 + layer));
  }
  Scan scan = organise(cloud).scan;
  scan.frame = "000000";
  scan.stamp_ns = kStamp;
  return scan;
}

fs::path path_in(const fs::path& folder, const std::string& name, Format format) {
  // KITTI's times stand beside the scans of a folder.
  return folder / (name + (format == Format::kKitti ? "" : std::string(facts_of(format).suffix)));
}

Scan through(Format format, const fs::path& folder, const std::string& name, const Scan& scan) {
  const fs::path path = path_in(folder, name, format);
  SinkOptions options{.format = format, .model = {}, .calibration = {}, .log = {}};
  if (format == Format::kPcap) options.model = "vlp32c";
  auto sink = create(path, options);
  EXPECT_TRUE(sink) << to_string(sink.error());
  EXPECT_TRUE((*sink)->write(scan));
  EXPECT_TRUE((*sink)->finish());
  OpenOptions reading;
  reading.format = format;
  auto source = open(path, reading);
  EXPECT_TRUE(source) << to_string(source.error());
  auto back = (*source)->next();
  EXPECT_TRUE(back && *back);
  return **back;
}

/// The points in the input's order, or in one of their own where a format keeps none.
std::vector<std::size_t> order_of(const Cloud& cloud, bool keeps_order) {
  std::vector<std::size_t> order(cloud.x.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  if (keeps_order) return order;
  const auto key = [&](std::size_t i) {
    return std::tuple(cloud.ring[i], std::lround(1e3F * std::atan2(cloud.y[i], cloud.x[i])));
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

template <class T>
void expect_column(const std::vector<T>& a, const std::vector<T>& b, const std::vector<std::size_t>& order_a,
                   const std::vector<std::size_t>& order_b, double step) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (step == 0.0) {
      ASSERT_EQ(a[order_a[i]], b[order_b[i]]) << i;
    } else {
      ASSERT_NEAR(static_cast<double>(a[order_a[i]]), static_cast<double>(b[order_b[i]]), step) << i;
    }
  }
}

class EveryPair : public ::testing::TestWithParam<std::tuple<Format, Format>> {};

TEST_P(EveryPair, KeepsWhatBothHold) {
  const auto [first, second] = GetParam();
  const testing::TemporaryFolder folder;
  const Scan a = through(first, folder.path(), "a", scan_of_everything());
  const Scan b = through(second, folder.path(), "b", a);
  const Scan back = through(first, folder.path(), "c", b);
  const double step = std::max(table().at(first).step_m, table().at(second).step_m);
  const bool ordered = table().at(first).keeps_order && table().at(second).keeps_order;
  const Cloud p = flatten(a);
  const Cloud q = flatten(back);
  ASSERT_EQ(p.x.size(), q.x.size());
  const auto order_p = order_of(p, ordered);
  const auto order_q = order_of(q, ordered);
  const auto both = [&](char column) { return holds(first, column) && holds(second, column); };
  expect_column(p.x, q.x, order_p, order_q, step);
  expect_column(p.y, q.y, order_p, order_q, step);
  expect_column(p.z, q.z, order_p, order_q, step);
  if (both('i')) expect_column(p.intensity, q.intensity, order_p, order_q, 0.0);
  if (both('r')) expect_column(p.ring, q.ring, order_p, order_q, 0.0);
  if (both('e')) expect_column(p.echo, q.echo, order_p, order_q, 0.0);
  if (both('w')) expect_column(p.pulse_width, q.pulse_width, order_p, order_q, 0.0);
  if (both('f')) expect_column(p.flags, q.flags, order_p, order_q, 0.0);
  if (both('l')) expect_column(p.label, q.label, order_p, order_q, 0.0);
  const auto has_stamp = [&](Format format) {
    return holds(format, 's') || (holds(format, 'S') && both('t'));
  };
  if (has_stamp(first) && has_stamp(second)) {
    ASSERT_TRUE(a.stamp_ns && back.stamp_ns);
    const bool rounds = first == Format::kLas || second == Format::kLas;  // to 60 ns
    EXPECT_LE(std::abs(*a.stamp_ns - *back.stamp_ns), rounds ? 300 : 0);
  }
  if (both('t') && ordered) {
    EXPECT_EQ(a.time_offset_ns, back.time_offset_ns);
  }
}

std::vector<Format> written_formats() {
  std::vector<Format> formats;
  for (const Format format : all_formats()) {
    // A capture holds what a Velodyne can have seen: sink_recordings_test.cpp.
    if (facts_of(format).written && format != Format::kPcap) formats.push_back(format);
  }
  return formats;
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryPair,
                         ::testing::Combine(::testing::ValuesIn(written_formats()),
                                            ::testing::ValuesIn(written_formats())),
                         [](const auto& pair) {
                           return std::string(name_of(std::get<0>(pair.param))) + "_" +
                                  std::string(name_of(std::get<1>(pair.param)));
                         });

TEST(EveryPair, TheTableNamesAllFormatsThatAreWritten) {
  for (const Format format : all_formats()) EXPECT_EQ(table().contains(format), facts_of(format).written);
}

}  // namespace
}  // namespace verge::io

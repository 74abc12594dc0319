// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
// The public data set's recordings of a SICK LD-MRS: all points against the table that goes with one of them,
// and what is left of them when they are cut.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/io/test_files.hpp"
#include "verge/sensor/ibeo/message.hpp"
#include "verge/sensor/ibeo/scan2202.hpp"

namespace verge::io {
namespace {

namespace fs = std::filesystem;
namespace ibeo = sensor::ibeo;

std::optional<fs::path> file_of(const std::string& name) {
  const auto folder = testing::data_folder();
  if (!folder || !fs::exists(*folder / "ldmrs-stream" / name)) return std::nullopt;
  return *folder / "ldmrs-stream" / name;
}

std::vector<std::byte> bytes_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const Bytes bytes = std::as_bytes(std::span(text.data(), text.size()));
  return {bytes.begin(), bytes.end()};
}

/// The scans in the file, number by number.
std::vector<ibeo::LuxScan> scans_in(Bytes bytes) {
  ibeo::Framer framer(ibeo::kLuxFrames);
  framer.feed(bytes);
  framer.finish();
  std::vector<ibeo::LuxScan> scans;
  while (const auto event = framer.next()) {
    const auto* frame = std::get_if<ibeo::Frame>(&*event);
    if (frame == nullptr || ibeo::decode_header(frame->header).type != ibeo::kScanType) continue;
    auto scan = ibeo::decode_scan(frame->body);
    if (scan) scans.push_back(*std::move(scan));
  }
  return scans;
}

/// Whole numbers of the lines of a table behind its first line.
std::vector<std::vector<int>> rows_of(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<std::vector<int>> rows;
  while (std::getline(file, line)) {
    std::vector<int>& row = rows.emplace_back();
    for (const char* at = line.data(); at < line.data() + line.size(); ++at) {
      int value = 0;
      at = std::from_chars(at, line.data() + line.size(), value).ptr;
      row.push_back(value);
    }
  }
  return rows;
}

std::vector<std::size_t> sizes_of(Input input) {
  auto recording = open_ibeo(std::move(input));
  std::vector<std::size_t> sizes;
  while (recording) {
    const auto scan = (*recording)->next();
    if (!scan) continue;
    if (!*scan) break;
    sizes.push_back((*scan)->cloud.x.size());
  }
  return sizes;
}

constexpr const char* kWithTable = "20120921-200644_record.log.bin";
constexpr const char* kOther = "20120921-200352_record.log.bin";

}  // namespace

TEST(IbeoReal, EveryPointIsThatOfTheTable) {
  const auto path = file_of(kWithTable);
  const auto table = file_of("20120921-200644_points.csv");
  if (!path || !table) GTEST_SKIP() << "no recordings under VERGE_DATA";
  const auto rows = rows_of(*table);
  std::size_t row = 0;
  for (const ibeo::LuxScan& scan : scans_in(bytes_of_file(*path))) {
    ASSERT_EQ(scan.points.size(), 740U);
    for (const ibeo::LuxPoint& p : scan.points) {
      ASSERT_LT(row, rows.size());
      const std::vector<int> ours{scan.number,   p.layer,    p.echo,          p.flags,
                                  p.angle_ticks, p.range_cm, p.pulse_width_cm};
      ASSERT_EQ(ours, rows[row]) << "row " << row;
      ++row;
    }
  }
  EXPECT_EQ(row, rows.size());
  EXPECT_EQ(row, 20U * 740U);
}

// From the table's own numbers, through the whole reader.
TEST(IbeoReal, EveryPointStandsWhereTheTablesNumbersPutIt) {
  const auto path = file_of(kWithTable);
  const auto table = file_of("20120921-200644_points.csv");
  if (!path || !table) GTEST_SKIP() << "no recordings under VERGE_DATA";
  auto input = Input::open(*path, {});
  ASSERT_TRUE(input);
  auto recording = open_ibeo(std::move(*input));
  ASSERT_TRUE(recording);
  const auto rows = rows_of(*table);
  std::size_t row = 0;
  for (auto scan = (*recording)->next(); scan && *scan; scan = (*recording)->next()) {
    const Cloud& cloud = (*scan)->cloud;
    std::size_t used = 0;
    for (const std::size_t end = row + 740; row < end; ++row) {
      if (rows[row][5] == 0) continue;
      const double h = deg_to_rad(rows[row][4] / 32.0);
      const double v = deg_to_rad(-1.2 + 0.8 * rows[row][1]);
      const double r = rows[row][5] / 100.0;
      ASSERT_NEAR(cloud.x[used], r * std::cos(v) * std::cos(h), 1e-6);
      ASSERT_NEAR(cloud.y[used], r * std::cos(v) * std::sin(h), 1e-6);
      ASSERT_NEAR(cloud.z[used], r * std::sin(v), 1e-6);
      ++used;
    }
    ASSERT_EQ(used, cloud.x.size());
  }
  EXPECT_EQ(row, rows.size());
}

TEST(IbeoReal, BothRecordingsAreWhole) {
  if (!file_of(kWithTable) || !file_of(kOther)) GTEST_SKIP() << "no recordings under VERGE_DATA";
  std::size_t scans = 0;
  for (const char* name : {kWithTable, kOther}) {
    auto input = Input::open(*file_of(name), {});
    ASSERT_TRUE(input);
    auto recording = open_ibeo(std::move(*input));
    ASSERT_TRUE(recording);
    auto scan = (*recording)->next();
    for (; scan && *scan; scan = (*recording)->next()) {
      EXPECT_FALSE((*scan)->stamp_ns);  // the sensor was never told the time
      ++scans;
    }
    EXPECT_TRUE(scan) << to_string(scan.error());
    for (const Counter& counter : (*recording)->counters()) {
      if (counter.name == "points received") {
        EXPECT_EQ(counter.count % 740, 0U);
      }
    }
  }
  EXPECT_EQ(scans, 71U);
}

TEST(IbeoReal, EveryMessageEncodesToItsOwnBytes) {
  if (!file_of(kWithTable) || !file_of(kOther)) GTEST_SKIP() << "no recordings under VERGE_DATA";
  for (const char* name : {kWithTable, kOther}) {
    const auto bytes = bytes_of_file(*file_of(name));
    std::vector<std::byte> again;
    ibeo::Framer framer(ibeo::kLuxFrames);
    framer.feed(bytes);
    framer.finish();
    while (const auto event = framer.next()) {
      const auto& frame = std::get<ibeo::Frame>(*event);
      const ibeo::MessageHeader header = ibeo::decode_header(frame.header);
      std::vector<std::byte> body(frame.body.begin(), frame.body.end());
      if (header.type == ibeo::kScanType) body = ibeo::encode_scan(*ibeo::decode_scan(frame.body));
      const auto message = ibeo::encode_message(header, body);
      again.insert(again.end(), message.begin(), message.end());
    }
    EXPECT_EQ(again, bytes);
  }
}

// Cut off at 400 places spread over it, and begun at as many.
TEST(IbeoReal, ACutLosesTheCutMessageAlone) {
  const auto path = file_of(kWithTable);
  if (!path) GTEST_SKIP() << "no recordings under VERGE_DATA";
  const auto bytes = bytes_of_file(*path);
  std::vector<std::size_t> begins;  // of the scans
  std::vector<std::size_t> ends;
  ibeo::Framer framer(ibeo::kLuxFrames);
  framer.feed(bytes);
  framer.finish();
  while (const auto event = framer.next()) {
    const auto& frame = std::get<ibeo::Frame>(*event);
    if (ibeo::decode_header(frame.header).type != ibeo::kScanType) continue;
    begins.push_back(frame.offset);
    ends.push_back(frame.offset + frame.header.size() + frame.body.size());
  }
  const auto all = sizes_of(Input::of(bytes, "a"));
  ASSERT_EQ(all.size(), 20U);
  for (std::size_t i = 0; i < 400; ++i) {
    const std::size_t cut = i * 7919 * 13 % bytes.size();
    const auto whole = std::count_if(ends.begin(), ends.end(), [&](std::size_t end) { return end <= cut; });
    ASSERT_EQ(sizes_of(Input::of(Bytes(bytes).first(cut), "a")),
              std::vector<std::size_t>(all.begin(), all.begin() + whole));
    const auto gone =
        std::count_if(begins.begin(), begins.end(), [&](std::size_t begin) { return begin < cut; });
    if (gone == 20) continue;  // nothing is left that is known by its magic
    ASSERT_EQ(sizes_of(Input::of(Bytes(bytes).subspan(cut), "a")),
              std::vector<std::size_t>(all.begin() + gone, all.end()));
  }
}

}  // namespace verge::io

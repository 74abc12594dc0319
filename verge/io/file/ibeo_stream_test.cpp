// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ibeo_stream.hpp"

#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/io/file/alasca_stream.hpp"
#include "verge/io/test_files.hpp"
#include "verge/sensor/ibeo/alasca_scan.hpp"
#include "verge/sensor/ibeo/health2030.hpp"
#include "verge/sensor/ibeo/idc.hpp"
#include "verge/sensor/ibeo/message.hpp"
#include "verge/sensor/ibeo/ntp.hpp"
#include "verge/sensor/ibeo/objects2221.hpp"
#include "verge/sensor/ibeo/scan2202.hpp"
#include "verge/sensor/ibeo/vehicle2805.hpp"

namespace verge::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace ibeo = sensor::ibeo;

using File = std::vector<std::byte>;

/// 2012-09-21 20:06:44 UTC.
constexpr std::int64_t kUnixNs = 1'348'258'004'000'000'000;

/// A scan of 20 ms that goes through the layers from left to right.
ibeo::LuxScan lux_scan(std::size_t points) {
  ibeo::LuxScan scan;
  scan.start_ntp = ibeo::ntp_of(kUnixNs);
  scan.end_ntp = ibeo::ntp_of(kUnixNs + 20'000'000);
  scan.start_angle_ticks = 1600;
  scan.end_angle_ticks = -1600;
  for (std::size_t i = 0; i < points; ++i) {
    scan.points.push_back({.layer = static_cast<std::uint8_t>(i % 4),
                           .angle_ticks = static_cast<std::int16_t>(1600 - static_cast<int>(i)),
                           .range_cm = static_cast<std::uint16_t>(1000 + i)});
  }
  return scan;
}

File lux_message(std::uint16_t type, const File& body) {
  return ibeo::encode_message({.type = type, .ntp = ibeo::ntp_of(kUnixNs)}, body);
}

File lux_scan_message(std::size_t points) {
  return lux_message(ibeo::kScanType, ibeo::encode_scan(lux_scan(points)));
}

/// An object without contour points, and one whose count of them is not known.
File lux_objects() {
  ibeo::LuxObject unknown;
  unknown.contour_unknown = true;
  return lux_message(ibeo::kObjectsType, ibeo::encode_objects({0, {ibeo::LuxObject{}, unknown}}));
}

/// Every fifth point is called invalid.
File alasca_scan_message(std::size_t points) {
  ibeo::AlascaScan scan;
  for (std::size_t i = 0; i < points; ++i) {
    scan.points.push_back({.layer = static_cast<std::uint8_t>(i % 4),
                           .status = ibeo::AlascaStatus{static_cast<std::uint8_t>(i % 5)},
                           .x_code = static_cast<std::int16_t>(1000 + i)});
  }
  return ibeo::encode_alasca_message({.type = ibeo::kAlascaScanType}, ibeo::encode_alasca_scan(scan));
}

/// One behind the other.
File joined(const std::vector<File>& parts) {
  File all;
  for (const File& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// `bytes` with `value` at `offset`, little-endian.
template <class T>
File patched(File bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
  return bytes;
}

/// What a recording gives from its beginning to its end.
struct Read {
  std::vector<Decoded> scans;
  std::vector<std::string> errors;
  std::vector<Counter> counters;

  [[nodiscard]] std::uint64_t count(const std::string& name) const {
    for (const Counter& counter : counters) {
      if (counter.name == name) return counter.count;
    }
    return 0;
  }
};

/// What is received adds up from what became of it.
void expect_counters_add_up(const Read& read) {
  for (const std::string kind : {"bytes", "messages", "points"}) {
    std::uint64_t received = 0;
    std::uint64_t rest = 0;
    for (const Counter& counter : read.counters) {
      if (!counter.name.starts_with(kind)) continue;
      (counter.name == kind + " received" ? received : rest) += counter.count;
    }
    EXPECT_EQ(received, rest) << kind;
  }
}

Read read_recording(Expected<std::unique_ptr<Recording>> recording) {
  Read read;
  if (!recording) {
    read.errors.push_back(to_string(recording.error()));
    return read;
  }
  while (true) {
    auto scan = (*recording)->next();
    if (!scan) {
      read.errors.push_back(to_string(scan.error()));
      continue;
    }
    if (!*scan) break;
    read.scans.push_back(*std::move(*scan));
  }
  read.counters = (*recording)->counters();
  expect_counters_add_up(read);
  EXPECT_TRUE((*recording)->next().has_value());  // the end stays the end
  return read;
}

Read read_ibeo(const File& file, const RecordingOptions& options = {}) {
  return read_recording(open_ibeo(Input::of(file, "a.bin"), options));
}
Read read_alasca(const File& file) { return read_recording(open_alasca(Input::of(file, "a.bin"))); }

/// An .idc file of `scans` scans of 5 points.
File idc(std::size_t scans, bool closed) {
  ibeo::IdcWriter writer;
  File file;
  const auto append = [&](const File& bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); };
  for (std::size_t i = 0; i < scans; ++i) {
    append(writer.add({.type = ibeo::kScanType, .ntp = ibeo::ntp_of(kUnixNs) + (i << 28U)},
                      ibeo::encode_scan(lux_scan(5))));
  }
  if (closed) append(writer.close());
  return file;
}

File garbage(std::size_t size) { return File(size, std::byte{0x5A}); }

}  // namespace

TEST(IbeoStream, EveryScanIsAScan) {
  const Read read = read_ibeo(joined({lux_scan_message(12), lux_scan_message(0), lux_scan_message(740)}));
  EXPECT_THAT(read.errors, IsEmpty());
  ASSERT_EQ(read.scans.size(), 3U);
  EXPECT_EQ(read.scans[0].cloud.x.size(), 12U);
  EXPECT_EQ(read.scans[1].cloud.x.size(), 0U);
  EXPECT_EQ(read.scans[2].cloud.x.size(), 740U);
  EXPECT_EQ(read.scans[0].stamp_ns, kUnixNs);
  EXPECT_EQ(read.count("messages used: scan (0x2202)"), 3U);
  EXPECT_EQ(read.count("points used"), 752U);
}

// L14, and every type that we know.
TEST(IbeoStream, OtherMessagesAreCountedByTheirType) {
  const Read read = read_ibeo(
      joined({lux_message(ibeo::kSensorInfoType, File(30)), lux_objects(),
              lux_message(ibeo::kVehicleStateType, ibeo::encode_vehicle_state({.velocity_cm_s = 100})),
              lux_message(ibeo::kHealthType, ibeo::encode_health({})), lux_scan_message(4),
              lux_message(0x2403, File(100))}));
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ(read.scans.size(), 1U);
  EXPECT_EQ(read.count("messages received"), 6U);
  EXPECT_EQ(read.count("messages used: objects (0x2221)"), 1U);
  EXPECT_EQ(read.count("messages used: vehicle state (0x2805)"), 1U);
  EXPECT_EQ(read.count("messages used: errors and warnings (0x2030)"), 1U);
  EXPECT_EQ(read.count("messages of other types"), 2U);
}

// L15.
TEST(IbeoStream, WhatTheSensorSaysOfItsHealthStandsWithTheNextScan) {
  const Read read = read_ibeo(
      joined({lux_scan_message(4),
              lux_message(ibeo::kHealthType, ibeo::encode_health({.error_1 = 2, .warning_1 = 0x10})),
              lux_scan_message(4), lux_scan_message(4)}));
  ASSERT_EQ(read.scans.size(), 3U);
  EXPECT_THAT(read.scans[0].notes, IsEmpty());
  EXPECT_THAT(read.scans[1].notes, ElementsAre("the sensor reports: motor error",
                                               "the sensor reports: warning: high temperature"));
  EXPECT_THAT(read.scans[2].notes, IsEmpty());
}

TEST(IbeoStream, TheMountingStandsInANoteAndIsNotApplied) {
  ibeo::LuxScan scan = lux_scan(4);
  scan.mounting = {.yaw_ticks = 320, .pitch_ticks = -32, .x_cm = 365, .z_cm = 55};
  scan.flags = ibeo::kDirtLabelled;
  const Read read =
      read_ibeo(joined({lux_scan_message(4), lux_message(ibeo::kScanType, ibeo::encode_scan(scan))}));
  ASSERT_EQ(read.scans.size(), 2U);
  EXPECT_EQ(read.scans[1].cloud.x, read.scans[0].cloud.x);
  EXPECT_THAT(read.scans[1].notes,
              ElementsAre(HasSubstr("yaw 10.000, pitch -1.000, roll 0.000 deg, x 3.65, y 0.00, z 0.55 m"),
                          "the sensor labels dirt on its window"));
}

// L2, L4: what is damaged is told with its place, and what follows it is used.
TEST(IbeoStream, DamageIsToldWithItsPlaceAndTheRestIsUsed) {
  const File scan = lux_scan_message(10);  // 168 bytes
  const File too_large = patched(scan, 8, std::uint32_t{0x0000'007F});
  const Read read = read_ibeo(
      joined({garbage(7), scan, garbage(3), too_large, scan, File(scan.begin(), scan.begin() + 100)}));
  EXPECT_EQ(read.scans.size(), 2U);
  EXPECT_THAT(read.errors,
              ElementsAre("a.bin:0: bytes belong to no message (got 7 B skipped)",
                          "a.bin:175: bytes belong to no message (got 3 B skipped)",
                          "a.bin:178: message is too large (got 168 B skipped, need <= 8388608 B)",
                          "a.bin:514: message is cut short (got 100 B skipped)"));
}

// L5, L7, L10, L11 and their like: the message is whole, its body is not right.
TEST(IbeoStream, ABodyThatCannotBeIsToldWithItsPlaceAndCounted) {
  const File scan = lux_scan_message(10);
  const Read read = read_ibeo(
      joined({patched(scan, 24 + 28, std::uint16_t{65535}), scan, patched(scan, 24 + 22, std::uint16_t{0}),
              lux_message(ibeo::kHealthType, File(3)), lux_message(ibeo::kObjectsType, File(12)),
              patched(scan, 24 + 14, std::uint64_t{0})}));
  EXPECT_EQ(read.scans.size(), 1U);
  EXPECT_THAT(
      read.errors,
      ElementsAre("a.bin:52: size of a scan does not fit its points (got 144 B, need 44 + 65535 x 10 B)",
                  "a.bin:382: a turn of a scan has no angle ticks (got 0, need 1 to 65535)",
                  "a.bin:528: size of errors and warnings is wrong (got 3 B, need 16 B)",
                  HasSubstr("a.bin:565: list of objects is shorter than its message"),
                  "a.bin:605: scan ends before it starts"));
  EXPECT_EQ(read.count("messages rejected: scan ends before it starts"), 1U);
  EXPECT_EQ(read.count("messages received"), 6U);
}

TEST(IbeoStream, PointsThatCannotBeAreCounted) {
  ibeo::LuxScan scan = lux_scan(10);
  scan.points[0].layer = 4;
  scan.points[1].echo = 9;
  scan.points[2].range_cm = 0;
  const Read read = read_ibeo(lux_message(ibeo::kScanType, ibeo::encode_scan(scan)));
  EXPECT_EQ(read.count("points received"), 10U);
  EXPECT_EQ(read.count("points used"), 7U);
  EXPECT_EQ(read.count("points of an unknown layer"), 1U);
  EXPECT_EQ(read.count("points of an unknown echo"), 1U);
  EXPECT_EQ(read.count("points without a return"), 1U);
}

TEST(Idc, WithIndexAndTrailerItIsWhole) {
  const Read read = read_ibeo(idc(3, true));
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ(read.scans.size(), 3U);
  EXPECT_EQ(read.count("messages used: frame index (0x6130)"), 1U);
  EXPECT_EQ(read.count("messages used: trailer (0x6120)"), 1U);
}

// L14.
TEST(Idc, ASeparatorIsNoDamage) {
  ibeo::IdcWriter writer;
  const File scan = writer.add({.type = ibeo::kScanType}, ibeo::encode_scan(lux_scan(5)));
  const File separator = writer.add({.type = ibeo::kSensorInfoType}, File(8));
  const File again = writer.add({.type = ibeo::kScanType}, ibeo::encode_scan(lux_scan(5)));
  const Read read = read_ibeo(joined({scan, separator, again, writer.close()}));
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ(read.scans.size(), 2U);
  EXPECT_EQ(read.count("messages of other types"), 1U);
}

// L17.
TEST(Idc, WithoutTrailerAllScansAreUsedAndItIsTold) {
  const File file = idc(3, false);
  const Read read = read_ibeo(file);
  EXPECT_EQ(read.scans.size(), 3U);
  EXPECT_THAT(read.errors, ElementsAre("a.bin:354: recording was not closed: it has no trailer"));
}

// L18, L19.
TEST(Idc, AnIndexThatIsWrongIsIgnored) {
  const File scans = idc(3, false);
  for (const std::size_t at : {19U, 128U}) {  // number of entries; place of the first frame
    File file = idc(3, true);
    file[scans.size() + 24 + at] = std::byte{0x10};
    std::vector<std::string> said;
    RecordingOptions options;
    options.log = [&](LogLevel, std::string_view text) { said.emplace_back(text); };
    const Read read = read_ibeo(file, options);
    EXPECT_THAT(read.errors, IsEmpty());
    EXPECT_EQ(read.scans.size(), 3U);
    EXPECT_THAT(said, ElementsAre(HasSubstr("frame index")));
  }
}

// L20.
TEST(Idc, TwoFilesOneBehindTheOtherAreOneRecording) {
  const Read read = read_ibeo(joined({idc(3, true), idc(2, true)}));
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ(read.scans.size(), 5U);
}

// L21.
TEST(Idc, TheSizeOfTheMessageBeforeIsNotBelieved) {
  File file = idc(3, true);
  for (const std::size_t at : {4U, 118U + 4U}) {
    for (std::size_t i = 0; i < 4; ++i) file[at + i] = std::byte{0xFF};
  }
  const Read read = read_ibeo(file);
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ(read.scans.size(), 3U);
}

// L22.
TEST(IbeoStream, AnotherScannersMessagesAreNamed) {
  EXPECT_THAT(
      read_ibeo(alasca_scan_message(3)).errors,
      ElementsAre(
          "a.bin:0: holds messages of an ibeo ALASCA XT, not of a LUX (got AF FE C0 C0, need AF FE C0 C2)"));
  EXPECT_THAT(
      read_alasca(lux_scan_message(3)).errors,
      ElementsAre(
          "a.bin:0: holds messages of an ibeo LUX, not of an ALASCA XT (got AF FE C0 C2, need AF FE C0 C0)"));
}

TEST(IbeoStream, AnEmptyFileAndAnUnknownModelAreRefused) {
  EXPECT_THAT(read_ibeo({}).errors, ElementsAre("a.bin:0: is empty"));
  RecordingOptions options;
  options.model = "hdl32e";
  EXPECT_THAT(read_ibeo(lux_scan_message(1), options).errors, ElementsAre(HasSubstr("no such model")));
  options.model = "ldmrs";
  EXPECT_EQ(read_ibeo(lux_scan_message(1), options).scans.size(), 1U);
}

TEST(IbeoStream, IsKnownByAMessageInItsHead) {
  EXPECT_TRUE(is_ibeo(lux_scan_message(3)));
  EXPECT_TRUE(is_ibeo(joined({garbage(1000), lux_scan_message(3)})));
  EXPECT_TRUE(is_ibeo(idc(1, true)));
  EXPECT_FALSE(is_ibeo(alasca_scan_message(3)));
  EXPECT_FALSE(is_ibeo(garbage(1000)));
  EXPECT_FALSE(is_ibeo({}));
  const File scan = lux_scan_message(3);
  EXPECT_FALSE(is_ibeo(Bytes(scan).first(23)));
  EXPECT_FALSE(is_ibeo(patched(scan, 8, std::uint32_t{0xFFFFFFFF})));
  EXPECT_TRUE(is_alasca(alasca_scan_message(3)));
  EXPECT_FALSE(is_alasca(scan));
}

TEST(AlascaStream, EveryScanIsAScan) {
  const File scan = alasca_scan_message(10);
  const File other = ibeo::encode_alasca_message({.type = 1}, File(40));
  const Read read =
      read_alasca(joined({garbage(3), scan, other, scan, File(scan.begin(), scan.begin() + 20)}));
  ASSERT_EQ(read.scans.size(), 2U);
  EXPECT_EQ(read.scans[0].cloud.x.size(), 8U);  // two of ten are called invalid
  EXPECT_EQ(read.scans[0].stamp_ns, std::nullopt);
  EXPECT_EQ(read.count("messages of other types"), 1U);
  EXPECT_EQ(read.count("points called invalid"), 4U);
  EXPECT_THAT(read.errors, ElementsAre("a.bin:0: bytes belong to no message (got 3 B skipped)",
                                       "a.bin:363: message is cut short (got 20 B skipped)"));
}

TEST(AlascaStream, SizesThatCannotBeAreTold) {
  const File scan = alasca_scan_message(10);
  const File large = patched(scan, 4, std::uint32_t{0x7195'0100});  // 0x00019571: one more than the greatest
  const Read read = read_alasca(joined({patched(scan, 16 + 14, std::uint16_t{0}), scan, large, scan}));
  EXPECT_EQ(read.scans.size(), 2U);
  EXPECT_THAT(read.errors,
              ElementsAre("a.bin:30: size of a scan does not fit its points (got 136 B, need 16 + 0 x 12 B)",
                          "a.bin:304: message is too large (got 152 B skipped, need <= 103792 B)"));
}

// Every bit of the headers and the first points: nothing crashes, counters add up (read_recording), and the
// two messages that are not touched are there.
TEST(IbeoStream, WithAnyBitFlippedTheOtherMessagesAreThere) {
  const File scan = lux_scan_message(3);
  const File head = joined({lux_scan_message(20), lux_objects()});
  for (std::size_t at = 0; at < head.size(); ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      File bad = head;
      bad[at] ^= static_cast<std::byte>(1U << bit);
      ASSERT_GE(read_ibeo(joined({scan, bad, scan})).scans.size(), 2U) << at << " bit " << bit;
    }
  }
}

/// A calibration of these layers, degrees, with more about layer 0.
std::string layers_file(const std::vector<double>& degrees, const std::string& more = {}) {
  std::string text = "lasers:\n";
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    text += fmt::format("- {{laser_id: {}, vert_correction: {}{}}}\n", i, deg_to_rad(degrees[i]),
                        i == 0 ? more : "");
  }
  return text;
}

// Paper 2's sensor, by its printed points.
TEST(IbeoStream, LayersLookWhereTheCalibrationSays) {
  const testing::TemporaryFolder folder;
  const std::vector<double> degrees{-0.8, 0.0, 0.8, 1.6};
  const File bytes = lux_scan_message(4);
  auto recording = open_ibeo(Input::of(bytes, "a.idc"),
                             {.calibration = folder.write("layers.yaml", layers_file(degrees))});
  ASSERT_TRUE(recording) << to_string(recording.error());
  const auto scan = (*recording)->next();
  ASSERT_TRUE(scan && *scan);
  const Cloud& cloud = (*scan)->cloud;
  ASSERT_EQ(cloud.x.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const double level = std::hypot(cloud.x[i], cloud.y[i]);
    EXPECT_NEAR(rad_to_deg(std::atan2(cloud.z[i], level)), degrees[i], 1e-5);
  }
}

TEST(IbeoStream, ALayerTableThatCannotBeIsRefused) {
  const testing::TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto model = lux_with_layers(folder.write("layers.yaml", text));
    return model ? std::string("taken") : to_string(model.error());
  };
  EXPECT_THAT(refusal(layers_file({-1.0, 0.0, 1.0})), HasSubstr("got 3 lasers, need 4 lasers"));
  EXPECT_THAT(refusal(layers_file({-1.0, 1.0, 0.0, 2.0})), HasSubstr("layers do not rise"));
  EXPECT_THAT(refusal(layers_file({-1.0, 0.0, 1.0, 2.0}, ", dist_correction: 0.1")),
              HasSubstr("elevations (vert_correction) alone"));
  EXPECT_THAT(refusal("lasers:\n- {"), HasSubstr("layers.yaml:"));
  EXPECT_FALSE(lux_with_layers(folder.path() / "missing.yaml"));
}

// The same recording read through an Input whose pieces of 64 KiB fall anywhere.
TEST(IbeoStream, ManyMessagesOverManyPiecesAreAllThere) {
  std::vector<File> messages;
  for (std::size_t i = 0; i < 300; ++i) messages.push_back(lux_scan_message(700 + i % 97));
  const Read read = read_ibeo(joined(messages));
  EXPECT_THAT(read.errors, IsEmpty());
  ASSERT_EQ(read.scans.size(), 300U);
  for (std::size_t i = 0; i < 300; ++i) ASSERT_EQ(read.scans[i].cloud.x.size(), 700 + i % 97);
}

}  // namespace verge::io

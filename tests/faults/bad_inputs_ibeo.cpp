// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section L: streams of an ibeo LUX or LD-MRS, .idc files, streams of an ALASCA XT. L01, every single cut and
// every pair of cuts of a stream, is a test of verge/sensor/ibeo/framer_test.cpp; here are the cuts that
// reading a file makes. L16, a peer that closes, resets or stalls, belongs to live connections: no file does.
#include "tests/faults/bad_inputs.hpp"
#include "verge/sensor/ibeo/health2030.hpp"
#include "verge/sensor/ibeo/idc.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"

namespace verge::faults {
namespace {

namespace ibeo = sensor::ibeo;
using testing::alasca_scan;
using testing::alasca_scan_message;
using testing::lux_message;
using testing::lux_objects;
using testing::lux_scan;
using testing::lux_scan_message;
using testing::patched;

using Stream = std::vector<std::byte>;

constexpr std::size_t kPoints = 10;
constexpr std::size_t kScan = 24 + 44 + 10 * kPoints;  // bytes of a message with a scan
constexpr std::size_t kBody = kScan + 24;              // of the second message of a stream

std::string text_of(const std::vector<Stream>& parts) {
  const Stream all = testing::joined(parts);
  return {reinterpret_cast<const char*>(all.data()), all.size()};
}

std::function<std::filesystem::path(const std::filesystem::path&)> stream(const std::vector<Stream>& parts) {
  return file("L.idc", text_of(parts));
}

Stream good() { return lux_scan_message(kPoints); }
Stream garbage(std::size_t size) { return Stream(size, std::byte{0x5A}); }
Stream message_of(const ibeo::LuxScan& scan) { return lux_message(ibeo::kScanType, ibeo::encode_scan(scan)); }

/// A good scan, something bad, a good scan: one error, at the bad one's place.
BadInput between(std::string title, const Stream& bad, std::string says, std::size_t where) {
  return {"",         std::move(title), stream({good(), bad, good()}),
          kDamaged,   std::move(says),  std::to_string(where),
          2 * kPoints};
}

BadInput harmless(std::string title, const std::vector<Stream>& parts, std::size_t used) {
  return {"", std::move(title), stream(parts), kGood, "", "", used, 0};
}

/// `bytes` with the big-endian number at `offset`.
template <class T>
Stream with_be(Stream bytes, std::size_t offset, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes[offset + i] = static_cast<std::byte>(value >> (8 * (sizeof(T) - 1 - i)));
  return bytes;
}

void add_framing(Section& all) {
  constexpr std::size_t kPiece = 65536;  // a file is read in pieces of that many bytes
  for (const std::size_t before : {1U, 2U, 3U, 4U, 23U, 24U, 25U}) {
    const Stream filler = lux_message(0x2403, Stream(kPiece - before - kScan - 24));
    all.add(1, harmless("MessageOverTwoPieces", {good(), filler, good()}, 2 * kPoints));
  }
  for (const std::size_t size : {1U, 3U, 7U, 65'536U}) {
    all.add(2, {"", "GarbageBefore", stream({garbage(size), good(), good()}), kDamaged,
                "bytes belong to no message (got " + std::to_string(size) + " B skipped)", "0", 2 * kPoints});
    all.add(2, between("GarbageBetween", garbage(size), "bytes belong to no message", kScan));
  }
  all.add(2, {"", "GarbageAlone", stream({garbage(1000)}), kDamaged, "bytes belong to no message", "0", 0});
  const Stream magic_inside = patched(good(), 24 + 44 + 14, std::uint32_t{0xC2C0'FEAF});
  all.add(3, harmless("MagicInside", {good(), magic_inside, good()}, 3 * kPoints));
  all.add(3, harmless("MagicInsideTheLast", {good(), magic_inside}, 2 * kPoints));
}

void add_sizes(Section& all) {
  const Stream body = ibeo::encode_scan(lux_scan(1));
  for (const std::size_t size : {0U, 43U, 45U, 53U}) {
    const Stream cut(body.begin(), body.begin() + static_cast<std::ptrdiff_t>(size));
    const bool has_header = size >= 44;
    all.add(4,
            between("BodyOfASize", lux_message(ibeo::kScanType, cut),
                    has_header ? "size of a scan does not fit its points" : "scan is shorter than its header",
                    kBody + (has_header ? 28 : 0)));
  }
  for (const std::uint32_t size : {0x7FFF'FFFFU, 0xFFFF'FFF0U, 0x8000'0000U, 0xFFFF'FFFFU, 0x0080'0001U}) {
    all.add(4, between("SizeBeyond8MiB", with_be(good(), 8, size), "message is too large (got 168 B", kScan));
  }
  // A size that is too small leaves bytes over.
  for (const std::uint32_t size : {0U, 43U, 45U, 143U}) {
    BadInput bad = between("SizeTooSmall", with_be(good(), 8, size),
                           size < 44 ? "scan is shorter than its header" : "does not fit its points",
                           kBody + (size < 44 ? 0 : 28));
    bad.errors = 2;
    all.add(4, std::move(bad));
  }
  all.add(4, between("SizeIntoTheNext", with_be(good(), 8, 145U), "message is cut short (got 168 B", kScan));
  all.add(4, {"", "SizePastTheEnd", stream({good(), with_be(good(), 8, 145U)}), kDamaged,
              "message is cut short", std::to_string(kScan), kPoints});
  all.add(5, between("PointsWithoutRoom", patched(lux_scan_message(0), 24 + 28, std::uint16_t{65535}),
                     "(got 44 B, need 44 + 65535 x 10 B)", kBody + 28));
  all.add(6, harmless("NoPoints", {good(), lux_scan_message(0), good()}, 2 * kPoints));
  all.add(6, harmless("NoPointsInAllTheFile", {lux_scan_message(0)}, 0));
  for (const std::uint16_t points : {std::uint16_t{kPoints + 1}, std::uint16_t{kPoints - 1}}) {
    all.add(7, between("PointsDoNotFitTheSize", patched(good(), 24 + 28, points),
                       "size of a scan does not fit its points", kBody + 28));
  }
}

void add_points(Section& all) {
  for (std::uint8_t layer = 4; layer < 16; ++layer) {
    ibeo::LuxScan scan = lux_scan(kPoints);
    scan.points[3].layer = layer;
    BadInput bad = harmless("Layer", {message_of(scan)}, kPoints - 1);
    bad.counted = {{"points of an unknown layer", 1}};
    all.add(8, std::move(bad));
  }
  for (std::uint8_t echo = 3; echo < 16; ++echo) {
    ibeo::LuxScan scan = lux_scan(kPoints);
    scan.points[3].echo = echo;
    BadInput bad = harmless("Echo", {message_of(scan)}, kPoints - (echo > 3 ? 1 : 0));
    bad.counted = {{"points of an unknown echo", echo > 3 ? 1 : 0}};
    all.add(9, std::move(bad));
  }
}

void add_times(Section& all) {
  all.add(10, between("NoTicks", patched(good(), 24 + 22, std::uint16_t{0}),
                      "a turn of a scan has no angle ticks", kBody + 22));
  for (const std::uint16_t ticks : std::initializer_list<std::uint16_t>{1, 11520, 65535}) {
    all.add(10, harmless("Ticks", {good(), patched(good(), 24 + 22, ticks)}, 2 * kPoints));
  }
  all.add(11, between("EndsBeforeItStarts", patched(good(), 24 + 14, testing::kNtp - 1),
                      "scan ends before it starts", kBody + 14));
  for (const std::uint64_t start : {0ULL, 274ULL << 32U}) {  // just powered: 1900
    ibeo::LuxScan scan = lux_scan(kPoints);
    scan.start_ntp = start;
    scan.end_ntp = start + (1ULL << 27U);
    all.add(12, harmless("Ntp1900", {message_of(scan), message_of(scan)}, 2 * kPoints));
  }
}

void add_other_messages(Section& all) {
  for (const std::size_t points : {0U, 1U}) {
    ibeo::LuxObjects list = lux_objects({3, -1, 2});
    list.objects[1].contour.resize(points);
    const Stream message = lux_message(ibeo::kObjectsType, ibeo::encode_objects(list));
    BadInput bad = harmless("ContourOfUnknownLength", {good(), message, good()}, 2 * kPoints);
    bad.counted = {{"messages used: objects (0x2221)", 1}};
    all.add(13, std::move(bad));
  }
  ibeo::LuxObjects list = lux_objects({-1});
  list.objects[0].contour.resize(2);
  all.add(13,
          between("ContourOfNoLengthThatFits", lux_message(ibeo::kObjectsType, ibeo::encode_objects(list)),
                  "list of objects is shorter than its message", kBody + 10 + 58));
  BadInput info =
      harmless("SensorInfo", {good(), lux_message(ibeo::kSensorInfoType, Stream(30)), good()}, 2 * kPoints);
  info.counted = {{"messages of other types", 1}};
  all.add(14, std::move(info));
  const auto health = [](const ibeo::LuxHealth& registers) {
    return lux_message(ibeo::kHealthType, ibeo::encode_health(registers));
  };
  all.add(15, {"", "SensorError", stream({good(), health({.error_1 = 0x0002}), good()}), kGood,
               "the sensor reports: motor error", "", 2 * kPoints, 0});
  all.add(15, {"", "SensorWarning", stream({good(), health({.warning_1 = 0x0010}), good()}), kGood,
               "the sensor reports: warning: high temperature", "", 2 * kPoints, 0});
  all.add(15,
          {"", "EveryBitOfTheRegisters",
           stream({health({.error_1 = 0xFFFF, .error_2 = 0xFFFF, .warning_1 = 0xFFFF, .warning_2 = 0xFFFF}),
                   good()}),
           kGood, "the sensor reports: temperature sensor defective", "", kPoints, 0});
  all.add(15, between("RegistersOf3Bytes", lux_message(ibeo::kHealthType, Stream(3)),
                      "size of errors and warnings is wrong", kBody));
}

/// An .idc file of three scans; where its index begins.
struct Idc {
  Stream file;
  std::size_t index_body = 0;
};

Idc idc(bool closed, bool separator = false) {
  ibeo::IdcWriter writer;
  std::vector<Stream> parts;
  for (std::uint64_t i = 0; i < 3; ++i) {
    parts.push_back(writer.add({.type = ibeo::kScanType, .ntp = testing::kNtp + (i << 28U)},
                               ibeo::encode_scan(lux_scan(kPoints))));
    if (separator)
      parts.push_back(writer.add({.type = ibeo::kSensorInfoType, .ntp = testing::kNtp}, Stream(8)));
  }
  const std::size_t index_body = testing::joined(parts).size() + 24;
  if (closed) parts.push_back(writer.close());
  return {testing::joined(parts), index_body};
}

void add_idc(Section& all) {
  const Idc whole = idc(true);
  const Idc killed = idc(false);
  const std::string not_closed = "recording was not closed: it has no trailer";
  BadInput separated = harmless("SeparatorInAnIdc", {idc(true, true).file}, 3 * kPoints);
  separated.counted = {{"messages of other types", 3}};
  all.add(14, std::move(separated));
  all.add(17, {"", "RecorderKilled", stream({killed.file}), kDamaged, not_closed,
               std::to_string(killed.file.size()), 3 * kPoints});
  Stream trailer(whole.file.end() - 24, whole.file.end());
  all.add(17, harmless("NoFrameIndex", {killed.file, trailer}, 3 * kPoints));
  const auto ignored = [&](std::string title, const Stream& bytes, std::string says) {
    return BadInput{"", std::move(title), stream({bytes}), kGood, std::move(says), "", 3 * kPoints, 0};
  };
  const std::size_t at = whole.index_body;
  all.add(18, ignored("IndexOf2To60Frames", with_be(whole.file, at + 19, 1ULL << 60U),
                      "frame index has more entries than its size allows"));
  all.add(18, ignored("IndexOf65535Triggers", with_be(whole.file, at + 36, std::uint16_t{65535}),
                      "frame index has too many triggers"));
  all.add(19, ignored("IndexPastTheEnd", with_be(whole.file, at + 128, 1ULL << 40U),
                      "frame index points behind itself"));
  all.add(19, ignored("IndexToItself", with_be(whole.file, at + 128, std::uint64_t{at}),
                      "frame index points behind itself"));
  // Nothing is read by the index: that it points into a message does no harm and is not looked for.
  all.add(19, ignored("IndexIntoTheMiddle", with_be(whole.file, at + 128 + 17, 7ULL), ""));
  all.add(20, harmless("TwoFilesInOne", {whole.file, whole.file}, 6 * kPoints));
  all.add(20, harmless("KilledAndClosedInOne", {killed.file, whole.file}, 6 * kPoints));
  all.add(20, {"", "ClosedAndKilledInOne", stream({whole.file, killed.file}), kDamaged, not_closed,
               std::to_string(whole.file.size() + killed.file.size()), 6 * kPoints});
  for (const std::uint32_t before : {0xFFFF'FFFFU, 0U, 1U, 168U}) {
    all.add(21, harmless("SizeBeforeIsWrong", {with_be(with_be(whole.file, 4, before), kScan + 4, before)},
                         3 * kPoints));
  }
}

BadInput alasca(std::string title, const std::vector<Stream>& parts, std::string says, std::string where,
                std::size_t used) {
  return {"",       std::move(title), file("L.alasca", text_of(parts)),
          kDamaged, std::move(says),  std::move(where),
          used};
}

/// What of the above an ALASCA XT's messages can have too. Of ten points two are called invalid.
void add_alasca(Section& all) {
  constexpr std::size_t kUsed = 8;
  const Stream scan = alasca_scan_message(kPoints);
  const std::size_t body = scan.size() + 16;
  all.add(2, alasca("AlascaGarbage", {garbage(3), scan}, "bytes belong to no message", "0", kUsed));
  all.add(4, alasca("AlascaTooLarge", {scan, with_be(scan, 4, 103'793U), scan}, "need <= 103792 B",
                    std::to_string(scan.size()), 2 * kUsed));
  all.add(4, alasca("AlascaShort", {scan, ibeo::encode_alasca_message({.type = 15}, Stream(15)), scan},
                    "scan is shorter than its header", std::to_string(body), 2 * kUsed));
  for (const std::uint16_t points : std::initializer_list<std::uint16_t>{0, 9, 11, 8648, 8649, 65535}) {
    all.add(7, alasca("AlascaPointsDoNotFit", {scan, with_be(scan, 16 + 14, points), scan}, "scan",
                      std::to_string(body + 14), 2 * kUsed));
  }
  ibeo::AlascaScan odd = alasca_scan(kPoints);
  odd.points[0].layer = 4;
  odd.points[2].echo = 4;
  odd.points[3].x_code = odd.points[3].y_code = odd.points[3].z_code = 0;
  const Stream message = ibeo::encode_alasca_message({.type = 15}, ibeo::encode_alasca_scan(odd));
  BadInput bad{"", "AlascaLayerEchoAndOrigin", file("L.alasca", text_of({message})), kGood, "", "", kUsed - 3,
               0};
  bad.counted = {{"points of an unknown layer", 1},
                 {"points of an unknown echo", 1},
                 {"points without a return", 1},
                 {"points called invalid", 2}};
  all.add(8, std::move(bad));
  all.add(22, {.code = "",
               .title = "AlascaAsLux",
               .make = file("L.idc", text_of({scan})),
               .says = "holds messages of an ibeo ALASCA XT, not of a LUX",
               .where = "0",
               .format = "ibeo"});
  all.add(22, {.code = "",
               .title = "LuxAsAlasca",
               .make = file("L.alasca", text_of({good()})),
               .says = "holds messages of an ibeo LUX, not of an ALASCA XT",
               .where = "0",
               .format = "alasca"});
  all.add(22, {"", "AlascaNamedIdc", file("L.idc", text_of({scan})), kGood, "", "", kUsed, 0});
  all.add(22, between("MessageOfAnAlascaInALuxStream", scan, "bytes belong to no message", kScan));
}

}  // namespace

std::vector<BadInput> bad_inputs_ibeo() {
  Section all('L');
  add_framing(all);
  add_sizes(all);
  add_points(all);
  add_times(all);
  add_other_messages(all);
  add_idc(all);
  add_alasca(all);
  return std::move(all).take();
}

}  // namespace verge::faults

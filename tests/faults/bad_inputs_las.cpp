// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section A: LAS. The catalogue leaves most exit codes open: a header that promises what the file does not
// hold makes the file unusable (docs/decisions.md: a cut file is not used in part); what stands in records
// that are not read does no harm.
#include <limits>

#include "tests/faults/bad_inputs.hpp"
#include "verge/io/file/test_las.hpp"

namespace verge::faults {
namespace {

using testing::LasFile;
using testing::vlr;

BadInput refused(std::string title, const LasFile& las, std::string says, std::string where) {
  return {"", std::move(title), file("A.las", las.bytes()), kUnusable, std::move(says), std::move(where)};
}

BadInput harmless(std::string title, const LasFile& las, std::string says = {}) {
  return {"", std::move(title), file("A.las", las.bytes()), kGood, std::move(says), "", 3, 0};
}

/// Version 1.4, three points of format 6.
LasFile good() { return {4, 6, 3}; }

void add_headers(Section& all) {
  const LasFile unsigned_file = good().text(0, "LASX");
  all.add(1, refused("Signature", unsigned_file, "is no LAS file", "0"));
  all.add(1, {"", "SignatureWithoutAName", file("A", unsigned_file.bytes()), kUnusable,
              "no known format fits", "0"});
  all.add(2, refused("Version1Dot5", good().put(25, std::uint8_t{5}), "got 1.5, need 1.0 to 1.4", "24"));
  all.add(2, refused("Version2Dot0", good().put(24, std::uint16_t{2}), "got 2.0, need 1.0 to 1.4", "24"));
  all.add(2, harmless("Version1Dot0", LasFile(0, 1, 3)));
  all.add(2, harmless("Version1Dot1", LasFile(1, 1, 3)));
  for (const std::uint16_t size : std::initializer_list<std::uint16_t>{1, 0, 227, 374, 65535}) {
    all.add(3, refused("HeaderSize", good().put(94, size), "size of the header is wrong", "94"));
  }
  for (const std::uint8_t format : std::initializer_list<std::uint8_t>{0x80 + 6, 0x40 + 6, 0xC0}) {
    all.add(11,
            refused("Compressed", good().put(104, format), "compressed LAS is not supported: unpack", "104"));
  }
  all.add(11, {"", "CompressedNamedLaz", file("A.laz", good().put(104, std::uint8_t{0x86}).bytes()),
               kUnusable, "compressed LAS is not supported", "104"});
  all.add(11, refused("UnknownFormat", good().put(104, std::uint8_t{11}), "point format is unknown", "104"));
}

void add_points(Section& all) {
  for (const std::uint32_t offset : {466U, 0xFFFF'FFFFU, 374U, 0U}) {
    all.add(4, refused("OffsetOfThePoints", good().put(96, offset), "points do not lie in the file", "96"));
  }
  for (const std::uint64_t count : {4ULL, 1ULL << 32U, 1ULL << 62U, ~0ULL}) {
    all.add(5, refused("CountTimesLengthBeyondTheFile", good().put(247, count),
                       "asks for more data than the file holds", "247"));
  }
  all.add(5, refused("CountOfOldVersions", LasFile(2, 1, 3).put(107, ~0U),
                     "asks for more data than the file holds", "107"));
  const std::string whole = good().bytes();
  all.add(5, {"", "CutInItsPoints", file("A.las", whole.substr(0, whole.size() - 1)), kUnusable,
              "asks for more data than the file holds", "247"});
  for (const std::uint16_t length : std::initializer_list<std::uint16_t>{29, 1, 0}) {
    all.add(6, refused("RecordLengthBelowItsFormat", good().put(105, length),
                       "point record is shorter than its format", "105"));
  }
  all.add(12, harmless("OldCount0", good()));
  all.add(12, harmless("OldCountIsAnother", good().put(107, 2U), "for old readers, as 2: 3 it is"));
  all.add(12, harmless("NewCount0", good().put(247, std::uint64_t{0}).put(107, 3U)));
  all.add(12,
          {"", "BothCounts0", file("A.las", LasFile(4, 6, 0).bytes()), kDamaged, "has 0 points", "107", 0});
}

void add_scales(Section& all) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double scale : {0.0, kNan, std::numeric_limits<double>::infinity()}) {
    all.add(10, refused("Scale", good().put(139, scale), "scale of a coordinate cannot be", "139"));
  }
  all.add(10, refused("Offset", good().put(171, kNan), "offset of a coordinate is not finite", "171"));
  all.add(10, {"", "ScaleBeyondFloats", file("A.las", good().put(131, 1e300).bytes()), kGood, "", "", 1, 2});
}

void add_records(Section& all) {
  const std::string geotiff = vlr("LASF_Projection", 34735, 0, 0);
  const auto one = [](const std::string& record) { return LasFile(2, 0, 3, record).put(100, 1U); };
  all.add(7, refused("RecordPastThePoints", one(vlr("x", 1, 10, 11)), "reaches into the points", "247"));
  all.add(7, refused("RecordOf64KiB", one(vlr("x", 1, 10, 65535)), "got 65535 B, need <= 10 B", "247"));
  all.add(7, refused("SecondRecordPastThePoints", LasFile(2, 0, 3, vlr("x", 1, 60, 60)).put(100, 2U),
                     "reaches into the points", "341"));
  for (const std::uint32_t count : {2U, 0x7FFF'FFFFU, ~0U}) {
    all.add(7, refused("MoreRecordsThanFit", LasFile(2, 0, 3, geotiff).put(100, count),
                       "do not fit before the points", "100"));
  }
  all.add(8, harmless("EmptyGeoTiff", one(geotiff)));
  all.add(8, harmless("GeoTiffOf3Bytes", one(vlr("LASF_Projection", 34735, 3, 3))));
  std::string extra = vlr("LASF_Spec", 4, 192, 192);
  extra[54 + 2] = 10;  // a double, for which no record has room
  all.add(9, harmless("ExtraBytesWithoutRoom", LasFile(4, 6, 3, extra).put(100, 1U)));
  all.add(9, harmless("ExtraBytesCut", LasFile(4, 6, 3, vlr("LASF_Spec", 4, 100, 100)).put(100, 1U)));
  std::string waveform = vlr("LASF_Spec", 100, 26, 26);
  waveform.replace(54 + 2, 4, "\x01\x00\x00\x80", 4);
  all.add(13, harmless("WaveformOf2GSamples", LasFile(3, 4, 3, waveform).put(100, 1U)));
  all.add(
      13,
      harmless("WaveformFarBehindTheFile",
               LasFile(4, 9, 3, waveform).put(100, 1U).point(0, 30, std::uint8_t{255}).point(0, 31, ~0ULL)));
}

}  // namespace

std::vector<BadInput> bad_inputs_las() {
  Section all('A');
  add_headers(all);
  add_points(all);
  add_scales(all);
  add_records(all);
  return std::move(all).take();
}

}  // namespace verge::faults

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section C: PCD.
#include <stdexcept>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/samples.hpp"

namespace verge::faults {
namespace {

/// A valid ascii file with one part of its text replaced.
std::string with(const std::string& from, const std::string& to) {
  std::string text = pcd_ascii(sample_points(4, 50));
  const std::size_t found = text.find(from);
  if (found == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(found, from.size(), to);
}

BadInput bad_header(std::string code, std::string title, const std::string& from, const std::string& to,
                    std::string says, std::string where) {
  return {std::move(code), std::move(title), file("C.pcd", with(from, to)),
          kUnusable,       std::move(says),  std::move(where)};
}

/// Three fields of `points` points, compressed data as given.
std::string compressed(std::uint64_t points, std::uint32_t packed_size, std::uint32_t unpacked_size,
                       const std::string& data) {
  const std::string n = std::to_string(points);
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH " + n +
         "\nHEIGHT 1\nPOINTS " + n + "\nDATA binary_compressed\n" + packed(packed_size, unpacked_size) + data;
}

void add_headers(std::vector<BadInput>& all) {
  all.push_back(bad_header("C01a", "NoDataLine", "DATA ascii\n", "", "no entry of a PCD header", "11:1"));
  all.push_back({"C01b", "EndsBeforeData", file("C.pcd", "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n"),
                 kUnusable, "DATA is missing", "3:13"});
  all.push_back({"C02", "SizeBeforeFields",
                 file("C.pcd", with("FIELDS x y z intensity ring\nSIZE 4 4 4 4 2\n",
                                    "SIZE 4 4 4 4 2\nFIELDS x y z intensity ring\n")),
                 kGood, "", "", 200, 0});
  all.push_back(bad_header("C03", "TypeX", "TYPE F F", "TYPE F X", "TYPE of a field", "5:8"));
  all.push_back(bad_header("C04a", "Size3", "SIZE 4 4", "SIZE 4 3", "need 1, 2, 4 or 8", "4:8"));
  all.push_back(
      bad_header("C04b", "FloatOf2Bytes", "SIZE 4 4", "SIZE 4 2", "TYPE and SIZE do not fit", "5:8"));
  all.push_back(bad_header("C05", "SizeMinus4", "SIZE 4 4", "SIZE 4 -4", "need 1, 2, 4 or 8", "4:8"));
  char variant = 'a';
  for (const char* count : {"0", "2147483648", "-1", "4097", "18446744073709551616", "1.5"}) {
    all.push_back(bad_header(std::string("C06") + variant++, "CountOfAField", "COUNT 1 1",
                             std::string("COUNT 1 ") + count, "need 1 to 4096", "6:9"));
  }
  all.push_back(bad_header("C11", "NoX", "FIELDS x", "FIELDS u", "no field x", "3:1"));
  all.push_back(bad_header("C12a", "FieldTwice", "FIELDS x y z intensity", "FIELDS x y z x",
                           "field stands twice", "3:14"));
  all.push_back(bad_header("C12b", "EntryTwice", "HEIGHT 1", "WIDTH 200", "WIDTH stands twice", "8:1"));
  all.push_back(bad_header("C16a", "ViewpointOf6Numbers", "VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 0 0 1 0 0",
                           "got 6 numbers, need 7", "9:1"));
  all.push_back(bad_header("C16b", "ViewpointOf8Numbers", "VIEWPOINT 0 0 0 1 0 0 0",
                           "VIEWPOINT 0 0 0 1 0 0 0 0", "need 7", "9:1"));
}

void add_counts(std::vector<BadInput>& all) {
  const std::string head =
      "# .PCD v0.7 - Point Cloud Data file format\n# one line more\nVERSION 0.7\nFIELDS x y z "
      "intensity\nSIZE 4 4 4 4\n"
      "TYPE F F F F\nCOUNT 1 1 1 1\n";
  const auto sized = [&](const std::string& width, const std::string& height, const std::string& points,
                         const std::string& data) {
    return head + "WIDTH " + width + "\nHEIGHT " + height + "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points +
           "\nDATA " + data + "\n" + std::string(1024, '\0');
  };
  all.push_back({"C07a", "WidthTimesHeightBeyond32Bits",
                 file("C.pcd", sized("65536", "65537", "65536", "binary")), kUnusable,
                 "POINTS is not WIDTH x HEIGHT", "11:1"});
  all.push_back({"C07b", "WidthTimesHeightBeyond32BitsAgrees",
                 file("C.pcd", sized("65536", "65537", "4295032832", "binary")), kUnusable,
                 "more data than the file holds", "11:1"});
  all.push_back({"C07c", "WidthTimesHeightBeyond64Bits",
                 file("C.pcd", sized("4294967296", "4294967297", "4294967296", "binary")), kUnusable,
                 "POINTS is not WIDTH x HEIGHT", "11:1"});
  all.push_back({"C07d", "PointsIsNotWidth", file("C.pcd", sized("64", "1", "63", "binary")), kUnusable,
                 "POINTS is not WIDTH x HEIGHT", "11:1"});
  all.push_back({"C08a", "PointsAskForMoreThanTheFile",
                 file("C.pcd", sized("2000000000", "1", "2000000000", "binary")), kUnusable,
                 "POINTS asks for more data than the file holds (got 2000000000 x 16 B, need <= 1024 B)",
                 "11:1"});
  all.push_back({"C08b", "PointsAskForMoreThanTheTextHolds",
                 file("C.pcd", sized("2000000000", "1", "2000000000", "ascii")), kUnusable,
                 "POINTS asks for more data than the file holds", "11:1"});
  all.push_back({"C08c", "PointsAskForMoreThanCompressedHolds",
                 file("C.pcd", sized("2000000000", "1", "2000000000", "binary_compressed")), kUnusable,
                 "unpacked size is not POINTS x point size"});
  all.push_back(
      {"C08d", "PointsOf0", file("C.pcd", sized("0", "1", "0", "binary")), kDamaged, "0 points", "11:1"});
  all.push_back(
      {"C08e", "PointsMinus1", file("C.pcd", sized("64", "1", "-1", "binary")), kUnusable, "POINTS", "11:8"});
  all.push_back({"C08f", "PointsBeyond64Bits",
                 file("C.pcd", sized("64", "1", "18446744073709551616", "binary")), kUnusable, "POINTS",
                 "11:8"});
}

void add_data(std::vector<BadInput>& all) {
  const std::vector<SamplePoint> points = sample_points(4, 50);
  const std::string binary = pcd_binary(points);
  all.push_back({"C09a", "BinaryCut", file("C.pcd", binary.substr(0, binary.size() - 1)), kUnusable,
                 "more data than the file holds", "10:1"});
  all.push_back({"C09b", "BinaryCutInAFolder",
                 folder("C09", {{"1.pcd", binary}, {"2.pcd", binary.substr(0, 300)}}), kDamaged,
                 "2.pcd:10:1: POINTS asks", "", 200});
  const std::string good = std::string("\x0B") + std::string(12, '\0');  // 12 literals
  all.push_back({"C10a", "CompressedSizeBeyondTheFile", file("C.pcd", compressed(1, 1000, 12, good)),
                 kUnusable, "longer than the file"});
  all.push_back({"C10b", "UncompressedSizeWrong", file("C.pcd", compressed(1, 13, 13, good)), kUnusable,
                 "unpacked size is not POINTS x point size"});
  all.push_back({"C10c", "CompressedSizeTooSmall", file("C.pcd", compressed(1, 5, 12, good)), kUnusable,
                 "compressed data are damaged"});
  all.push_back({"C10d", "CopyFromBeforeTheBeginning",
                 file("C.pcd", compressed(1, 3, 12, std::string("\xE0\x01\x05", 3))), kUnusable,
                 "compressed data are damaged"});
  all.push_back({"C10e", "CompressedMoreThanLzfCan",
                 file("C.pcd", compressed(100'000'000, 13, 1'200'000'000, good)), kUnusable,
                 "cannot be compressed that much"});
  // A bomb that LZF allows: 1.2 MB that unpack to 100 MB, which is more than 16 MiB + 64 x the file with its
  // points.
  constexpr std::uint32_t kBomb = 100'000'008;
  std::string bomb = std::string(2, '\0');
  while (bomb.size() < 3 * (kBomb / 264)) bomb += std::string("\xE0\xFF\x00", 3);
  all.push_back({"C10f", "Bomb",
                 file("C.pcd", compressed(kBomb / 12, static_cast<std::uint32_t>(bomb.size()), kBomb, bomb)),
                 kLimit, "more memory than allowed"});
  const std::string cut_lengths = compressed(1, 13, 12, "").erase(compressed(1, 13, 12, "").size() - 4);
  all.push_back(
      {"C10g", "LengthsCut", file("C.pcd", cut_lengths), kUnusable, "compressed data end in their lengths"});
}

void add_texts(std::vector<BadInput>& all) {
  std::string crlf;
  for (const char c : pcd_ascii(sample_points(4, 50))) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  all.push_back({"C13a", "CrLf", file("C.pcd", crlf), kGood, "", "", 200, 0});
  std::string header = pcd_header(200, "binary");
  std::string binary = pcd_binary(sample_points(4, 50)).substr(header.size());
  std::string crlf_header;
  for (const char c : header) crlf_header += c == '\n' ? "\r\n" : std::string(1, c);
  all.push_back({"C13b", "CrLfBeforeBinary", file("C.pcd", crlf_header + binary), kGood, "", "", 200, 0});
  char variant = 'a';
  for (const char* text : {"nan", "-nan", "NaN", "inf", "1e400"}) {
    const std::string first = "DATA ascii\n";
    all.push_back({std::string("C14") + variant++, "CoordinateIsNoNumber",
                   file("C.pcd", with(first, first + text + " 1 2 0 0\n")), kGood, "", "", 199, 1});
  }
  all.push_back({"C15", "CommentOf1MiB",
                 file("C.pcd", with("VERSION", "# " + std::string(1U << 20U, 'c') + "\nVERSION")), kGood, "",
                 "", 200, 0});
  all.push_back({"C15b", "CommentOf5MiB",
                 file("C.pcd", with("VERSION", "# " + std::string(5U << 20U, 'c') + "\nVERSION")), kUnusable,
                 "DATA is missing"});
}

}  // namespace

std::vector<BadInput> bad_inputs_pcd() {
  std::vector<BadInput> all;
  add_headers(all);
  add_counts(all);
  add_data(all);
  add_texts(all);
  return all;
}

}  // namespace verge::faults

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section Y: PLY.
#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/samples.hpp"

namespace verge::faults {
namespace {

const char* const kProperties = "property float x\nproperty float y\nproperty float z\n";

BadInput bad(std::string code, std::string title, std::string bytes, std::string says, std::string where) {
  return {std::move(code), std::move(title), file("Y.ply", std::move(bytes)),
          kUnusable,       std::move(says),  std::move(where)};
}

void add_headers(std::vector<BadInput>& all) {
  const std::string head = "ply\nformat ascii 1.0\n";
  all.push_back(
      bad("Y01", "SecondLineEmpty",
          std::string("ply\n\nformat ascii 1.0\nelement vertex 1\n") + kProperties + "end_header\n1 2 3\n",
          "empty line", "2:1"));
  all.push_back(bad("Y02", "FormatAlone",
                    std::string("ply\nformat\nelement vertex 1\n") + kProperties + "end_header\n1 2 3\n",
                    "format's kind is missing", "2:7"));
  char variant = 'a';
  for (const char* count : {"-1", "18446744073709551616", "1e3", "x"}) {
    all.push_back(bad(std::string("Y03") + variant++, "CountOfNoNumber",
                      head + "element vertex " + count + "\n" + kProperties + "end_header\n1 2 3\n",
                      "count of the element", "3:16"));
  }
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string name = std::string("ply\nformat ") + format + " 1.0\nelement vertex ";
    for (const char* count : {"1099511627776", "18446744073709551615", "2"}) {
      all.push_back(bad(std::string("Y03") + variant++, "CountBeyondTheFile",
                        name + count + "\n" + kProperties + "end_header\n1 2 3 4 5", "vertex", ""));
    }
  }
  all.push_back(bad("Y05", "UnknownType", head + "element vertex 1\nproperty real x\nend_header\n1\n",
                    "unknown type", "4:10"));
  all.push_back(
      bad("Y07a", "NoEndHeader", head + "element vertex 1\n" + kProperties, "no end_header", "6:17"));
  all.push_back(bad(
      "Y07b", "HeaderOf2000Lines",
      head +
          [] {
            std::string lines;
            for (int i = 0; i < 2000; ++i) lines += "comment\n";
            return lines;
          }(),
      "no end_header", "1024:8"));
  all.push_back(bad("Y07c", "HeaderOf100KiB",
                    head + "comment " + std::string(100U << 10U, 'c') + "\nend_header\n", "no end_header",
                    ""));
  all.push_back(bad("Y08", "PropertyBeforeElement",
                    head + kProperties + "element vertex 1\nend_header\n1 2 3\n", "property before", "3:1"));
}

void add_lists(std::vector<BadInput>& all) {
  const std::string lists = "element face 1\nproperty list int int vertex_indices\nelement vertex 1\n";
  const std::string tail = std::string(kProperties) + "end_header\n";
  const std::string binary = "ply\nformat binary_little_endian 1.0\n" + lists + tail;
  const std::string point = packed(1.0F, 2.0F, 3.0F);
  char variant = 'a';
  for (const std::int64_t length : {1LL << 31, 0xFFFF'FFFFLL, 4097LL, -1LL}) {
    all.push_back(bad(std::string("Y04") + variant++, "ListTooLong",
                      binary + packed(static_cast<std::uint32_t>(length)) + point, "list is too long",
                      std::to_string(binary.size())));
  }
  all.push_back(bad("Y04e", "ListBeyondTheFile", binary + packed(4096) + point,
                    "data end inside element face", std::to_string(binary.size() + 16)));
  const std::string own = "ply\nformat ascii 1.0\nelement vertex 1\n" + std::string(kProperties) +
                          "property list int int more\nend_header\n";
  all.push_back(bad("Y04f", "AsciiListTooLong", own + "1 2 3 2147483648 1\n", "list is too long", ""));
  all.push_back(bad("Y04g", "AsciiListCut", own + "1 2 3 4 1 2 3\n", "row is too short", "9:14"));
}

}  // namespace

std::vector<BadInput> bad_inputs_ply() {
  const std::vector<SamplePoint> points = sample_points(4, 50);
  std::vector<BadInput> all;
  add_headers(all);
  add_lists(all);
  all.push_back({"Y03z", "NoVertices", file("Y.ply", ply_ascii({}, false)), kDamaged, "0 points", "4:16"});
  all.push_back({"Y06", "BigEndian", file("Y.ply", ply_binary(points, true, false)), kGood, "", "", 200, 0});
  all.push_back(
      {"Y09a", "VertexBehindFaceAscii", file("Y.ply", ply_ascii(points, true)), kGood, "", "", 200, 0});
  all.push_back({"Y09b", "VertexBehindFaceLittleEndian", file("Y.ply", ply_binary(points, false, true)),
                 kGood, "", "", 200, 0});
  all.push_back({"Y09c", "VertexBehindFaceBigEndian", file("Y.ply", ply_binary(points, true, true)), kGood,
                 "", "", 200, 0});
  std::string missing = ply_ascii(points, false);
  missing.erase(missing.find_last_of(' '), 2);  // the last ring
  all.push_back({"Y10", "AsciiColumnMissing", file("Y.ply", missing), kUnusable, "row is too short", ""});
  return all;
}

}  // namespace verge::faults

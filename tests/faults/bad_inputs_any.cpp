// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section G: any file. G09 (shrinks while it is read) and G15 (EIO) need somebody who does it meanwhile: they
// are tests of verge/io/input_test.cpp. G10 (grows) is there too.
#include <fstream>
#include <stdexcept>

#include <sys/stat.h>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/samples.hpp"

namespace verge::faults {
namespace fs = std::filesystem;
namespace {

fs::path unreadable(const fs::path& folder) {
  const fs::path path = folder / "G03.bin";
  write(path, kitti(sample_points(4, 50)));
  fs::permissions(path, fs::perms::none);
  return path;
}

fs::path endless(const fs::path& folder) {
  fs::create_symlink("/dev/zero", folder / "G06.bin");
  return folder / "G06.bin";
}

fs::path silent_pipe(const fs::path& folder) {
  const fs::path path = folder / "G07.bin";
  if (::mkfifo(path.c_str(), 0600) != 0) throw std::runtime_error("no FIFO");
  return path;
}

fs::path link_loop(const fs::path& folder) {
  fs::create_symlink("G08b.bin", folder / "G08.bin");
  fs::create_symlink("G08.bin", folder / "G08b.bin");
  return folder / "G08.bin";
}

/// A PLY file whose vertices stand behind 5 GiB of something else, which take no room on the disk.
fs::path five_gibibytes(const fs::path& folder) {
  constexpr std::uint64_t kFiller = 5ULL << 30U;
  const std::string vertices = ply_binary(sample_points(4, 50), false, false);
  const std::string ends = "end_header\n";
  const std::size_t data = vertices.find(ends) + ends.size();
  const std::string first = "ply\nformat binary_little_endian 1.0\n";
  const std::string header = first + "element filler " + std::to_string(kFiller / 8) +
                             "\nproperty double nothing\n" +
                             vertices.substr(first.size(), data - first.size());
  const fs::path path = folder / "G16.ply";
  write(path, header);
  fs::resize_file(path, header.size() + kFiller);
  std::ofstream(path, std::ios::binary | std::ios::app) << vertices.substr(data);
  return path;
}

void add_empty_and_tiny(std::vector<BadInput>& all) {
  int variant = 0;
  for (const char* suffix : {".bin", ".pcd.bin", ".pcd", ".ply", ".csv", ""}) {
    const std::string letter(1, static_cast<char>('a' + variant++));
    all.push_back({"G04" + letter, "Empty", file("G04" + std::string(suffix), ""), kUnusable, "empty", "0"});
    all.push_back({"G05" + letter, "OneByte", file("G05" + std::string(suffix), "a"), kUnusable});
  }
  all.push_back({"G05g", "OneByteThatIsZero", file("G05.pcd", std::string(1, '\0')), kUnusable});
}

void add_what_is_no_file(std::vector<BadInput>& all) {
  all.push_back(
      {"G01", "Missing", [](const fs::path& in) { return in / "G01.bin"; }, kCannotOpen, "cannot open"});
  // A folder is a recording: one without scans has nothing to decode.
  all.push_back(
      {"G02", "FolderWithoutScans", folder("G02.pcd", {{"README", "x"}}), kUnusable, "folder has no scans"});
  all.push_back({.code = "G03",
                 .title = "NoPermission",
                 .make = &unreadable,
                 .exit = kCannotOpen,
                 .says = "cannot open",
                 .as_user = true});
  all.push_back({.code = "G06",
                 .title = "Endless",
                 .make = &endless,
                 .exit = kLimit,
                 .says = "longer than the memory",
                 .memory_mib = 64});
  all.push_back({"G07", "PipeWithoutWriter", &silent_pipe, kTimeout, "no data for"});
  all.push_back({"G08a", "LinkLoop", &link_loop, kCannotOpen, "cannot open"});
  all.push_back({"G08b", "LinkLoopInAFolder",
                 [](const fs::path& in) {
                   write(in / "G08" / "1.bin", kitti(sample_points(4, 50)));
                   fs::create_symlink("2.bin", in / "G08" / "2.bin");
                   return in / "G08";
                 },
                 kDamaged, "2.bin: cannot open", "", 200});
  all.push_back({"G14", "PathOf4096Bytes", [](const fs::path& in) { return in / std::string(4096, 'p'); },
                 kCannotOpen, "cannot open"});
}

/// Bytes that are no text, in names and where an error quotes them.
void add_quotes(std::vector<BadInput>& all) {
  const std::string raw = "\xFF\xC3(\x1B[31m\xC2\x9B";
  const std::string quoted = "\\xFF\\xC3(\\x1B[31m\\xC2\\x9B";
  all.push_back({"G13c", "NoUtf8InAPath", file("G13" + raw + ".pcd", pcd_ascii(sample_points(4, 50))), kGood,
                 "", "", 200, 0});
  all.push_back({"G13d", "NoUtf8InABadFilesPath", file("G13" + raw + ".pcd", "abc"), kUnusable, quoted});
  all.push_back({"G13e", "NoUtf8InAPcdHeader", file("G13.pcd", "# .PCD v0.7\nVERSION 0.7\n" + raw + " 1\n"),
                 kUnusable, quoted, "3:1"});
  all.push_back({"G13f", "NoUtf8InAPlyHeader", file("G13.ply", "ply\nformat ascii 1.0\n" + raw + " 1\n"),
                 kUnusable, quoted, "3:1"});
  all.push_back(
      {"G13g", "NoUtf8InACsv", file("G13.csv", "x,y,z\n1,2,3\n1," + raw + ",3\n"), kUnusable, quoted, "3:3"});
  std::string roads;
  for (int i = 0; i < 200; ++i) roads += "\xE9\x81\x93";
  all.push_back({"G13h", "LongWordInAPcdHeader",
                 file("G13.pcd", "# .PCD v0.7\nVERSION 0.7\n" + roads + " 1\n"), kUnusable, "\xE9\x81\x93...",
                 "3:1"});
}

}  // namespace

std::vector<BadInput> bad_inputs_any() {
  const std::vector<SamplePoint> points = sample_points(4, 50);
  std::vector<BadInput> all;
  add_what_is_no_file(all);
  add_empty_and_tiny(all);
  all.push_back({"G11a", "PlyNamedPcd", file("G11.pcd", ply_ascii(points, false)), kGood,
                 "is ply by its content", "", 200, 0});
  all.push_back({"G11b",
                 "PlyNamedPcdWhenPcdIsForced",
                 file("G11.pcd", ply_ascii(points, false)),
                 kUnusable,
                 "no entry of a PCD header",
                 "1:1",
                 {},
                 {},
                 "pcd"});
  all.push_back({"G11c", "PcdNamedBin", file("G11.bin", pcd_binary(points)), kGood, "is pcd by its content",
                 "", 200, 0});
  all.push_back({"G11d", "KittiNamedCsv", file("G11.csv", kitti(points)), kGood, "is kitti by its content",
                 "", 200, 0});
  all.push_back({"G11e", "CsvNamedPly", file("G11.ply", csv(points, true)), kGood, "is csv by its content",
                 "", 200, 0});
  char variant = 'a';
  for (const char* suffix : {".bin", ".pcd", ".csv", ".ply", ".gz"}) {
    all.push_back({std::string("G12") + variant++, "Gzip",
                   file(std::string("G12") + suffix, "\x1F\x8B\x08" + std::string(500, '\x5A')), kUnusable,
                   "gzip", "0"});
  }
  all.push_back({"G13a", "NewlineAndEscapeInAMissingPath",
                 [](const fs::path& in) { return in / "G13\n\x1B[31m.bin"; }, kCannotOpen, "\\x0A\\x1B[31m"});
  all.push_back({"G13b", "NewlineAndEscapeInABadFilesPath", file("G13\n\x1B[31m.bin", "abc"), kUnusable,
                 "\\x0A\\x1B[31m"});
  add_quotes(all);
  all.push_back({"G16", "VerticesBehind5GiB", &five_gibibytes, kGood, "", "", 200, 0});
  return all;
}

}  // namespace verge::faults
